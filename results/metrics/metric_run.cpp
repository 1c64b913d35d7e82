#include "results/metrics/metric_run.h"

#include <algorithm>

#include "results/metrics/metric_row.h"

namespace stillhook {

Peak MetricRun::in(const MetricRow& row, const std::string& element, std::size_t phase) {
  const std::string key = row.name + "\n" + element + "\n" + std::to_string(phase);
  const auto found = values_.find(key);
  if (found != values_.end()) return found->second;
  const Peak value = row.value(*this, element, {phase});
  values_.emplace(key, value);
  return value;
}

Peak MetricRun::over(const MetricRow& row, const std::string& element, const Phases& phases) {
  if (row.over == OverPhases::all_at_once)
    return phases.size() == 1 ? in(row, element, phases[0]) : row.value(*this, element, phases);
  Peak best;
  for (const std::size_t p : phases) {
    const Peak value = in(row, element, p);
    if (row.over == OverPhases::largest)
      best.take_larger(value.value, value.time);
    else
      best.take_smaller(value.value, value.time);
  }
  return best;
}

Peak MetricRun::largest_of(const std::string& row, const std::vector<std::string>& elements, const Phases& phases) {
  Peak largest;
  for (const std::string& element : elements) {
    const Peak value = over(metric_row(row), element, phases);
    largest.take_larger(value.value, value.time);
  }
  return largest;
}

Peak MetricRun::smallest_of(const std::string& row, const std::vector<std::string>& elements, const Phases& phases) {
  Peak smallest;
  for (const std::string& element : elements) {
    const Peak value = over(metric_row(row), element, phases);
    smallest.take_smaller(value.value, value.time);
  }
  return smallest;
}

void MetricRun::forget() {
  made_.clear();
  view_.forget();
}

Phases with_stage(const RunView& view, const Phases& phases, std::initializer_list<PhaseSpec::Stage> stages) {
  Phases some;
  for (const std::size_t p : phases)
    if (std::find(stages.begin(), stages.end(), view.run().phases[p].stage) != stages.end()) some.push_back(p);
  return some;
}

}  // namespace stillhook
