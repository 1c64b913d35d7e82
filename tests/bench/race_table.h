// How many simulations each solver needs to come close to the best plan: a race on one problem.
//
//   cost = evaluations without gradient + c * evaluations with gradient
//
// c is what an evaluation with gradient costs in evaluations without; by differences it is 1 + n (forward) or 1 + 2 n.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "problems/search/problem.h"

namespace stillhook {

struct RaceOptions {
  // Names of solvers(), "auto", and either with "+forward" or "+central": gradients by differences. Empty = all that
  // can.
  std::vector<std::string> solvers;
  double gradient_cost = 2.5;          // >= 1, of exact gradients
  double budget = 2500.0;              // cost at which a solver is stopped
  double within = 0.01;                // of the best: |f - best| <= within * |best|
  double difference_step = 1e-4;       // share of the range
  double constraint_tolerance = 1e-6;  // >= 0
  double x_tolerance = 1e-6;           // share of the range, see SolveOptions
  std::vector<unsigned long> seeds = {1, 2, 3};
  std::optional<double> best;  // known from elsewhere; else the best that anyone finds
};

/// One solver's result, the middle one over the seeds (they matter to random solvers only).
struct RaceResult {
  std::string solver;
  double cost_within = std::numeric_limits<double>::infinity();  // to come within; infinity = never
  double cost_near = std::numeric_limits<double>::infinity();    // within ten times that
  double best = std::numeric_limits<double>::quiet_NaN();        // feasible objective
  double cost = 0.0;                                             // in all
  std::string end;                                               // why it ended
};

/// Runs every solver; the first to come within stands first. The problem's evaluations must be repeatable.
std::vector<RaceResult> run_race(const SearchProblem& problem, const RaceOptions& options);

/// The results as a Markdown table.
std::string race_table(const std::vector<RaceResult>& results, const RaceOptions& options);

}  // namespace stillhook
