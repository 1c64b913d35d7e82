#include "planner/plan_results.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "problems/scenarios.h"

namespace stillhook {
namespace {

double equivalents(const Evaluator& evaluator, const PlanResult& result) {
  return (result.distinct + kGradientCharge * result.gradient.gradients) *
         static_cast<double>(evaluator.scenarios().size());
}

std::string algorithms_of(const PlanResult& result) {
  if (result.gradient.status == SearchStatus::not_run) return result.search.algorithm;
  return result.gradient.algorithm + "+" + result.search.algorithm;
}

double objective_or_nan(const Evaluation& evaluation) {
  return evaluation.usable ? evaluation.objective : std::numeric_limits<double>::quiet_NaN();
}

bool feasible(const Evaluation& evaluation) { return evaluation.usable && evaluation.violation() <= 0.0; }

}  // namespace

std::vector<LimitCheck> limits_of(const Evaluator& evaluator, const ScenarioOutcome& outcome) {
  Metrics metrics;
  metrics.status = outcome.status;
  for (std::size_t i = 0; i < outcome.metrics.size(); ++i) {
    if (std::isnan(outcome.metrics[i])) continue;
    Metric metric;
    metric.name = evaluator.metric_names()[i];
    if (const MetricDefinition* definition = metric_definition(metric.name)) metric.unit = definition->unit;
    metric.value = outcome.metrics[i];
    metrics.items.push_back(metric);
  }
  return check_limits(evaluator.base().limits, metrics);
}

std::vector<LimitCheck> worst_limits(const std::vector<std::vector<LimitCheck>>& by_scenario) {
  std::vector<LimitCheck> worst;
  for (const std::vector<LimitCheck>& checks : by_scenario) {
    if (worst.empty()) worst = checks;
    for (std::size_t i = 0; i < checks.size(); ++i) {
      // A value that could not be computed is the worst there is.
      const bool smaller = std::isnan(checks[i].margin) || checks[i].margin < worst[i].margin;
      if (smaller && !std::isnan(worst[i].margin)) worst[i] = checks[i];
    }
  }
  return worst;
}

std::vector<LimitCheck> worst_limits(const Evaluator& evaluator, const Evaluation& evaluation) {
  std::vector<std::vector<LimitCheck>> all;
  for (const ScenarioOutcome& outcome : evaluator.outcomes(evaluation)) all.push_back(limits_of(evaluator, outcome));
  return worst_limits(all);
}

std::size_t governing_scenario(const Evaluator& evaluator, const Evaluation& evaluation) {
  const std::vector<ScenarioOutcome> outcomes = evaluator.outcomes(evaluation);
  std::size_t governing = 0;
  double closest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const double value = evaluator.closeness(outcomes[i]);
    if (!(value > closest)) continue;
    closest = value;
    governing = i;
  }
  return governing;
}

Specification specification_at(const Evaluator& evaluator, const Eigen::VectorXd& x, std::size_t scenario) {
  return in_scenario(evaluator.case_at(x).specification, evaluator.scenarios()[scenario]);
}

std::string scenario_text(const ScenarioSpec& scenario) {
  std::string text = fmt::format("{}: sea {}", scenario.name, scenario.sea);
  const auto degrees = [](double rad) { return rad * 180.0 / std::numbers::pi; };
  if (scenario.heading) text += fmt::format(", towards {:.4g} deg", degrees(*scenario.heading));
  if (scenario.phase) text += fmt::format(", phase {:.4g} deg", degrees(*scenario.phase));
  if (scenario.seed) text += fmt::format(", seed {}", *scenario.seed);
  if (scenario.weight != 1.0) text += fmt::format(", weight {:.4g}", scenario.weight);
  return text;
}

std::string history_note(const Evaluator& evaluator, std::size_t scenario) {
  return "Histories and metrics show the scenario that comes closest to a limit: " +
         scenario_text(evaluator.scenarios()[scenario]) + ".";
}

SearchSection search_section(const Evaluator& evaluator, const PlanResult& result, double wall) {
  const PlanSpec& plan = evaluator.base().plan;
  const Evaluation& best = result.search.best;
  SearchSection s;
  s.algorithm = algorithms_of(result);
  s.status = result.search.message;
  s.evaluations = result.search.evaluations;
  s.seed = plan.seed;
  s.simulation_equivalents = equivalents(evaluator, result);
  s.wall = wall;
  s.baseline_objective = objective_or_nan(result.baseline);
  s.plan_objective = objective_or_nan(best);
  s.random_objective = objective_or_nan(result.random.best);
  s.baseline_feasible = feasible(result.baseline);
  s.plan_feasible = result.search.feasible;
  s.random_feasible = result.random.feasible;
  const std::vector<TermValue> before = evaluator.terms(result.baseline), after = evaluator.terms(best);
  for (std::size_t i = 0; i < plan.objective.size(); ++i) {
    const ObjectiveTerm& term = plan.objective[i];
    const MetricDefinition* metric = metric_definition(term.metric);
    s.terms.push_back({term.metric, metric ? metric->unit : "", term.weight, term.scale, before[i].value,
                       after[i].value, before[i].contribution, after[i].contribution});
  }
  for (std::size_t i = 0; i < plan.variables.size(); ++i) {
    const VariableSpec& v = plan.variables[i];
    const Eigen::Index k = static_cast<Eigen::Index>(i);
    s.variables.push_back({v.key, v.lower, v.upper, evaluator.baseline()[k],
                           result.search.best_x.size() ? result.search.best_x[k] : SearchSection::kNone});
  }
  s.baseline_limits = worst_limits(evaluator, result.baseline);
  s.plan_limits = worst_limits(evaluator, best);
  for (const PlanResult::Point& point : result.history) s.history.push_back({point.objective, point.feasible});
  for (const PlanResult::Point& point : result.random_history)
    s.random_history.push_back({point.objective, point.feasible});
  for (const ScenarioSpec& scenario : evaluator.scenarios()) s.scenarios.push_back(scenario_text(scenario));
  return s;
}

void add_search(const Evaluator& evaluator, const PlanResult& result, Summary& summary) {
  summary.objective = ObjectiveSummary{objective_or_nan(result.baseline), objective_or_nan(result.search.best),
                                       objective_or_nan(result.random.best)};
  summary.search = SearchSummary{algorithms_of(result), result.search.evaluations, equivalents(evaluator, result),
                                 evaluator.base().plan.seed};
  const std::vector<VariableSpec>& variables = evaluator.base().plan.variables;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const Eigen::Index k = static_cast<Eigen::Index>(i);
    summary.variables.push_back({variables[i].key, variables[i].lower, variables[i].upper, evaluator.baseline()[k],
                                 result.search.best_x.size() ? result.search.best_x[k] : SearchSection::kNone});
  }
}

}  // namespace stillhook
