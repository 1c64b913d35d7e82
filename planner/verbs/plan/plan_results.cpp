#include "planner/verbs/plan/plan_results.h"

#include <fmt/format.h>

#include <algorithm>
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

Metrics metrics_of(const Evaluator& evaluator, const ScenarioOutcome& outcome) {
  Metrics metrics;
  metrics.status = outcome.status;
  metrics.message = outcome.message;
  for (std::size_t i = 0; i < outcome.metrics.size(); ++i) {
    if (std::isnan(outcome.metrics[i])) continue;
    Metric metric;
    metric.name = evaluator.metric_names()[i];
    if (const MetricDefinition* definition = metric_definition(metric.name)) metric.unit = definition->unit;
    metric.value = outcome.metrics[i];
    metrics.items.push_back(metric);
  }
  return metrics;
}

void in_catalogue_order(const Evaluator& evaluator, Metrics& metrics) {
  const std::vector<std::string>& names = evaluator.metric_names();
  const auto place = [&](const Metric& m) { return std::find(names.begin(), names.end(), m.name) - names.begin(); };
  std::stable_sort(metrics.items.begin(), metrics.items.end(),
                   [&](const Metric& a, const Metric& b) { return place(a) < place(b); });
}

}  // namespace

std::string unit_of_metric(const std::string& name) {
  const MetricDefinition* definition = metric_definition(name);
  return definition ? definition->unit : "";
}

std::vector<LimitCheck> limits_of(const Evaluator& evaluator, const ScenarioOutcome& outcome) {
  return check_limits(evaluator.base().limits, metrics_of(evaluator, outcome));
}

std::vector<LimitCheck> deciding_limits(const Evaluator& evaluator,
                                        const std::vector<std::vector<LimitCheck>>& by_scenario) {
  if (by_scenario.empty()) return {};
  std::vector<double> shares;  // as check_limits() makes one or two checks of a limit
  for (const LimitSpec& limit : evaluator.base().limits) {
    if (limit.max) shares.push_back(limit.share);
    if (limit.min) shares.push_back(limit.share);
  }
  std::vector<LimitCheck> decided;
  for (std::size_t k = 0; k < by_scenario.front().size(); ++k) {
    std::vector<double> excess;
    for (const std::vector<LimitCheck>& checks : by_scenario) {
      // A value that could not be computed is the worst there is.
      const bool known = std::isfinite(checks[k].margin);
      excess.push_back(known ? -checks[k].margin : std::numeric_limits<double>::infinity());
    }
    const std::size_t s = evaluator.deciding(shares[k], excess);
    decided.push_back(by_scenario[s][k]);
    if (by_scenario.size() > 1) decided.back().scenario = evaluator.scenarios()[s].name;
  }
  return decided;
}

std::vector<LimitCheck> deciding_limits(const Evaluator& evaluator, const Evaluation& evaluation) {
  std::vector<std::vector<LimitCheck>> all;
  for (const ScenarioOutcome& outcome : evaluator.outcomes(evaluation)) all.push_back(limits_of(evaluator, outcome));
  return deciding_limits(evaluator, all);
}

Metrics deciding_metrics(const Evaluator& evaluator, const std::vector<Metrics>& by_scenario,
                         const std::vector<LimitCheck>& limits, std::size_t shown) {
  if (by_scenario.empty()) return {};
  Metrics metrics = by_scenario[shown];
  if (by_scenario.size() == 1) return metrics;
  const auto name_of = [&](std::size_t s) { return evaluator.scenarios()[s].name; };
  for (std::size_t s = by_scenario.size(); s-- > 0;)
    if (by_scenario[s].status != RunStatus::completed) {
      metrics.status = by_scenario[s].status;
      metrics.message = name_of(s) + ": " + by_scenario[s].message;
      metrics.failed_at = by_scenario[s].failed_at;
    }
  for (Metric& metric : metrics.items) metric.scenario = name_of(shown);
  for (const LimitCheck& limit : limits)
    for (std::size_t s = 0; s < by_scenario.size(); ++s) {
      if (limit.scenario != name_of(s)) continue;
      const Metric* deciding = by_scenario[s].find(limit.metric);
      const auto place = std::find_if(metrics.items.begin(), metrics.items.end(),
                                      [&](const Metric& m) { return m.name == limit.metric; });
      if (place != metrics.items.end()) metrics.items.erase(place);
      if (!deciding) continue;  // a limit without a value is broken, another scenario's value would hide it
      metrics.items.push_back(*deciding);
      metrics.items.back().scenario = limit.scenario;
    }
  in_catalogue_order(evaluator, metrics);
  return metrics;
}

Metrics deciding_metrics(const Evaluator& evaluator, const Evaluation& evaluation) {
  std::vector<Metrics> all;
  for (const ScenarioOutcome& outcome : evaluator.outcomes(evaluation)) all.push_back(metrics_of(evaluator, outcome));
  return all.empty() ? Metrics() : deciding_metrics(evaluator, all, deciding_limits(evaluator, evaluation),
                                                    governing_scenario(evaluator, evaluation));
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

std::vector<std::string> scenario_warnings(const Evaluator& evaluator, const Case& c, const HydroProgress& progress) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < evaluator.scenarios().size(); ++i)
    for (const std::string& warning :
         prepare_run(c, specification_at(evaluator, evaluator.baseline(), i), progress).warnings)
      if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(warning);
  return warnings;
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
  return "Histories show the scenario that comes closest to a limit: " +
         scenario_text(evaluator.scenarios()[scenario]) +
         ". A limit, and the metric it limits, is of the scenario that decides whether it is kept.";
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
  s.baseline_limits = deciding_limits(evaluator, result.baseline);
  s.plan_limits = deciding_limits(evaluator, best);
  if (evaluator.scenarios().size() > 1 && result.has_plan())
    s.shown = evaluator.scenarios()[governing_scenario(evaluator, best)].name;
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
