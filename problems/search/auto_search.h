// The solver called `auto`: many starts, gradients where they are valid, and something else where they are not.
//
//   1. the starts are evaluated, the problem's own first, then those given, then a few drawn at random from the box;
//   2. from the best few that are not close to one another, chains go on side by side, each with its share of the
//      budget: Ipopt in one, SLSQP in the next; where its gradients are not valid a chain goes on without them (COBYLA,
//      or BOBYQA if there are no constraints) for some steps and then comes back;
//   3. the best point of all is polished with SLSQP, or without gradients in small steps.
//
// A problem without gradients takes the same way without them. Each chain's share is fixed beforehand, so the result is
// the same for any number of threads.
#pragma once

#include "problems/search/solve.h"

namespace stillhook {

/// solve() with `auto`; the options have been checked.
SearchReport auto_search(const SearchProblem& problem, const SolveOptions& options);

}  // namespace stillhook
