// The search: the given starts, then a global and a local algorithm in sequence, on one budget of evaluations.
//
//   1. every start is evaluated (the problem's own start, the baseline, first);
//   2. the global algorithm takes global_share of the budget, from the best start;
//   3. the local one goes on from the best point found, again and again with a smaller first step, until the budget is
//      used or the step is below the tolerance; one with gradients, which has no first step, goes on once.
//
// The sequence is a function of the problem, the options and the seed alone. So a search that was killed is resumed by
// running it again with its evaluations answered from the store.
#pragma once

#include <atomic>

#include "problems/search/solve.h"

namespace stillhook {

struct SearchOptions {
  std::string global_algorithm = "isres";  // empty = none
  std::string local_algorithm = "cobyla";  // empty = none
  double global_share = 0.5;               // in [0, 1], of the evaluations
  int evaluations = 60;                    // > 0
  double time_budget = 0.0;                // s of wall time, 0 = none; a budget of time gives up reproducibility
  unsigned long seed = 1;
  double constraint_tolerance = 1e-6;  // >= 0: g <= this counts as feasible
  // In (0, 1], share of the range, of the first local run. Large: the linear models of COBYLA then average over the
  // jumps of the objective (a re-hit more or less) instead of following them.
  double initial_step = 0.4;
  double x_tolerance = 1e-5;                            // > 0, share of the range: local runs stop below it
  std::vector<Eigen::VectorXd> starts;                  // besides the problem's own, within the bounds
  const std::atomic<bool>* stop = nullptr;              // set from outside to end the search with its best so far
  std::function<void(const SearchProgress&)> progress;  // after every evaluation, never from two threads at once
};

/// Empty if the options suit the problem; else what is wrong, as a sentence.
std::string search_fault(const SearchProblem& problem, const SearchOptions& options);

/// Runs the sequence above. Throws std::invalid_argument with search_fault(), and whatever problem.evaluate throws.
SearchReport search(const SearchProblem& problem, const SearchOptions& options);

}  // namespace stillhook
