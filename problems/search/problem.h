// A constrained minimisation in the solver's terms:
//
//   minimise f(x)  subject to  g_i(x) = 0, i < equalities,   g_i(x) <= 0, i >= equalities,   l <= x <= u
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
  Eigen::VectorXd constraints;  // g_i(x), scaled to order 1: the equalities first, then those that want <= 0
  int equalities = 0;           // as the problem's
  std::vector<double> details;  // problem-defined numbers kept in the store (metrics by scenario)
  std::string message;
  bool interrupted = false;  // stopped from outside before it was complete: not a result, never stored
  bool from_store = false;   // answered by the store, not computed

  // Filled when the problem offers gradients and they are valid here.
  bool gradient_valid = false;
  Eigen::VectorXd objective_gradient;
  Eigen::MatrixXd constraint_jacobian;  // one row per constraint

  /// Largest violated constraint, 0 if feasible.
  double violation() const {
    double largest = constraints.size() ? std::max(0.0, constraints.maxCoeff()) : 0.0;
    for (int i = 0; i < equalities; ++i) largest = std::max(largest, -constraints[i]);
    return largest;
  }
};

struct SearchProblem {
  std::string name;
  std::vector<std::string> variable_names, constraint_names;
  Eigen::VectorXd lower, upper, start;
  std::vector<bool> logarithmic;  // searched by its logarithm; empty = none, else one per variable, lower > 0
  int equalities = 0;             // the first constraints, that must be zero; the others must be <= 0
  /// Both must be callable from several threads at once, and mean the same functions f and g.
  std::function<Evaluation(const Eigen::VectorXd&)> evaluate;
  /// Fills the gradients where they are valid; empty = the problem has none. Asked by solvers that need them only.
  std::function<Evaluation(const Eigen::VectorXd&)> evaluate_with_gradient;
};

/// gradient_invalid: a solver wanted a gradient at a point that has none; one without gradients may go on from there.
enum class SearchStatus { not_run, converged, budget_used, interrupted, gradient_invalid, failed };

/// One evaluation of a search's course.
struct SearchStep {
  double objective = 0.0, violation = 0.0;
  bool usable = false, with_gradient = false;
};

struct SearchReport {
  SearchStatus status = SearchStatus::not_run;
  std::string algorithm, message;
  Eigen::VectorXd best_x;
  Evaluation best;
  bool feasible = false;    // best satisfies every constraint
  int evaluations = 0;      // asked for by the solver, repeats included
  int gradients = 0;        // of these, with gradient
  int simulations = 0;      // really computed, not answered from the store
  int best_evaluation = 0;  // 1-based number of the evaluation that found the best, 0 = none
  // Every evaluation, in an order that does not depend on the number of threads: runs made side by side one after the
  // other.
  std::vector<SearchStep> history;

  /// Counts an evaluation at x and keeps it if it is the best; returns whether it is.
  bool take(const Eigen::VectorXd& x, const Evaluation& evaluation, bool with_gradient, double constraint_tolerance);
  /// Appends the evaluations of a later part of the same search.
  void append(const SearchReport& later, double constraint_tolerance);
};

/// The first thing wrong with a problem's variables (sizes, bounds, start outside them) as a sentence; empty if none.
std::string problem_fault(const SearchProblem& problem);

/// What is wrong with a start (size, outside the bounds) as a sentence; empty if nothing.
std::string start_fault(const SearchProblem& problem, const Eigen::VectorXd& x);

/// The evaluation as a solver may see it: a value that is not finite makes it unusable, with a large finite objective
/// and every constraint violated; a gradient that is not finite, or of the wrong size, is not valid.
Evaluation sanitised(Evaluation evaluation, const SearchProblem& problem);

/// Maps the box lower <= x <= upper to the unit cube, logarithmically where the problem asks for it.
class UnitCube {
 public:
  explicit UnitCube(const SearchProblem& problem);
  Eigen::VectorXd to_unit(const Eigen::VectorXd& x) const;
  /// Clamped to the bounds.
  Eigen::VectorXd from_unit(const Eigen::VectorXd& z) const;
  /// dx_i/dz_i at x.
  Eigen::VectorXd slope(const Eigen::VectorXd& x) const;

 private:
  Eigen::VectorXd lower_, upper_;
  std::vector<bool> logarithmic_;
};

/// Ranking of evaluations everywhere: usable before not, feasible before infeasible, then objective; among the
/// infeasible the smaller violation.
bool better(const Evaluation& a, const Evaluation& b, double tolerance = 1e-6);

}  // namespace stillhook
