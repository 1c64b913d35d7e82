// Plain random sampling of the box: what any search must beat with the same number of evaluations.
#pragma once

#include "problems/search/search.h"

namespace stillhook {

/// Evaluates the problem's start and options.evaluations - 1 points drawn evenly from the box (evenly in the logarithm
/// where the problem asks for it), several at once. Point i comes from seed + i alone, so the result does not depend on
/// the number of threads. Uses evaluations, seed, time_budget, constraint_tolerance, stop and progress of the options.
/// Throws std::invalid_argument for a wrong problem, and whatever problem.evaluate throws.
SearchReport random_search(const SearchProblem& problem, const SearchOptions& options);

/// The i-th point of that sample, i >= 1; 0 is the start.
Eigen::VectorXd random_point(const SearchProblem& problem, unsigned long seed, int i);

}  // namespace stillhook
