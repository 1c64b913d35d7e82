#include "planner/verbs/plan/sensitivity.h"

#include <fmt/format.h>

#include "problems/search/multipliers.h"

namespace stillhook {
namespace {

// A scaled constraint above minus this is active, as is a bound within this share of the range: a search on metrics as
// they are ends near its limits, not on them.
constexpr double kActive = 0.02;

}  // namespace

PlanSensitivities plan_sensitivities(const Evaluator& evaluator, const Eigen::VectorXd& x) {
  PlanSensitivities s;
  SmoothSlopes slopes;
  const Evaluation e = evaluator.evaluate_smooth(x, {}, true, &slopes);
  s.valid = e.usable && e.gradient_valid;
  if (!s.valid) return s;
  s.metrics = slopes.metrics;
  s.slope = slopes.slope;
  for (const std::string& name : s.metrics) {
    const MetricDefinition* metric = metric_definition(name);
    s.units.push_back(metric ? metric->unit : "");
  }
  s.objective = e.objective_gradient;
  const Multipliers multipliers = multipliers_at(evaluator.problem(), x, e, kActive);
  s.residual = multipliers.residual;
  for (Eigen::Index i = 0; i < e.constraints.size(); ++i) {
    if (e.constraints[i] < -kActive) continue;
    const ConstraintSpec& c = evaluator.constraints()[static_cast<std::size_t>(i)];
    const MetricDefinition* metric = metric_definition(c.metric);
    s.prices.push_back({c.metric, metric ? metric->unit : "", multipliers.constraints[i] / c.scale});
  }
  return s;
}

SensitivityTable sensitivity_table(const Evaluator& evaluator, const PlanSensitivities& s) {
  SensitivityTable table;
  table.note =
      "Exact derivatives at the plan, mean over the scenarios; peaks, re-hits and shares through their smooth "
      "counterparts.";
  table.columns.push_back({"objective", "1"});
  for (std::size_t k = 0; k < s.metrics.size(); ++k) table.columns.push_back({s.metrics[k], s.units[k]});
  const auto& variables = evaluator.base().plan.variables;
  for (std::size_t j = 0; j < variables.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    SensitivityTable::Row row{variables[j].key, variables[j].upper - variables[j].lower, {s.objective[column]}};
    for (Eigen::Index k = 0; k < s.slope.rows(); ++k) row.derivative.push_back(s.slope(k, column));
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable price_table(const PlanSensitivities& s) {
  ReportTable prices{
      "What the limits cost",
      fmt::format("Fall of the objective for a limit looser by one unit, at the plan. Distance from the "
                  "conditions of optimality: {:.2g} of the gradient; the larger, the less the prices mean.",
                  s.residual),
      {"limit", "fall of the objective per unit"},
      {}};
  for (const PlanSensitivities::Price& p : s.prices)
    prices.rows.push_back(
        {p.metric, fmt::format("{:.4g}{}", p.per_unit, p.unit == "1" || p.unit.empty() ? "" : " per " + p.unit)});
  if (prices.rows.empty()) prices.note = "No limit is active at the plan: loosening one buys nothing.";
  return prices;
}

}  // namespace stillhook
