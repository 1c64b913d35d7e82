#include "planner/sensitivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stillhook {
namespace {

constexpr double kActive = 0.02;   // a scaled constraint above minus this is active
constexpr double kAtBound = 1e-3;  // share of the range

/// Nonnegative least squares min |a + G m|, m >= 0, column by column (coordinate descent; a handful of columns).
Eigen::VectorXd nonnegative(const Eigen::VectorXd& a, const Eigen::MatrixXd& G) {
  Eigen::VectorXd m = Eigen::VectorXd::Zero(G.cols()), r = a;
  for (int sweep = 0; sweep < 10000; ++sweep) {
    double moved = 0.0;
    for (Eigen::Index i = 0; i < G.cols(); ++i) {
      const double size = G.col(i).squaredNorm();
      if (size == 0.0) continue;
      const double next = std::max(0.0, m[i] - G.col(i).dot(r) / size);
      r += (next - m[i]) * G.col(i);
      moved = std::max(moved, std::abs(next - m[i]) * std::sqrt(size));
      m[i] = next;
    }
    if (moved <= 1e-12 * (1.0 + a.norm())) break;
  }
  return m;
}

void add_prices(const Evaluator& evaluator, const Eigen::VectorXd& x, const Evaluation& e, PlanSensitivities& s) {
  const auto& variables = evaluator.base().plan.variables;
  const Eigen::Index n = x.size();
  Eigen::VectorXd range(n);
  for (Eigen::Index j = 0; j < n; ++j)
    range[j] = variables[static_cast<std::size_t>(j)].upper - variables[static_cast<std::size_t>(j)].lower;
  // In shares of the ranges, so that the variables are comparable.
  const Eigen::VectorXd gradient = e.objective_gradient.cwiseProduct(range);
  std::vector<Eigen::VectorXd> columns;
  std::vector<Eigen::Index> of_limit;
  for (Eigen::Index i = 0; i < e.constraints.size(); ++i) {
    if (e.constraints[i] < -kActive) continue;
    columns.push_back(e.constraint_jacobian.row(i).transpose().cwiseProduct(range));
    of_limit.push_back(i);
  }
  const std::size_t limits = columns.size();
  for (Eigen::Index j = 0; j < n; ++j) {
    const VariableSpec& v = variables[static_cast<std::size_t>(j)];
    const double place = (x[j] - v.lower) / range[j];
    if (place > kAtBound && place < 1.0 - kAtBound) continue;
    columns.push_back(Eigen::VectorXd::Unit(n, j) * (place <= kAtBound ? -1.0 : 1.0));
  }
  Eigen::MatrixXd G(n, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) G.col(static_cast<Eigen::Index>(k)) = columns[k];
  const Eigen::VectorXd m = nonnegative(gradient, G);
  s.residual = gradient.norm() > 0.0 ? (gradient + G * m).norm() / gradient.norm() : 0.0;
  for (std::size_t k = 0; k < limits; ++k) {
    const ConstraintSpec& c = evaluator.constraints()[static_cast<std::size_t>(of_limit[k])];
    const MetricDefinition* metric = metric_definition(c.metric);
    s.prices.push_back({c.metric, metric ? metric->unit : "", m[static_cast<Eigen::Index>(k)] / c.scale});
  }
}

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
  add_prices(evaluator, x, e, s);
  return s;
}

std::vector<ReportTable> sensitivity_tables(const Evaluator& evaluator, const PlanSensitivities& s) {
  if (!s.valid) return {};
  const auto& variables = evaluator.base().plan.variables;
  ReportTable slopes{
      "What moves the objective",
      "Change for a tenth of each variable's range, by exact derivatives at the plan; peaks, re-hits and "
      "shares through their smooth counterparts.",
      {"", "a tenth of the range", "objective"},
      {}};
  for (std::size_t k = 0; k < s.metrics.size(); ++k)
    slopes.header.push_back(s.units[k] == "1" || s.units[k].empty() ? s.metrics[k] : s.metrics[k] + ", " + s.units[k]);
  for (std::size_t j = 0; j < variables.size(); ++j) {
    const double step = 0.1 * (variables[j].upper - variables[j].lower);
    const Eigen::Index c = static_cast<Eigen::Index>(j);
    std::vector<std::string> row = {variables[j].key, fmt::format("{:.4g}", step),
                                    fmt::format("{:+.3g}", step * s.objective[c])};
    for (Eigen::Index k = 0; k < s.slope.rows(); ++k) row.push_back(fmt::format("{:+.3g}", step * s.slope(k, c)));
    slopes.rows.push_back(row);
  }
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
  return {slopes, prices};
}

}  // namespace stillhook
