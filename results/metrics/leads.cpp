// Off-lead and side-lead of the hoist wires, in and out of the plane of the boom.
#include <algorithm>
#include <cmath>

#include "results/metrics/channel_set.h"
#include "results/metrics/metric_row.h"
#include "sim/crane_parts.h"
#include "sim/lifting/wire.h"

namespace stillhook {
namespace {

using Stage = PhaseSpec::Stage;

/// Largest angle of a hoist wire in a phase while it carries the load: every step of a hanging phase, and of load
/// transfer and set-down the samples with at least a tenth of the largest static tension, for a slack wire has no lead
/// to judge.
Peak largest_lead(const RunView& view, const std::string& wire, const ChannelKind<WireSpec>& lead, std::size_t phase) {
  const std::string tension_channel = wire_channels::tension.of(wire);
  const Stage stage = view.run().phases[phase].stage;
  if (stage == Stage::hanging) return view.largest_magnitude(lead.of(wire), {phase});
  Peak peak;
  if (stage != Stage::transfer && stage != Stage::set_down) return peak;
  const auto tension = view.series(tension_channel), angle = view.series(lead.of(wire));
  if (tension.empty() || angle.empty()) return peak;
  double carried = 0.0;
  for (std::size_t i = 0; i < view.run().static_poses.size(); ++i)
    carried = std::max(carried, view.static_value(i, tension_channel));
  const RunView::Range range = view.samples(phase);
  for (std::size_t i = range.first; i < range.last; ++i)
    if (tension[i] > 0.1 * carried) peak.take_larger(std::abs(angle[i]), view.run().time[i]);
  return peak;
}

MetricRow lead_row(const std::string& name, MetricElement element, const ChannelKind<WireSpec>& lead,
                   const char* description) {
  MetricRow row;
  row.name = name;
  row.quantity = Quantity::angle;
  row.element = element;
  row.description = description;
  row.over = OverPhases::largest;
  row.channels = [lead](ChannelSet& channels, const std::string&) {
    channels.add_hoist_wires({lead, wire_channels::tension});
  };
  return row;
}

MetricRow overall_row(const std::string& stem, const ChannelKind<WireSpec>& lead, const char* description) {
  MetricRow row = lead_row(stem, MetricElement::none, lead, description);
  row.value = [of_element = stem + ".%"](MetricRun& run, const std::string&, const Phases& phases) {
    return run.largest_of(of_element, hoist_wires(run.specification()), phases);
  };
  return row;
}

MetricRow element_row(const std::string& stem, const ChannelKind<WireSpec>& lead, const char* description) {
  MetricRow row = lead_row(stem + ".%", MetricElement::hoist_wire_or_crane, lead, description);
  row.value = [lead, name = row.name](MetricRun& run, const std::string& element, const Phases& phases) {
    const std::vector<std::string> wires = hoist_wires(run.specification());
    if (std::find(wires.begin(), wires.end(), element) != wires.end())
      return largest_lead(run.view(), element, lead, phases.front());
    return run.largest_of(name, hoist_wires_of(run.specification(), element), phases);
  };
  return row;
}

}  // namespace

std::vector<MetricRow> lead_metrics() {
  return {overall_row("offlead_max", wire_channels::off_lead,
                      "largest angle of any hoist wire in its boom's plane while it carries the load"),
          overall_row("sidelead_max", wire_channels::side_lead,
                      "largest angle of any hoist wire out of its boom's plane while it carries the load"),
          element_row("offlead_max", wire_channels::off_lead,
                      "largest angle of a hoist wire in its boom's plane while it carries the load"),
          element_row("sidelead_max", wire_channels::side_lead,
                      "largest angle of a hoist wire out of its boom's plane while it carries the load")};
}

}  // namespace stillhook
