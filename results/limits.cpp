#include "results/limits.h"

#include <cmath>

namespace stillhook {

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

double relative_margin(const LimitCheck& check) {
  const double infinity = std::numeric_limits<double>::infinity();
  if (!std::isfinite(check.margin)) return -infinity;
  if (check.limit == 0.0) return check.pass ? infinity : -infinity;
  return check.margin / std::abs(check.limit);
}

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
