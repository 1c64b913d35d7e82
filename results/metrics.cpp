#include "results/metrics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "results/clearance.h"
#include "results/failures.h"
#include "results/metric_list.h"
#include "sim/crane_parts.h"

namespace stillhook {
namespace {

std::vector<MetricDefinition> build_catalogue() {
  std::vector<MetricDefinition> c;
  const auto add = [&](const char* name, const char* unit, const char* description, const char* element = "") {
    c.push_back({name, unit, description, element});
  };
  add("duration", "s", "length of the operation as it ran");
  add("event_timeouts", "1", "phases whose awaited event never came");

  add("range_x.%", "m", "peak-to-peak position of the load fore and aft in a phase", "phase");
  add("range_y.%", "m", "peak-to-peak position of the load athwart in a phase", "phase");
  add("range_z.%", "m", "peak-to-peak height of the load in a phase", "phase");
  add("range_roll.%", "deg", "peak-to-peak roll of the load in a phase", "phase");
  add("range_pitch.%", "deg", "peak-to-peak pitch of the load in a phase", "phase");
  add("range_yaw.%", "deg", "peak-to-peak yaw of the load in a phase", "phase");
  add("mean_x.%", "m", "mean position x of the load in a phase", "phase");
  add("mean_y.%", "m", "mean position y of the load in a phase", "phase");
  add("mean_z.%", "m", "mean height of the load in a phase", "phase");

  add("sway_rms", "m", "rms horizontal swing of the load relative to the boom tips, over the hanging phases");
  add("sway_x_rms", "m", "the fore-and-aft part of sway_rms");
  add("sway_y_rms", "m", "the athwart part of sway_rms");
  add("sway_peak", "m", "largest horizontal swing of the load relative to the boom tips, over the hanging phases");
  add("sway_rms.%", "m", "rms swing in one hanging or set-down phase", "phase");
  add("sway_peak.%", "m", "largest swing in one hanging or set-down phase", "phase");
  const char *wire_or_crane = "hoist wire or crane", *crane = "crane", *vessel = "crane vessel";
  add("offlead_max", "deg", "largest angle of any hoist wire in its boom's plane while it carries the load");
  add("sidelead_max", "deg", "largest angle of any hoist wire out of its boom's plane while it carries the load");
  add("offlead_max.%", "deg", "largest angle of a hoist wire in its boom's plane while it carries the load",
      wire_or_crane);
  add("sidelead_max.%", "deg", "largest angle of a hoist wire out of its boom's plane while it carries the load",
      wire_or_crane);

  add("daf_total", "1", "largest total hook load / static load, lift-off and set-down included");
  add("daf_max", "1", "largest tension / static load of any hoist wire, lift-off and set-down included");
  add("daf_excess", "1", "daf_max - 1: what the dynamics add to the static load");
  add("daf.%", "1",
      "largest tension / static load of a wire, or of the hoist wires of a boom or of all booms of a vessel together; "
      "lift-off and set-down included",
      "wire or crane");
  add("slack_ratio_min", "1", "smallest tension / static load of any hoist wire while the load hangs free");
  add("slack_ratio_min.%", "1", "smallest tension / static load of a hoist wire while the load hangs free",
      "hoist wire");
  add("tension_max.%", "kN", "largest tension of a wire", "wire");
  add("hook_load_max", "kN", "largest total tension of the hoist wires");
  add("hook_load_max.%", "kN", "largest total tension of the hoist wires of a boom, or of all booms of a vessel",
      crane);
  add("wire_utilisation_max", "1", "largest tension / breaking load of the wires that give one");

  add("winch_speed_max.%", "m/s", "largest speed of a winch", "winch");
  add("winch_pull_max.%", "kN", "largest tension of the wires on a winch", "winch");
  add("winch_pull_max", "kN", "largest tension of the wires on any winch");
  add("winch_utilisation_max", "1", "largest tension / winch limit of the wires that give one");
  add("tagline_tension_max", "kN", "largest tension of any tagline");
  add("tagline_speed_max", "m/s", "largest line speed of any tagline");
  add("tagline_saturated", "1", "share of time at the tension or speed limit, mean of the active taglines");
  add("tagline_tension_max.%", "kN", "largest tension of a tagline", "tagline");
  add("tagline_speed_max.%", "m/s", "largest line speed of a tagline", "tagline");
  add("tagline_saturated.%", "1", "share of time a tagline spends at its tension or speed limit", "tagline");
  add("mooring_tension_max", "kN", "largest tension of any mooring line");
  add("mooring_tension_max.%", "kN", "largest tension of a mooring line", "mooring");

  add("lift_off_time", "s", "when the load first left its support");
  add("rehits", "1", "contacts with the support the load came from, after lift-off");
  add("rehit_speed_max", "m/s", "largest approach speed of a re-hit; 0 without one");
  add("rehit_impulse_max", "kN s", "largest impulse of a re-hit; 0 without one");
  add("contact_speed_max", "m/s", "largest approach speed of any contact that begins during the run; 0 without one");
  add("contact_impulse_max", "kN s",
      "largest impulse of a contact that begins after lift-off and ends again; 0 without one");
  add("contact_force_max", "kN", "largest normal force of any contact that begins during the run; 0 without one");
  add("lift_off_relative_speed", "m/s", "characteristic speed 2 sigma_v of the boom tips relative to the waiting load");
  add("lift_off_relative_speed_extreme", "m/s",
      "expected largest relative speed, sigma_v sqrt(2 ln N), in the transfer");
  add("cycles_to_clear", "1", "wave cycles the hoist needs to clear the relative motion, 2 r_a / (v_h T)");

  add("setdown_speed", "m/s", "approach speed of the first contact with the target");
  add("setdown_offset", "m", "horizontal distance of the load's reference point from the target at the end");
  add("setdown_movement_x", "m", "largest distance from the target in x while setting down");
  add("setdown_movement_y", "m", "largest distance from the target in y while setting down");
  add("setdown_movement_z", "m", "largest departure from the planned descent, until the first contact with the target");
  add("load_tilt_max", "deg", "largest tilt of the load from the vertical while setting down");
  add("load_yaw_max", "deg", "largest plan rotation of the load from its landed heading while setting down");

  add("heel_max", "deg", "largest heel of any crane vessel, waves included");
  add("trim_max", "deg", "largest trim of any crane vessel, waves included");
  add("heel_static_max", "deg", "largest heel of any crane vessel in calm water at the ends of the phases");
  add("trim_static_max", "deg", "largest trim of any crane vessel in calm water at the ends of the phases");
  add("heel_max.%", "deg", "largest heel of a crane vessel, waves included", vessel);
  add("trim_max.%", "deg", "largest trim of a crane vessel, waves included", vessel);
  add("heel_static_max.%", "deg", "largest heel of a crane vessel in calm water at the ends of the phases", vessel);
  add("trim_static_max.%", "deg", "largest trim of a crane vessel in calm water at the ends of the phases", vessel);
  add("clearance_min.%", "m", "smallest distance of a clearance pair; 0 when they touch", "clearance");
  return c;
}

std::vector<std::string> element_names(const std::string& kind, const Specification& s) {
  std::vector<std::string> names;
  const auto collect = [&](const auto& entries, auto wanted) {
    for (const auto& entry : entries)
      if (wanted(entry)) names.push_back(entry.name);
  };
  const auto any = [](const auto&) { return true; };
  if (kind == "phase") collect(s.operation.phases, any);
  if (kind == "wire" || kind == "wire or crane") collect(s.wires, any);
  const bool with_cranes = kind == "hoist wire or crane" || kind == "wire or crane";
  if (kind == "hoist wire" || kind == "hoist wire or crane")
    collect(s.wires, [](const WireSpec& w) { return w.role == WireSpec::Role::hoist; });
  if (kind == "crane vessel") names = crane_vessels(s);
  if (kind == "crane" || with_cranes)
    for (const std::string& crane : crane_bodies(s)) names.push_back(crane);
  if (kind == "winch") collect(s.drives, [](const DriveSpec& d) { return d.kind == DriveSpec::Kind::winch; });
  if (kind == "tagline") collect(s.taglines, any);
  if (kind == "mooring") collect(s.moorings, any);
  if (kind == "clearance") collect(s.clearances, any);
  return names;
}

std::string with_element(const std::string& pattern, const std::string& element) {
  const std::size_t place = pattern.find('%');
  return place == std::string::npos ? pattern : pattern.substr(0, place) + element;
}

double in_unit(double si, const std::string& unit) {
  if (unit == "deg") return si * 180.0 / std::numbers::pi;
  if (unit == "kN" || unit == "kN s") return si / 1000.0;
  return si;
}

}  // namespace

const Metric* Metrics::find(const std::string& name) const {
  for (const Metric& m : items)
    if (m.name == name) return &m;
  return nullptr;
}

double Metrics::value(const std::string& name) const {
  const Metric* m = find(name);
  return m ? m->value : std::numeric_limits<double>::quiet_NaN();
}

const std::vector<MetricDefinition>& metric_catalogue() {
  static const std::vector<MetricDefinition> catalogue = build_catalogue();
  return catalogue;
}

const MetricDefinition* metric_definition(const std::string& name) {
  const MetricDefinition* pattern_match = nullptr;
  for (const MetricDefinition& d : metric_catalogue()) {
    if (d.element.empty() ? d.name == name : false) return &d;
    const std::string stem = d.name.substr(0, d.name.find('%'));
    if (!d.element.empty() && name.size() > stem.size() && name.starts_with(stem)) pattern_match = &d;
  }
  return pattern_match;
}

std::vector<std::string> metric_names(const Specification& specification) {
  std::vector<std::string> names;
  for (const MetricDefinition& d : metric_catalogue()) {
    if (d.element.empty())
      names.push_back(d.name);
    else
      for (const std::string& element : element_names(d.element, specification))
        names.push_back(with_element(d.name, element));
  }
  return names;
}

bool better_when_larger(const std::string& name) {
  return name.starts_with("slack_ratio_min") || name.starts_with("clearance_min");
}

bool metric_exists(const std::string& name, const Specification& specification) {
  const MetricDefinition* d = metric_definition(name);
  if (!d) return false;
  if (d->element.empty()) return true;
  const std::string element = name.substr(d->name.find('%'));
  const std::vector<std::string> names = element_names(d->element, specification);
  return std::find(names.begin(), names.end(), element) != names.end();
}

void MetricList::add(const std::string& pattern, const std::string& element, double value, double time,
                     std::string phase) {
  const std::vector<MetricDefinition>& catalogue = metric_catalogue();
  const auto found =
      std::find_if(catalogue.begin(), catalogue.end(), [&](const MetricDefinition& d) { return d.name == pattern; });
  if (found == catalogue.end()) throw std::logic_error("metric " + pattern + " is not in the catalogue");
  if (!std::isfinite(value)) return;
  metrics_.items.push_back(
      {with_element(pattern, element), found->unit, in_unit(value, found->unit), time, std::move(phase), {}});
}

Metrics compute_metrics(const Specification& specification, const Trajectory& trajectory) {
  Metrics metrics;
  metrics.status = trajectory.status;
  metrics.message = trajectory.message;
  if (trajectory.phases.empty()) return metrics;  // nothing ran
  const RunView view(specification, trajectory);
  MetricList list(view, metrics);

  if (const std::vector<Failure> failures = failures_of(view);
      metrics.status == RunStatus::completed && !failures.empty()) {
    metrics.status = RunStatus::failed;
    metrics.message = failure_text(failures);
    metrics.failed_at = failures.front().time;
  }
  view.forget();
  list.add("duration", view.end() - view.start());
  list.add("event_timeouts",
           static_cast<double>(std::count_if(trajectory.phases.begin(), trajectory.phases.end(),
                                             [](const PhaseRecord& p) { return p.event_timed_out; })));
  // One after the other, so that of a long run only the samples of one are in memory.
  for (const auto add : {add_load_motion, add_sway, add_wires, add_winches, add_taglines, add_moorings, add_contacts,
                         add_lift_off, add_set_down_motion, add_crane_motion}) {
    add(view, list);
    view.forget();
  }
  for (const ClearanceSeries& clearance : compute_clearances(specification, trajectory))
    list.add("clearance_min.%", clearance.name, {clearance.minimum, clearance.minimum_time});
  return metrics;
}

}  // namespace stillhook
