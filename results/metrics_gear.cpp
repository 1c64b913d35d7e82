// Tensions, winches, taglines and moorings.
#include <algorithm>
#include <cmath>

#include "results/load_path.h"
#include "results/metric_list.h"
#include "sim/crane_parts.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

using Stage = PhaseSpec::Stage;

/// The tension channels of some wires that the run has.
std::vector<std::string> tensions_of(const RunView& view, const std::vector<std::string>& wires) {
  std::vector<std::string> names;
  for (const std::string& wire : wires)
    if (view.channel(wire + ".tension") >= 0) names.push_back(wire + ".tension");
  return names;
}

std::vector<std::string> hoist_wire_names(const Specification& s) {
  std::vector<std::string> names;
  for (const WireSpec& wire : s.wires)
    if (wire.role == WireSpec::Role::hoist) names.push_back(wire.name);
  return names;
}

Peak largest_sum(const RunView& view, const std::vector<std::string>& channels) {
  if (channels.size() == 1) return view.maximum(channels[0], view.all_phases());
  Peak peak;
  std::vector<std::span<const double>> series;
  for (const std::string& name : channels) series.push_back(view.series(name));
  if (series.empty() || std::any_of(series.begin(), series.end(), [](const auto& s) { return s.empty(); })) return peak;
  for (std::size_t i = 0; i < view.run().time.size(); ++i) {
    double sum = 0.0;
    for (const auto& values : series) sum += values[i];
    peak.take_larger(sum, view.run().time[i]);
  }
  return peak;
}

/// Largest angle of a hoist wire while it carries the load: every step of the hanging phases, and of load transfer and
/// set-down the samples with at least a tenth of the largest static tension, for a slack wire has no lead to judge.
Peak largest_lead(const RunView& view, const WireSpec& wire, const std::string& quantity) {
  Peak peak = view.largest_magnitude(wire.name + quantity, view.phases_of({Stage::hanging}));
  const auto tension = view.series(wire.name + ".tension"), angle = view.series(wire.name + quantity);
  double carried = 0.0;
  for (std::size_t i = 0; i < view.run().static_poses.size(); ++i)
    carried = std::max(carried, view.static_value(i, wire.name + ".tension"));
  if (tension.empty() || angle.empty()) return peak;
  for (std::size_t p : view.phases_of({Stage::transfer, Stage::set_down})) {
    const RunView::Range range = view.samples(p);
    for (std::size_t i = range.first; i < range.last; ++i)
      if (tension[i] > 0.1 * carried) peak.take_larger(std::abs(angle[i]), view.run().time[i]);
  }
  return peak;
}

void add_lead_angles(const RunView& view, MetricList& list) {
  for (const auto& [metric, quantity] :
       {std::pair{"offlead_max", ".off_lead"}, std::pair{"sidelead_max", ".side_lead"}}) {
    Peak overall;
    const std::vector<std::string> cranes = crane_bodies(view.specification());
    std::vector<Peak> of_crane(cranes.size());
    for (const WireSpec& wire : view.specification().wires) {
      if (wire.role != WireSpec::Role::hoist) continue;
      const Peak peak = largest_lead(view, wire, quantity);
      list.add(std::string(metric) + ".%", wire.name, peak);
      overall.take_larger(peak.value, peak.time);
      for (std::size_t i = 0; i < cranes.size(); ++i)
        if (wire.from == cranes[i] || vessel_under(view.specification(), wire.from) == cranes[i])
          of_crane[i].take_larger(peak.value, peak.time);
    }
    for (std::size_t i = 0; i < cranes.size(); ++i) list.add(std::string(metric) + ".%", cranes[i], of_crane[i]);
    list.add(metric, overall);
  }
}

}  // namespace

void add_wires(const RunView& view, MetricList& list) {
  Peak daf, slack, wire_use;
  for (const WireSpec& wire : view.specification().wires) {
    const std::string channel = wire.name + ".tension";
    if (view.channel(channel) < 0) continue;
    const Peak tension = view.maximum(channel, view.all_phases());
    list.add("tension_max.%", wire.name, tension);
    if (wire.breaking_load > 0.0) wire_use.take_larger(tension.value / wire.breaking_load, tension.time);
    const Peak amplification = largest_amplification(view, {channel}, view.all_phases());
    list.add("daf.%", wire.name, amplification);
    if (wire.role != WireSpec::Role::hoist) continue;
    const Peak share = smallest_share(view, channel);
    list.add("slack_ratio_min.%", wire.name, share);
    daf.take_larger(amplification.value, amplification.time);
    slack.take_smaller(share.value, share.time);
  }
  list.add("daf_max", daf);
  if (daf.valid()) daf.value -= 1.0;
  list.add("daf_excess", daf);
  list.add("slack_ratio_min", slack);
  list.add("wire_utilisation_max", wire_use);
  const Specification& s = view.specification();
  if (const std::vector<std::string> hoist = tensions_of(view, hoist_wire_names(s)); !hoist.empty()) {
    list.add("daf_total", largest_amplification(view, hoist, view.all_phases()));
    list.add("hook_load_max", largest_sum(view, hoist));
  }
  for (const std::string& crane : crane_bodies(s))
    if (const auto hoist = tensions_of(view, hoist_wires_of(s, crane)); !hoist.empty()) {
      list.add("hook_load_max.%", crane, largest_sum(view, hoist));
      list.add("daf.%", crane, largest_amplification(view, hoist, view.all_phases()));
    }
  add_lead_angles(view, list);
}

void add_winches(const RunView& view, MetricList& list) {
  const Specification& s = view.specification();
  Peak pull_overall, use;
  for (const DriveSpec& drive : s.drives) {
    if (drive.kind != DriveSpec::Kind::winch) continue;
    list.add("winch_speed_max.%", drive.name, view.largest_magnitude(drive.name + ".rate", view.all_phases()));
    Peak pull;
    for (const WireSpec& wire : s.wires) {
      if (wire.winch != drive.name) continue;
      const Peak tension = view.maximum(wire.name + ".tension", view.all_phases());
      pull.take_larger(tension.value, tension.time);
      if (wire.tension_max > 0.0) use.take_larger(tension.value / wire.tension_max, tension.time);
    }
    list.add("winch_pull_max.%", drive.name, pull);
    pull_overall.take_larger(pull.value, pull.time);
  }
  list.add("winch_pull_max", pull_overall);
  list.add("winch_utilisation_max", use);
}

void add_taglines(const RunView& view, MetricList& list) {
  Peak tension_overall, speed_overall;
  double saturated_sum = 0.0;
  int active = 0;
  for (const TaglineSpec& line : view.specification().taglines) {
    const Peak tension = view.maximum(line.name + ".tension", view.all_phases());
    const Peak speed = view.largest_magnitude(line.name + ".line_speed", view.all_phases());
    list.add("tagline_tension_max.%", line.name, tension);
    list.add("tagline_speed_max.%", line.name, speed);
    tension_overall.take_larger(tension.value, tension.time);
    speed_overall.take_larger(speed.value, speed.time);
    const auto saturated = view.series(line.name + ".saturated");
    if (saturated.empty() || !line.active) continue;
    const double share = view.mean({0, saturated.size()}, [&](std::size_t i) { return saturated[i]; });
    list.add("tagline_saturated.%", line.name, share, kNaN, "");
    saturated_sum += share;
    ++active;
  }
  list.add("tagline_tension_max", tension_overall);
  list.add("tagline_speed_max", speed_overall);
  if (active > 0) list.add("tagline_saturated", saturated_sum / active);
}

void add_moorings(const RunView& view, MetricList& list) {
  Peak overall;
  for (const MooringSpec& line : view.specification().moorings) {
    const Peak tension = view.maximum(line.name + ".tension", view.all_phases());
    list.add("mooring_tension_max.%", line.name, tension);
    overall.take_larger(tension.value, tension.time);
  }
  list.add("mooring_tension_max", overall);
}

}  // namespace stillhook
