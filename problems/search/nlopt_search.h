// One run of one NLopt algorithm on a SearchProblem. Variables are scaled to [0, 1] (by their logarithm where the
// problem asks for it), so steps and tolerances are shares of the range between the bounds.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "problems/search/problem.h"

namespace stillhook {

struct NloptOptions {
  std::string algorithm = "cobyla";    // one of nlopt_algorithms()
  Eigen::VectorXd start;               // within the bounds; empty = the problem's start
  int evaluations = 100;               // > 0, budget of points asked for
  unsigned long seed = 1;              // of the random generator, which belongs to the running thread
  int population = 0;                  // isres, crs2, esch; 0 = the algorithm's own
  double initial_step = 0.15;          // in (0, 1], share of the range, local algorithms
  double x_tolerance = 1e-6;           // >= 0, share of the range, local algorithms
  double constraint_tolerance = 1e-6;  // >= 0: g <= this counts as feasible
  std::function<bool()> should_stop;   // asked before each evaluation
};

struct NloptAlgorithm {
  std::string name;
  bool global = false, constraints = false, population = false;
};

/// Every algorithm that can be named, with what it can do.
const std::vector<NloptAlgorithm>& nlopt_algorithms();

/// Empty if the algorithm exists and can do the job; else what it must be instead, which ones can, and the name given.
std::string algorithm_fault(const std::string& name, bool global, bool has_constraints);

/// Minimises the problem. Never throws for what the algorithm does; an exception out of problem.evaluate stops the
/// algorithm and is thrown on, and a wrong problem or option is std::invalid_argument. The report's best point is the
/// best of all evaluated by better(), not the algorithm's own last word. Same problem, options and seed: same bits.
SearchReport nlopt_search(const SearchProblem& problem, const NloptOptions& options);

}  // namespace stillhook
