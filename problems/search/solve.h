// One problem, one solver by name: Ipopt, NLopt's, or `auto` (auto_search.h).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "problems/search/problem.h"

namespace stillhook {

struct SearchProgress {
  std::string stage;                // "start", "isres", "cobyla", "random search", ...
  int evaluations = 0, budget = 0;  // asked for so far, and in all
  bool improved = false;            // the last evaluation is the best so far
  const Evaluation* last = nullptr;
  const Evaluation* best = nullptr;
  const Eigen::VectorXd* best_x = nullptr;
};

struct SolveOptions {
  std::string solver = "auto";          // "auto" or one of solvers()
  std::vector<Eigen::VectorXd> starts;  // within the bounds; empty = the problem's. More than one with `auto` only
  int evaluations = 100;                // > 0, budget of points asked for
  double time_budget = 0.0;             // s of wall time, 0 = none; a budget of time gives up reproducibility
  unsigned long seed = 1;               // of everything random
  // g <= this counts as feasible, >= 0; equalities want > 0. With 0 a solver with gradients, which ends on the limit,
  // aims 1e-6 inside of it.
  double constraint_tolerance = 1e-6;
  double x_tolerance = 1e-6;           // >= 0, share of the range: local solvers stop at steps below it
  double optimality_tolerance = 1e-7;  // > 0, of Ipopt: scaled residual of the optimality conditions
  double initial_step = 0.15;          // in (0, 1], share of the range: local solvers without gradients begin with it
  int population = 0;                  // of solvers that have one; 0 = their own
  std::function<bool()> should_stop;   // asked before each evaluation, by `auto` from several threads
  std::function<void(const SearchProgress&)> progress;  // after each evaluation, never from two threads at once
};

/// Empty if the options suit the problem; else what is wrong, as a sentence.
std::string solve_fault(const SearchProblem& problem, const SolveOptions& options);

/// Minimises the problem. The report's best point is the best of all evaluated by better(), not the solver's own last
/// word; a solver that gives up is a status, not an exception. Throws std::invalid_argument with solve_fault(), and
/// whatever the problem's evaluation throws, which ends the solver at once. Same problem, options and seed: same bits,
/// for any number of threads. May be called from several threads at once, and from within an evaluation.
SearchReport solve(const SearchProblem& problem, const SolveOptions& options);

}  // namespace stillhook
