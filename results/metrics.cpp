#include "results/metrics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "results/failures.h"
#include "results/metrics/metric_row.h"
#include "sim/crane_parts.h"

namespace stillhook {
namespace {

std::vector<std::string> element_names(MetricElement element, const std::string& noun, const Specification& s) {
  std::vector<std::string> names;
  const auto collect = [&](const auto& entries, auto wanted) {
    for (const auto& entry : entries)
      if (wanted(entry)) names.push_back(entry.name);
  };
  const auto any = [](const auto&) { return true; };
  const auto hoist = [](const WireSpec& w) { return w.role == WireSpec::Role::hoist; };
  const auto cranes = [&] {
    for (const std::string& crane : crane_bodies(s)) names.push_back(crane);
  };
  switch (element) {
    case MetricElement::none:
      break;
    case MetricElement::phase:
      collect(s.operation.phases, any);
      break;
    case MetricElement::wire:
      collect(s.wires, any);
      break;
    case MetricElement::wire_or_crane:
      collect(s.wires, any);
      cranes();
      break;
    case MetricElement::hoist_wire:
      collect(s.wires, hoist);
      break;
    case MetricElement::hoist_wire_or_crane:
      collect(s.wires, hoist);
      cranes();
      break;
    case MetricElement::crane:
      cranes();
      break;
    case MetricElement::crane_vessel:
      names = crane_vessels(s);
      break;
    case MetricElement::winch:
      collect(s.drives, [](const DriveSpec& d) { return d.kind == DriveSpec::Kind::winch; });
      break;
    case MetricElement::clearance:
      collect(s.clearances, any);
      break;
    case MetricElement::entry:
      for_each_element_kind([&](const auto& kind) {
        if (noun == kind.noun) collect(s.*kind.entries, any);
      });
      break;
  }
  return names;
}

std::string with_element(const std::string& pattern, const std::string& element) {
  const std::size_t place = pattern.find('%');
  return place == std::string::npos ? pattern : pattern.substr(0, place) + element;
}

/// The values of the rows of one run as metrics.
class MetricTable {
 public:
  MetricTable(const RunView& view, Metrics& metrics) : view_(view), run_(view), metrics_(metrics) {}

  void add(const MetricRow& row) {
    if (row.element == MetricElement::phase)
      add_phases(row);
    else if (row.element == MetricElement::none)
      add(row, "");
    else
      for (const std::string& element : element_names(row.element, row.kind, view_.specification())) add(row, element);
  }
  void forget() { run_.forget(); }

 private:
  void add(const MetricRow& row, const std::string& element) {
    const Peak value = run_.whole(row, element);
    if (!std::isfinite(value.value)) return;  // the metric does not apply
    Metric metric = metric_of(row, element, value);
    metric.phase = view_.phase_at(value.time);
    if (row.by_phase)
      for (const std::size_t p : view_.all_phases())
        if (const Peak here = run_.in(row, element, p); std::isfinite(here.value))
          metric.by_phase.push_back({view_.run().phases[p].name, in_unit(here.value, row.quantity)});
    metrics_.items.push_back(std::move(metric));
  }

  void add_phases(const MetricRow& row) {
    for (const std::size_t p : view_.all_phases()) {
      const std::string& phase = view_.run().phases[p].name;
      const Peak value = run_.in(row, phase, p);
      if (!std::isfinite(value.value)) continue;
      metrics_.items.push_back(metric_of(row, phase, value));
      metrics_.items.back().phase = phase;
    }
  }

  static Metric metric_of(const MetricRow& row, const std::string& element, const Peak& value) {
    Metric metric;
    metric.name = with_element(row.name, element);
    metric.unit = unit_of(row.quantity);
    metric.value = in_unit(value.value, row.quantity);
    metric.time = value.time;
    return metric;
  }

  const RunView& view_;
  MetricRun run_;
  Metrics& metrics_;
};

}  // namespace

std::string word_of(const MetricDefinition& definition) {
  switch (definition.element) {
    case MetricElement::phase:
      return "phase";
    case MetricElement::wire:
      return "wire";
    case MetricElement::hoist_wire:
      return "hoist wire";
    case MetricElement::wire_or_crane:
      return "wire or crane";
    case MetricElement::hoist_wire_or_crane:
      return "hoist wire or crane";
    case MetricElement::crane:
      return "crane";
    case MetricElement::crane_vessel:
      return "crane vessel";
    case MetricElement::winch:
      return "winch";
    case MetricElement::clearance:
      return "clearance";
    case MetricElement::entry:
      return definition.kind;
    case MetricElement::none:
      break;
  }
  return {};
}

const Metric* Metrics::find(const std::string& name) const {
  for (const Metric& m : items)
    if (m.name == name) return &m;
  return nullptr;
}

double Metrics::value(const std::string& name) const {
  const Metric* m = find(name);
  return m ? m->value : std::numeric_limits<double>::quiet_NaN();
}

const std::vector<std::vector<MetricRow>>& metric_families() {
  static const std::vector<std::vector<MetricRow>> families = [] {
    std::vector<std::vector<MetricRow>> all = {operation_metrics(), load_metrics()};
    for_each_element_kind([&](const auto& kind) { all.push_back(metric_rows(kind.tag())); });
    for (auto& family : {set_down_metrics(), vessel_metrics(), crane_curve_metrics(), clearance_metrics()}) all.push_back(family);
    return all;
  }();
  return families;
}

const MetricRow& metric_row(const std::string& name) {
  for (const auto& family : metric_families())
    for (const MetricRow& row : family)
      if (row.name == name) return row;
  throw std::logic_error("metric " + name + " is not in the catalogue");
}

const std::vector<MetricDefinition>& metric_catalogue() {
  static const std::vector<MetricDefinition> catalogue = [] {
    std::vector<MetricDefinition> all;
    for (const auto& family : metric_families())
      for (const MetricRow& row : family)
        all.push_back({row.name, row.quantity, unit_of(row.quantity), row.description, row.element, row.kind,
                       row.better_when_larger});
    return all;
  }();
  return catalogue;
}

const MetricDefinition* metric_definition(const std::string& name) {
  const MetricDefinition* pattern_match = nullptr;
  for (const MetricDefinition& d : metric_catalogue()) {
    const bool of_element = d.element != MetricElement::none;
    if (!of_element && d.name == name) return &d;
    const std::string stem = d.name.substr(0, d.name.find('%'));
    if (of_element && name.size() > stem.size() && name.starts_with(stem)) pattern_match = &d;
  }
  return pattern_match;
}

std::string element_of(const MetricDefinition& definition, const std::string& name) {
  return definition.element == MetricElement::none ? "" : name.substr(definition.name.find('%'));
}

std::vector<std::string> metric_names(const Specification& specification) {
  std::vector<std::string> names;
  for (const MetricDefinition& d : metric_catalogue()) {
    if (d.element == MetricElement::none)
      names.push_back(d.name);
    else
      for (const std::string& element : element_names(d.element, d.kind, specification))
        names.push_back(with_element(d.name, element));
  }
  return names;
}

bool better_when_larger(const std::string& name) {
  const MetricDefinition* d = metric_definition(name);
  return d && d->better_when_larger;
}

Shown show_metric(const std::string& name, double value) {
  const MetricDefinition* d = metric_definition(name);
  return shown(d ? d->quantity : Quantity::ratio, value);
}

bool metric_exists(const std::string& name, const Specification& specification) {
  const MetricDefinition* d = metric_definition(name);
  if (!d) return false;
  if (d->element == MetricElement::none) return true;
  const std::vector<std::string> names = element_names(d->element, d->kind, specification);
  return std::find(names.begin(), names.end(), element_of(*d, name)) != names.end();
}

Metrics compute_metrics(const Specification& specification, const Trajectory& trajectory) {
  Metrics metrics;
  metrics.status = trajectory.status;
  metrics.message = trajectory.message;
  if (trajectory.phases.empty()) return metrics;  // nothing ran
  const RunView view(specification, trajectory);
  if (const std::vector<Failure> failures = failures_of(view);
      metrics.status == RunStatus::completed && !failures.empty()) {
    metrics.status = RunStatus::failed;
    metrics.message = failure_text(failures);
    metrics.failed_at = failures.front().time;
  }
  view.forget();
  MetricTable table(view, metrics);
  // One family after the other, so that of a long run only the samples of one are in memory.
  for (const auto& family : metric_families()) {
    for (const MetricRow& row : family) table.add(row);
    table.forget();
  }
  return metrics;
}

std::optional<double> smooth_metric(const Specification& specification, const Trajectory& run, const std::string& name,
                                    const SmoothOptions& options) {
  const MetricDefinition* definition = metric_definition(name);
  if (run.phases.empty() || run.time.empty() || !definition) return std::nullopt;
  const MetricRow& row = metric_row(definition->name);
  if (!row.smooth) return std::nullopt;
  return row.smooth(RunView(specification, run), element_of(*definition, name), options);
}

}  // namespace stillhook
