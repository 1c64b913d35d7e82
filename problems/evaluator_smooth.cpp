// The evaluator's smooth values and their exact derivatives.
#include <omp.h>

#include <cmath>
#include <exception>
#include <set>

#include "problems/evaluator.h"
#include "problems/scenarios.h"
#include "problems/tangent_run.h"
#include "results/changed_run.h"
#include "sim/simulate.h"
#include "sim/spatial/constants.h"

namespace stillhook {

namespace {
}

Eigen::VectorXd Evaluator::smooth_values(const Trajectory& run, const SmoothOptions& smooth) const {
  const Specification& specification = case_.specification;
  Eigen::VectorXd values(static_cast<Eigen::Index>(smooth_names_.size()));
  std::optional<Metrics> metrics;  // of those without a smooth counterpart
  for (std::size_t k = 0; k < smooth_names_.size(); ++k) {
    std::optional<double> value = smooth_metric(specification, run, smooth_names_[k], smooth);
    if (!value) {
      if (!metrics) metrics = compute_metrics(specification, run);
      value = metrics->value(smooth_names_[k]);
    }
    values[static_cast<Eigen::Index>(k)] = *value;
  }
  return values;
}

Evaluator::SmoothOutcome Evaluator::run_smooth(const Case& c, const ScenarioSpec& scenario, const SmoothOptions& smooth,
                                               bool gradient) const {
  SmoothOutcome result;
  result.outcome.metrics.assign(metric_names_.size(), kNaN);
  result.value = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(smooth_names_.size()), kNaN);
  result.slope = Eigen::MatrixXd::Zero(result.value.size(), static_cast<Eigen::Index>(case_.plan.variables.size()));
  double end = 0.0;
  RunOptions options;
  options.progress = [&](double, double t_end) {
    end = t_end;
    return !(stop_ && stop_->load());
  };
  TangentRequest request;
  request.condition = [&](const Specification& s) { return in_scenario(s, scenario); };
  request.part = case_.plan.part;
  std::set<std::string> channels;
  for (const std::string& name : smooth_names_)
    for (const std::string& channel : channels_of_metric(case_.specification, name)) channels.insert(channel);
  request.channels.assign(channels.begin(), channels.end());
  if (gradient)
    for (const VariableSpec& v : case_.plan.variables) {
      request.keys.push_back(v.key);
      request.ranges.push_back(v.upper - v.lower);
    }
  try {
    const TangentRun run = run_with_tangents(c, request, options);
    note_run(request.condition(c.specification), run.trajectory, end, result.outcome);
    if (result.outcome.status != RunStatus::completed) return result;
    const Trajectory reduced = reduced_run(run.trajectory, run.tangents);
    result.value = smooth_values(reduced, smooth);
    result.valid = gradient && run.tangents.valid;
    for (std::size_t j = 0; result.valid && j < request.keys.size(); ++j) {
      const double half = 0.5 * run.widths[j];
      const auto at = [&](int side) {
        return smooth_values(changed_run(reduced, run.tangents, static_cast<int>(j), side == 0 ? -half : half,
                                         run.static_poses[j][static_cast<std::size_t>(side)]),
                             smooth);
      };
      result.slope.col(static_cast<Eigen::Index>(j)) = (at(1) - at(0)) / run.widths[j];
    }
    result.valid = result.valid && result.slope.allFinite();
  } catch (const SpecificationError& error) {
    result.outcome.message = error.what();
  } catch (const CaseError& error) {
    result.outcome.message = error.what();
  }
  return result;
}

Evaluation Evaluator::aggregated_smooth(const std::vector<SmoothOutcome>& outcomes, bool gradient) const {
  std::vector<ScenarioOutcome> raw;
  for (const SmoothOutcome& outcome : outcomes) raw.push_back(outcome.outcome);
  Evaluation e = aggregated(raw);
  if (!e.usable) return e;
  const Eigen::Index terms = static_cast<Eigen::Index>(case_.plan.objective.size());
  const Eigen::Index n = static_cast<Eigen::Index>(case_.plan.variables.size());
  Eigen::VectorXd factor(terms);
  for (Eigen::Index k = 0; k < terms; ++k) {
    const ObjectiveTerm& term = case_.plan.objective[static_cast<std::size_t>(k)];
    factor[k] = term.weight / term.scale;
  }
  Eigen::VectorXd objectives(static_cast<Eigen::Index>(outcomes.size()));
  e.gradient_valid = gradient;
  for (std::size_t s = 0; s < outcomes.size(); ++s) {
    objectives[static_cast<Eigen::Index>(s)] = factor.dot(outcomes[s].value.head(terms));
    e.gradient_valid = e.gradient_valid && outcomes[s].valid;
  }
  const Eigen::VectorXd share = scenario_shares(objectives);
  e.objective = share.dot(objectives);
  e.objective_gradient = Eigen::VectorXd::Zero(n);
  for (std::size_t s = 0; s < outcomes.size(); ++s)
    e.objective_gradient +=
        share[static_cast<Eigen::Index>(s)] * (outcomes[s].slope.topRows(terms).transpose() * factor);
  e.constraint_jacobian = Eigen::MatrixXd::Zero(e.constraints.size(), n);
  for (Eigen::Index i = 0; i < e.constraints.size(); ++i) {
    const ConstraintSpec& c = constraints_[static_cast<std::size_t>(i)];
    const double sign = (c.is_max ? 1.0 : -1.0) / c.scale;
    std::vector<double> values;
    for (const SmoothOutcome& outcome : outcomes) values.push_back(sign * (outcome.value[terms + i] - c.limit));
    const std::size_t s = deciding(c.share, values);
    if (!std::isfinite(values[s])) {
      // The value as it is says what to think of it. Where there is one, its derivative is not zero but unknown.
      if (std::isfinite(metric_of(raw[s], c.metric))) e.gradient_valid = false;
      continue;
    }
    e.constraints[i] = values[s];
    e.constraint_jacobian.row(i) = sign * outcomes[s].slope.row(terms + i);
  }
  if (!std::isfinite(e.objective)) e.usable = false;
  return e;
}

Evaluation Evaluator::evaluate_smooth(const Eigen::VectorXd& x, const SmoothOptions& smooth, bool gradient,
                                      SmoothSlopes* slopes) const {
  std::vector<SmoothOutcome> outcomes(scenarios_.size());
  std::vector<std::exception_ptr> errors(scenarios_.size());
  Case changed;
  try {
    changed = case_at(x);
  } catch (const CaseError&) {
    return evaluate(x);  // says why
  }
#pragma omp parallel for schedule(dynamic, 1) if (!omp_in_parallel() && scenarios_.size() > 1)
  for (std::size_t i = 0; i < scenarios_.size(); ++i) {
    try {
      outcomes[i] = run_smooth(changed, scenarios_[i], smooth, gradient);
    } catch (...) {
      errors[i] = std::current_exception();
    }
  }
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  if (slopes) {
    std::set<std::string> seen;
    slopes->metrics.clear();
    slopes->slope.resize(0, static_cast<Eigen::Index>(case_.plan.variables.size()));
    for (std::size_t k = 0; k < smooth_names_.size(); ++k) {
      if (!seen.insert(smooth_names_[k]).second) continue;
      Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(slopes->slope.cols());
      double weights = 0.0;
      for (std::size_t s = 0; s < outcomes.size(); ++s) {
        sum += scenarios_[s].weight * outcomes[s].slope.row(static_cast<Eigen::Index>(k));
        weights += scenarios_[s].weight;
      }
      slopes->metrics.push_back(smooth_names_[k]);
      slopes->slope.conservativeResize(slopes->slope.rows() + 1, Eigen::NoChange);
      slopes->slope.bottomRows(1) = sum / weights;
    }
  }
  return aggregated_smooth(outcomes, gradient);
}

SearchProblem Evaluator::smooth_problem(const SmoothOptions& smooth) const {
  SearchProblem problem = this->problem();
  problem.evaluate = [this, smooth](const Eigen::VectorXd& x) { return evaluate_smooth(x, smooth, false); };
  problem.evaluate_with_gradient = [this, smooth](const Eigen::VectorXd& x) {
    return evaluate_smooth(x, smooth, true);
  };
  return problem;
}

}  // namespace stillhook
