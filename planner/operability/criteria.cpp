#include "planner/operability/criteria.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "results/limits.h"
#include "results/metrics.h"

namespace stillhook {
namespace {

constexpr double kBrokenUse = std::numeric_limits<double>::infinity();

/// Share of what the limit allows; infinite where it is broken without one.
double use_of(const Criterion& criterion, double value) {
  LimitCheck check;
  check.metric = criterion.metric;
  check.is_max = criterion.is_max;
  check.limit = criterion.limit;
  check.value = value;
  check.margin = criterion.is_max ? criterion.limit - value : value - criterion.limit;
  check.pass = std::isfinite(value) && check.margin >= 0.0;
  const double use = limit_use(check);
  // Rounding at the limit itself, and limits of the other sign, must not turn a verdict.
  if (check.pass) return std::clamp(use, 0.0, 1.0);
  return use > 1.0 ? use : kBrokenUse;
}

double in_phase(const Metrics& metrics, const std::string& name, const std::string& phase) {
  const Metric* metric = metrics.find(name);
  if (!metric) return kNaN;
  for (const PhaseValue& here : metric->by_phase)
    if (here.phase == phase) return here.value;
  return metric->by_phase.empty() && metric->phase == phase ? metric->value : kNaN;
}

LiftValues without_values(const std::vector<Criterion>& criteria, std::size_t phases) {
  LiftValues all;
  all.values.assign(criteria.size(), std::vector<double>(phases + 1, kNaN));
  return all;
}

double worse_of(const Criterion& criterion, double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) ? b : a;
  return criterion.is_max ? std::max(a, b) : std::min(a, b);
}

}  // namespace

std::vector<Criterion> criteria_of(const Case& c) {
  std::vector<Criterion> criteria;
  for (const LimitSpec& limit : c.limits) {
    if (!limit.hard) continue;
    const MetricDefinition* metric = metric_definition(limit.metric);
    const bool smooth = metric && metric->quantity != Quantity::count;
    const bool both = limit.max && limit.min;
    if (limit.max) criteria.push_back({limit.metric + (both ? " max" : ""), limit.metric, *limit.max, true, smooth});
    if (limit.min) criteria.push_back({limit.metric + (both ? " min" : ""), limit.metric, *limit.min, false, smooth});
  }
  criteria.push_back({kNotCompleted, kNotCompleted, 0.0, true, false});
  return criteria;
}

LiftValues values_of(const Metrics& metrics, const Trajectory& run, const std::vector<Criterion>& criteria,
                     const std::vector<std::string>& phases) {
  LiftValues all = without_values(criteria, phases.size());
  all.status = metrics.status;
  all.message = metrics.message;
  for (std::size_t k = 0; k + 1 < criteria.size(); ++k) {
    all.values[k][0] = metrics.value(criteria[k].metric);
    for (std::size_t p = 0; p < phases.size(); ++p)
      all.values[k][p + 1] = in_phase(metrics, criteria[k].metric, phases[p]);
  }
  const bool completed = metrics.status == RunStatus::completed;
  all.values.back().assign(phases.size() + 1, 0.0);
  if (completed || run.phases.empty()) {
    all.values.back()[0] = completed ? 0.0 : 1.0;
    return all;
  }
  // It ends in the phase that was under way, and says nothing of those that it did not reach.
  const double end = std::isnan(metrics.failed_at) ? run.phases.back().end : metrics.failed_at;
  all.values.back()[0] = 1.0;
  for (std::size_t p = 0; p < phases.size(); ++p) {
    const auto ran = std::find_if(run.phases.begin(), run.phases.end(),
                                  [&](const PhaseRecord& phase) { return phase.name == phases[p]; });
    if (ran == run.phases.end())
      all.values.back()[p + 1] = kNaN;
    else if (end >= ran->start && end <= ran->end)
      all.values.back()[p + 1] = 1.0;
  }
  return all;
}

void merge_phase(LiftValues& all, const Metrics& metrics, const std::vector<Criterion>& criteria,
                 const std::vector<std::string>& phases, std::size_t phase) {
  if (all.values.empty()) {
    all = without_values(criteria, phases.size());
    all.status = RunStatus::completed;
    all.values.back()[0] = 0.0;
  }
  const bool completed = metrics.status == RunStatus::completed;
  for (std::size_t k = 0; k + 1 < criteria.size(); ++k) {
    const double value = in_phase(metrics, criteria[k].metric, phases[phase]);
    all.values[k][phase + 1] = value;
    all.values[k][0] = worse_of(criteria[k], all.values[k][0], value);
  }
  all.values.back()[phase + 1] = completed ? 0.0 : 1.0;
  if (completed) return;
  all.values.back()[0] = 1.0;
  if (all.status == RunStatus::completed) {
    all.status = metrics.status;
    all.message = phases[phase] + ": " + metrics.message;
  }
}

std::vector<double> uses_of(const LiftValues& run, const std::vector<Criterion>& criteria, bool phases_alone) {
  std::vector<double> uses;
  for (std::size_t k = 0; k < criteria.size(); ++k)
    for (std::size_t place = 0; place < run.values[k].size(); ++place) {
      const double value = run.values[k][place];
      const bool needed = place == 0 && !phases_alone && run.status == RunStatus::completed;
      // A phase that an earlier one has kept the lift from is not known to be possible: not_completed has no value
      // there.
      if (k + 1 == criteria.size())
        uses.push_back(value == 0.0 ? 0.0 : kBrokenUse);
      else if (std::isnan(value))
        uses.push_back(needed ? kBrokenUse : kNaN);
      else
        uses.push_back(use_of(criteria[k], value));
    }
  return uses;
}

std::vector<ColumnCell> cells_of(const std::vector<Criterion>& criteria, std::size_t phases) {
  std::vector<ColumnCell> cells;
  for (const Criterion& criterion : criteria)
    for (std::size_t place = 0; place <= phases; ++place) cells.push_back({criterion.name, criterion.smooth});
  return cells;
}

std::vector<ColumnTarget> targets_of(const std::vector<Criterion>& criteria, const std::vector<std::string>& phases) {
  const std::size_t places = phases.size() + 1;
  std::vector<ColumnTarget> targets(places);
  for (std::size_t place = 0; place < places; ++place) {
    targets[place].name = place == 0 ? "all" : phases[place - 1];
    for (std::size_t k = 0; k < criteria.size(); ++k) targets[place].cells.push_back(k * places + place);
  }
  for (std::size_t k = 0; k < criteria.size(); ++k) targets.push_back({criteria[k].name, {k * places}});
  return targets;
}

}  // namespace stillhook
