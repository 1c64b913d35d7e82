#include "tuning/fit.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <cmath>
#include <exception>
#include <memory>

namespace stillhook {
namespace {

/// Runs every unit at the blocks' values.
class UnitRunner {
 public:
  explicit UnitRunner(const FitProblem& problem) : problem_(problem) {}

  /// The last two points are remembered: with bounds, Ceres comes back to where it has been.
  void go_to(const std::vector<VectorX>& blocks) {
    if (!point_.empty() && blocks == point_) return;
    std::swap(point_, former_point_);
    std::swap(values_, former_values_);
    if (!point_.empty() && blocks == point_) return;
    point_ = blocks;
    values_.resize(problem_.units.size());
    run(blocks);
  }

  const UnitValues& values(std::size_t unit) const { return values_[unit]; }
  /// Why the first unit that failed at the first point did; empty if none.
  const std::string& first_failure() const { return first_failure_; }
  std::vector<UnitValues> take() { return std::move(values_); }
  int evaluations() const { return evaluations_; }
  std::exception_ptr first_error() const { return first_error_; }

 private:
  void run(const std::vector<VectorX>& blocks) {
    ++evaluations_;
    std::vector<std::exception_ptr> errors(values_.size());
#pragma omp parallel for schedule(dynamic, 1)
    for (std::size_t u = 0; u < values_.size(); ++u) {
      const FitUnit& unit = problem_.units[u];
      std::vector<VectorX> x;
      for (const int block : unit.blocks) x.push_back(blocks[static_cast<std::size_t>(block)]);
      values_[u].ok = false;
      try {
        values_[u].message = unit.evaluate(x, values_[u].r, values_[u].J);
        bool finite = values_[u].r.allFinite();
        for (const MatrixX& J : values_[u].J) finite = finite && J.allFinite();
        if (values_[u].message.empty() && !finite) values_[u].message = "the simulation gives values that are no numbers";
        values_[u].ok = values_[u].message.empty();
      } catch (...) {
        errors[u] = std::current_exception();
      }
    }
    if (evaluations_ > 1) return;
    for (const std::exception_ptr& error : errors)
      if (error) first_error_ = error;
    for (const UnitValues& values : values_)
      if (first_failure_.empty()) first_failure_ = values.message;
  }

  const FitProblem& problem_;
  std::vector<VectorX> point_, former_point_;
  std::vector<UnitValues> values_, former_values_;
  std::exception_ptr first_error_;
  std::string first_failure_;
  int evaluations_ = 0;
};

/// Ceres tells where it will look; all simulations run then.
class RunBeforeEvaluation final : public ceres::EvaluationCallback {
 public:
  RunBeforeEvaluation(std::vector<VectorX>& blocks, UnitRunner& runner) : blocks_(blocks), runner_(runner) {}

  void PrepareForEvaluation(bool /*evaluate_jacobians*/, bool /*new_point*/) override {
    // A point is first asked for its cost and, if it is taken, for its derivatives: one run gives both.
    runner_.go_to(blocks_);
  }

 private:
  std::vector<VectorX>& blocks_;
  UnitRunner& runner_;
};

/// One residual of a unit, read from what the run left.
class SampleCost final : public ceres::CostFunction {
 public:
  SampleCost(const UnitRunner& runner, std::size_t u, const FitGroup& group, const FitProblem& problem, Eigen::Index row)
      : runner_(runner), unit_(u), uses_(group.uses), row_(row) {
    const FitUnit& unit = problem.units[u];
    set_num_residuals(1);
    for (const int use : uses_)
      mutable_parameter_block_sizes()->push_back(static_cast<int>(
          problem.blocks[static_cast<std::size_t>(unit.blocks[static_cast<std::size_t>(use)])].value.size()));
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    const UnitValues& values = runner_.values(unit_);
    if (!values.ok) return false;
    residuals[0] = values.r[row_];
    if (!jacobians) return true;
    for (std::size_t i = 0; i < uses_.size(); ++i) {
      if (!jacobians[i]) continue;
      const MatrixX& J = values.J[static_cast<std::size_t>(uses_[i])];
      for (Eigen::Index j = 0; j < J.cols(); ++j) jacobians[i][j] = J(row_, j);
    }
    return true;
  }

 private:
  const UnitRunner& runner_;
  std::size_t unit_;
  const std::vector<int>& uses_;
  Eigen::Index row_;
};

class Watch final : public ceres::IterationCallback {
 public:
  explicit Watch(const FitOptions& options) : options_(options) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& s) override {
    if (options_.progress) options_.progress({s.iteration, s.cost});
    if (options_.stop && options_.stop->load()) return ceres::SOLVER_ABORT;
    // A step that fails by less than the tolerance has met the noise of the simulation: shorter ones would, too.
    const bool still = s.iteration > 0 && std::abs(s.cost_change) <= options_.tolerance * s.cost;
    return still ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const FitOptions& options_;
};

void add_blocks(const FitProblem& problem, std::vector<VectorX>& x, ceres::Problem& out) {
  for (std::size_t b = 0; b < x.size(); ++b) {
    const FitBlock& block = problem.blocks[b];
    if (x[b].size() == 0) continue;
    out.AddParameterBlock(x[b].data(), static_cast<int>(x[b].size()));
    if (block.constant) {
      out.SetParameterBlockConstant(x[b].data());
      continue;
    }
    for (Eigen::Index i = 0; i < block.lower.size(); ++i) {
      if (std::isfinite(block.lower[i])) out.SetParameterLowerBound(x[b].data(), static_cast<int>(i), block.lower[i]);
      if (std::isfinite(block.upper[i])) out.SetParameterUpperBound(x[b].data(), static_cast<int>(i), block.upper[i]);
    }
  }
}

void add_residuals(const FitProblem& problem, const UnitRunner& runner, std::vector<VectorX>& x,
                   ceres::LossFunction* robust, ceres::Problem& out) {
  for (std::size_t u = 0; u < problem.units.size(); ++u) {
    const FitUnit& unit = problem.units[u];
    Eigen::Index row = 0;
    for (const FitGroup& group : unit.groups) {
      std::vector<double*> blocks;
      for (const int use : group.uses)
        blocks.push_back(x[static_cast<std::size_t>(unit.blocks[static_cast<std::size_t>(use)])].data());
      for (int i = 0; i < group.count; ++i, ++row)
        out.AddResidualBlock(new SampleCost(runner, u, group, problem, row),
                             group.robust ? robust : nullptr, blocks);
    }
  }
}

ceres::Solver::Options solver_options(const FitProblem& problem, const FitOptions& options) {
  ceres::Solver::Options o;
  Eigen::Index unknowns = 0;
  for (const FitBlock& block : problem.blocks) unknowns += block.value.size();
  // QR for a handful of unknowns; with hundreds, when segments have their own beginnings, it would take most of the time.
  o.linear_solver_type = unknowns > 80 ? ceres::DENSE_NORMAL_CHOLESKY : ceres::DENSE_QR;
  o.max_num_iterations = options.iterations;
  o.function_tolerance = options.tolerance;
  o.parameter_tolerance = 1e-9;
  o.gradient_tolerance = 1e-12;
  o.num_threads = 1;  // the work is in the simulations, which run in parallel before
  o.minimizer_progress_to_stdout = false;
  o.logging_type = ceres::SILENT;
  o.max_num_consecutive_invalid_steps = 8;
  o.max_num_line_search_step_size_iterations = 1;  // each a run of all records; shorter steps are the trust region's
  return o;
}

}  // namespace

int FitUnit::residuals() const {
  int count = 0;
  for (const FitGroup& group : groups) count += group.count;
  return count;
}

std::vector<UnitValues> evaluate_units(const FitProblem& problem) {
  UnitRunner runner(problem);
  std::vector<VectorX> x;
  for (const FitBlock& block : problem.blocks) x.push_back(block.value);
  runner.go_to(x);
  if (runner.first_error()) std::rethrow_exception(runner.first_error());
  return runner.take();
}

FitOutcome solve_fit(FitProblem& problem, const FitOptions& options) {
  std::vector<VectorX> x;
  for (const FitBlock& block : problem.blocks) x.push_back(block.value);
  UnitRunner runner(problem);
  RunBeforeEvaluation before(x, runner);
  ceres::HuberLoss robust(options.robust);
  ceres::Problem::Options o;
  o.evaluation_callback = &before;
  o.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem ceres_problem(o);
  add_blocks(problem, x, ceres_problem);
  add_residuals(problem, runner, x, &robust, ceres_problem);
  ceres::Solver::Options with = solver_options(problem, options);
  Watch watch(options);
  with.callbacks.push_back(&watch);
  with.update_state_every_iteration = true;
  ceres::Solver::Summary summary;
  FLAGS_minloglevel = google::GLOG_FATAL;  // what goes wrong is in the outcome, not on stderr
  ceres::Solve(with, &ceres_problem, &summary);
  if (runner.first_error()) std::rethrow_exception(runner.first_error());
  FitOutcome outcome;
  outcome.usable = summary.IsSolutionUsable();
  outcome.converged = summary.termination_type == ceres::CONVERGENCE ||
                      summary.termination_type == ceres::USER_SUCCESS;
  outcome.interrupted = options.stop && options.stop->load();
  outcome.message = runner.first_failure().empty() ? summary.message : runner.first_failure();
  outcome.cost = summary.final_cost;
  outcome.iterations = static_cast<int>(summary.iterations.size());
  outcome.evaluations = runner.evaluations();
  if (!outcome.usable) return outcome;
  for (std::size_t b = 0; b < x.size(); ++b) problem.blocks[b].value = x[b];
  runner.go_to(x);  // mostly where it is
  outcome.units = runner.take();
  return outcome;
}

}  // namespace stillhook
