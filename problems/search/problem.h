// A constrained minimisation in the solver's terms:  minimise f(x)  subject to  g_i(x) <= 0,  l <= x <= u.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Dense>

namespace stillhook {

/// What one evaluation found. Never NaN: an evaluation that could not be completed is graded instead, with
/// `usable` false, a large finite objective that decreases with how far it got, and every constraint violated.
struct Evaluation {
  bool usable = false;
  double objective = std::numeric_limits<double>::max();
  Eigen::VectorXd constraints;  // g_i(x), <= 0 is satisfied, scaled to order 1
  std::vector<double> details;  // problem-defined numbers kept in the store (metrics by scenario)
  std::string message;
  bool interrupted = false;  // stopped from outside before it was complete: not a result, never stored
  bool from_store = false;   // answered by the store, not computed

  // Filled when the problem offers gradients and they are valid here.
  bool gradient_valid = false;
  Eigen::VectorXd objective_gradient;
  Eigen::MatrixXd constraint_jacobian;  // one row per constraint

  /// Largest violated constraint, 0 if feasible.
  double violation() const { return constraints.size() ? std::max(0.0, constraints.maxCoeff()) : 0.0; }
};

struct SearchProblem {
  std::string name;
  std::vector<std::string> variable_names, constraint_names;
  Eigen::VectorXd lower, upper, start;
  std::vector<bool> logarithmic;  // searched by its logarithm; empty = none, else one per variable, lower > 0
  bool has_gradient = false;
  /// Must be callable from several threads at once.
  std::function<Evaluation(const Eigen::VectorXd&)> evaluate;
};

enum class SearchStatus { not_run, converged, budget_used, interrupted, failed };

struct SearchReport {
  SearchStatus status = SearchStatus::not_run;
  std::string algorithm, message;
  Eigen::VectorXd best_x;
  Evaluation best;
  bool feasible = false;    // best satisfies every constraint
  int evaluations = 0;      // asked for by the solver, repeats included
  int simulations = 0;      // really computed, not answered from the store
  int best_evaluation = 0;  // 1-based number of the evaluation that found the best, 0 = none
};

/// The first thing wrong with a problem's variables (sizes, bounds, start outside them) as a sentence; empty if none.
std::string problem_fault(const SearchProblem& problem);

/// The evaluation as a solver may see it: a value that is not finite makes it unusable, with a large finite objective
/// and every one of the `constraints` constraints violated. A usable one is returned as it is.
Evaluation sanitised(Evaluation evaluation, int constraints);

/// Maps the box lower <= x <= upper to the unit cube, logarithmically where the problem asks for it.
class UnitCube {
 public:
  explicit UnitCube(const SearchProblem& problem);
  Eigen::VectorXd to_unit(const Eigen::VectorXd& x) const;
  /// Clamped to the bounds.
  Eigen::VectorXd from_unit(const Eigen::VectorXd& z) const;

 private:
  Eigen::VectorXd lower_, upper_;
  std::vector<bool> logarithmic_;
};

/// Ranking of evaluations everywhere: usable before not, feasible before infeasible, then objective; among the
/// infeasible the smaller violation.
bool better(const Evaluation& a, const Evaluation& b, double tolerance = 1e-6);

}  // namespace stillhook
