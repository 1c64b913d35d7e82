// What the callbacks of every solver share: one run of one solver on a problem seen in the unit cube.
//
//   z in [0, 1]^n  ->  x(z) in the box,   df/dz = df/dx dx/dz
//
// Solvers ask for objective, constraints and gradients separately, at the same point one after the other; the last
// evaluation answers them all.
#pragma once

#include <chrono>
#include <exception>

#include "problems/search/solve.h"
#include "problems/search/solvers.h"

namespace stillhook {

/// An evaluation as the solver sees it.
struct UnitEvaluation {
  bool usable = false, gradient_valid = false;
  double objective = 0.0;
  Eigen::VectorXd constraints;         // with the margin (SolverRun::margin) added to those that want <= 0
  Eigen::VectorXd objective_gradient;  // by z, if valid
  // By z, if valid; a row per constraint, row after row as the solvers' C interfaces want it.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian;
};

class SolverRun {
 public:
  SolverRun(const SearchProblem& problem, const SolveOptions& options, const Solver& solver);

  int variables() const { return static_cast<int>(problem_.start.size()); }
  int constraints() const { return static_cast<int>(problem_.constraint_names.size()); }
  int equalities() const { return problem_.equalities; }
  const SolveOptions& options() const { return options_; }
  const Eigen::VectorXd& start_unit() const { return start_unit_; }
  /// By how much the solver is to stay inside the limits.
  double margin() const { return margin_; }
  /// What the solver may take for zero.
  double tolerance() const { return margin_ > 0.0 ? margin_ : options_.constraint_tolerance; }

  /// True if z is the point of the last evaluation, which at() then returns without computing anything.
  bool is_last(const double* z) const;

  /// The evaluation at z, with gradients if the solver needs them; null if the run has ended. Made for callbacks from
  /// C: never throws.
  const UnitEvaluation* at(const double* z) noexcept;

  /// Tells that a gradient was needed at the last point, which has none. Ends the run.
  void miss_gradient() noexcept { end_ = End::gradient_missing; }

  /// True when the solver has to stop.
  bool ended() const { return end_ != End::none; }
  /// Evaluations at which gradients were wanted and not valid.
  int invalid_gradients() const { return invalid_gradients_; }
  /// The best point found is usable and within the tolerance.
  bool feasible() const;

  /// The report. `status` and `message` are the solver's own, used if nothing ended the run from here. Throws the
  /// exception that ended the run, if one did.
  SearchReport conclude(SearchStatus status, const std::string& message);

 private:
  enum class End { none, interrupted, time_used, budget_used, gradient_missing, error };
  bool may_go_on();
  void evaluate(const Eigen::VectorXd& unit);
  void set_last(const Eigen::VectorXd& x, const Evaluation& evaluation);

  const SearchProblem& problem_;
  const SolveOptions& options_;
  bool with_gradient_;
  UnitCube cube_;
  std::chrono::steady_clock::time_point begin_;
  Eigen::VectorXd start_, start_unit_, last_unit_;
  double margin_;
  bool has_last_ = false;
  UnitEvaluation last_;
  int invalid_gradients_ = 0;
  End end_ = End::none;
  std::exception_ptr error_;
  SearchReport report_;
};

}  // namespace stillhook
