#include "results/limits.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stillhook {
namespace {

/// What a metric is in a lift that nothing moves: 1 of a tension over its static value, else 0.
double value_at_rest(const std::string& metric) {
  const bool ratio = metric == "daf_max" || metric == "daf_total" || metric.starts_with("daf.") ||
                     metric.starts_with("slack_ratio_min");
  return ratio ? 1.0 : 0.0;
}

}  // namespace

std::vector<LimitCheck> check_limits(const std::vector<LimitSpec>& limits, const Metrics& metrics) {
  std::vector<LimitCheck> checks;
  const auto check = [&](const LimitSpec& spec, double limit, bool is_max) {
    LimitCheck c;
    c.metric = spec.metric;
    c.source = spec.source;
    c.hard = spec.hard;
    c.is_max = is_max;
    c.limit = limit;
    if (const Metric* m = metrics.find(spec.metric)) {
      c.unit = m->unit;
      c.value = m->value;
      c.time = m->time;
      c.phase = m->phase;
      c.scenario = m->scenario;
    }
    c.margin = is_max ? limit - c.value : c.value - limit;
    c.pass = std::isfinite(c.value) && c.margin >= 0.0;
    checks.push_back(c);
  };
  for (const LimitSpec& spec : limits) {
    if (spec.max) check(spec, *spec.max, true);
    if (spec.min) check(spec, *spec.min, false);
  }
  return checks;
}

double limit_use(const LimitCheck& check) {
  const double infinity = std::numeric_limits<double>::infinity();
  if (!std::isfinite(check.margin)) return infinity;
  const double rest = value_at_rest(check.metric);
  const double allowed = check.limit - rest, used = check.value - rest;
  if (rest != 0.0 && (check.is_max ? allowed > 0.0 : allowed < 0.0)) return used / allowed;
  if (check.limit == 0.0) return check.pass ? 0.0 : infinity;
  if (!check.is_max && check.limit > 0.0) return check.value > 0.0 ? check.limit / check.value : infinity;
  return 1.0 - check.margin / std::abs(check.limit);
}

std::string limit_use_text(const LimitCheck& check) {
  const double use = limit_use(check);
  if (!std::isfinite(use) || check.limit == 0.0) return {};
  const double shown = std::max(0.0, use);
  return shown < 3.0 ? fmt::format("{:.{}f} % of what it allows", 100.0 * shown, shown > 0.995 && shown < 1.005 ? 2 : 0)
                     : fmt::format("{:.3g} times what it allows", shown);
}

double relative_margin(const LimitCheck& check) { return 1.0 - limit_use(check); }

const LimitCheck* governing_check(const std::vector<LimitCheck>& checks) {
  const LimitCheck* governing = nullptr;
  for (const LimitCheck& c : checks) {
    const bool first = !governing || (c.hard && !governing->hard);
    if (first || (c.hard == governing->hard && relative_margin(c) < relative_margin(*governing))) governing = &c;
  }
  return governing;
}

bool within_limits(const Metrics& metrics, const std::vector<LimitCheck>& checks) {
  if (metrics.status != RunStatus::completed) return false;
  for (const LimitCheck& c : checks)
    if (c.hard && !c.pass) return false;
  return true;
}

}  // namespace stillhook
