// Heel and trim of the crane vessels.
#include <algorithm>
#include <cmath>

#include "results/metrics/channel_set.h"
#include "results/metrics/metric_row.h"
#include "sim/crane_parts.h"

namespace stillhook {
namespace {

using AngleChannel = ChannelKind<BodySpec>;

MetricRow attitude_row(const std::string& name, const char* description) {
  MetricRow row;
  row.name = name;
  row.quantity = Quantity::angle;
  row.description = description;
  row.over = OverPhases::largest;
  row.channels = [](ChannelSet& channels, const std::string&) {
    for (const std::string& vessel : crane_vessels(channels.specification())) channels.add_pose(vessel);
  };
  return row;
}

/// Of any crane vessel, from the row of each.
MetricRow overall_row(const std::string& stem, const char* description) {
  MetricRow row = attitude_row(stem, description);
  row.value = [of_vessel = stem + ".%"](MetricRun& run, const std::string&, const Phases& phases) {
    return run.largest_of(of_vessel, crane_vessels(run.specification()), phases);
  };
  return row;
}

MetricRow in_waves_row(const std::string& stem, const AngleChannel& angle, const char* description) {
  MetricRow row = attitude_row(stem + ".%", description);
  row.element = MetricElement::crane_vessel;
  row.value = [angle](MetricRun& run, const std::string& vessel, const Phases& phases) {
    return run.view().largest_magnitude(angle.of(vessel), phases);
  };
  return row;
}

/// In the static poses at the two ends of a phase.
MetricRow at_rest_row(const std::string& stem, const AngleChannel& angle, const char* description) {
  MetricRow row = attitude_row(stem + ".%", description);
  row.element = MetricElement::crane_vessel;
  row.value = [angle](MetricRun& run, const std::string& vessel, const Phases& phases) {
    const std::size_t p = phases.front();
    const PhaseRecord& phase = run.view().run().phases[p];
    Peak peak;
    peak.take_larger(std::abs(run.view().static_value(p, angle.of(vessel))), phase.start);
    peak.take_larger(std::abs(run.view().static_value(p + 1, angle.of(vessel))), phase.end);
    return peak;
  };
  return row;
}

}  // namespace

std::vector<MetricRow> vessel_metrics() {
  const AngleChannel& heel = body_channels::roll;
  const AngleChannel& trim = body_channels::pitch;
  return {
      overall_row("heel_max", "largest heel of any crane vessel, waves included"),
      overall_row("trim_max", "largest trim of any crane vessel, waves included"),
      overall_row("heel_static_max", "largest heel of any crane vessel in calm water at the ends of the phases"),
      overall_row("trim_static_max", "largest trim of any crane vessel in calm water at the ends of the phases"),
      in_waves_row("heel_max", heel, "largest heel of a crane vessel, waves included"),
      in_waves_row("trim_max", trim, "largest trim of a crane vessel, waves included"),
      at_rest_row("heel_static_max", heel, "largest heel of a crane vessel in calm water at the ends of the phases"),
      at_rest_row("trim_static_max", trim, "largest trim of a crane vessel in calm water at the ends of the phases"),
  };
}

}  // namespace stillhook
