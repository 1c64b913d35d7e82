// One run of one NLopt algorithm on a SearchProblem. Variables are scaled to [0, 1] (by their logarithm where the
// problem asks for it), so steps and tolerances are shares of the range between the bounds.
#pragma once

#include "problems/search/solve.h"

namespace stillhook {

/// solve() with a solver of NLopt; the options have been checked. Where an algorithm wants a gradient that is not
/// valid, it is stopped and the report says gradient_invalid; the line search of slsqp, which needs values only, may
/// pass through such points.
SearchReport nlopt_search(const SearchProblem& problem, const SolveOptions& options);

}  // namespace stillhook
