// One run of Ipopt on a SearchProblem: exact gradients, limited-memory BFGS Hessian, constraints natively (A. Waechter
// and L. T. Biegler, Mathematical Programming 106 (2006) 25-57). Variables are scaled to [0, 1].
#pragma once

#include "problems/search/solve.h"

namespace stillhook {

/// solve() with Ipopt; the options have been checked. A point that is not usable or whose gradient is not valid only
/// shortens the step; if there is no way round such points the report says gradient_invalid. Solves in several threads
/// share one lock, which each gives up while its problem is evaluated.
SearchReport ipopt_search(const SearchProblem& problem, const SolveOptions& options);

}  // namespace stillhook
