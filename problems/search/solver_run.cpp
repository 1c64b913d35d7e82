#include "problems/search/solver_run.h"

namespace stillhook {
namespace {

// Solvers with gradients come to rest on the limits, to the last few digits of either side. Where the limits know no
// tolerance, this keeps them inside.
constexpr double kMargin = 1e-6;

}  // namespace

SolverRun::SolverRun(const SearchProblem& problem, const SolveOptions& options, const Solver& solver)
    : problem_(problem),
      options_(options),
      with_gradient_(solver.gradient),
      cube_(problem),
      begin_(std::chrono::steady_clock::now()),
      start_(options.starts.empty() ? problem.start : options.starts.front()),
      start_unit_(cube_.to_unit(start_)),
      margin_(solver.gradient && options.constraint_tolerance == 0.0 ? kMargin : 0.0) {
  report_.algorithm = solver.name;
}

bool SolverRun::is_last(const double* z) const {
  return has_last_ && Eigen::Map<const Eigen::VectorXd>(z, variables()) == last_unit_;
}

const UnitEvaluation* SolverRun::at(const double* z) noexcept {
  try {
    if (is_last(z)) return &last_;
    if (!may_go_on()) return nullptr;
    evaluate(Eigen::Map<const Eigen::VectorXd>(z, variables()));
  } catch (...) {
    error_ = std::current_exception();
    end_ = End::error;
  }
  return end_ == End::none || end_ == End::budget_used ? &last_ : nullptr;
}

bool SolverRun::may_go_on() {
  if (ended()) return false;
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin_;
  if (options_.should_stop && options_.should_stop())
    end_ = End::interrupted;
  else if (options_.time_budget > 0.0 && spent.count() > options_.time_budget)
    end_ = End::time_used;
  else if (report_.evaluations >= options_.evaluations)
    end_ = End::budget_used;
  return !ended();
}

void SolverRun::evaluate(const Eigen::VectorXd& unit) {
  // Scaling there and back is not exact to the last bit; the start itself must be evaluated as it was given.
  const Eigen::VectorXd x = unit == start_unit_ ? start_ : cube_.from_unit(unit);
  const Evaluation evaluation =
      sanitised(with_gradient_ ? problem_.evaluate_with_gradient(x) : problem_.evaluate(x), problem_);
  if (evaluation.interrupted) {
    end_ = End::interrupted;
    return;
  }
  const bool improved = report_.take(x, evaluation, with_gradient_, options_.constraint_tolerance);
  invalid_gradients_ += with_gradient_ && !evaluation.gradient_valid ? 1 : 0;
  set_last(x, evaluation);
  last_unit_ = unit;
  has_last_ = true;
  if (options_.progress)
    options_.progress({report_.algorithm, report_.evaluations, options_.evaluations, improved, &evaluation,
                       &report_.best, &report_.best_x});
  // Stopping at once, instead of at the next call, spares algorithms that would finish a generation first.
  if (report_.evaluations >= options_.evaluations) end_ = End::budget_used;
}

void SolverRun::set_last(const Eigen::VectorXd& x, const Evaluation& evaluation) {
  last_.usable = evaluation.usable;
  last_.gradient_valid = evaluation.gradient_valid;
  last_.objective = evaluation.objective;
  last_.constraints = evaluation.constraints;
  last_.constraints.tail(constraints() - equalities()).array() += margin_;
  if (!evaluation.gradient_valid) return;
  const Eigen::VectorXd slope = cube_.slope(x);
  last_.objective_gradient = evaluation.objective_gradient.cwiseProduct(slope);
  if (constraints() > 0) last_.jacobian = evaluation.constraint_jacobian * slope.asDiagonal();
}

bool SolverRun::feasible() const {
  return report_.best_evaluation > 0 && report_.best.usable &&
         report_.best.violation() <= options_.constraint_tolerance;
}

SearchReport SolverRun::conclude(SearchStatus status, const std::string& message) {
  if (error_) std::rethrow_exception(error_);
  report_.feasible = feasible();
  report_.status = status;
  report_.message = message;
  switch (end_) {
    case End::interrupted:
      report_.status = SearchStatus::interrupted;
      report_.message = "interrupted";
      break;
    case End::time_used:
      report_.status = SearchStatus::budget_used;
      report_.message = "time budget used";
      break;
    case End::budget_used:
      report_.status = SearchStatus::budget_used;
      report_.message = "evaluation budget used";
      break;
    case End::gradient_missing:
      report_.status = SearchStatus::gradient_invalid;
      report_.message = "no valid gradient where one was needed";
      break;
    case End::none:
    case End::error:
      break;
  }
  return report_;
}

}  // namespace stillhook
