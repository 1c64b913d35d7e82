// Speeds and pulls of the winches.
#include "results/metrics/channel_set.h"
#include "results/metrics/metric_row.h"
#include "sim/lifting/wire.h"

namespace stillhook {
namespace {

std::vector<std::string> winch_names(const Specification& s) {
  std::vector<std::string> names;
  for (const DriveSpec& drive : s.drives)
    if (drive.kind == DriveSpec::Kind::winch) names.push_back(drive.name);
  return names;
}

void tensions_on_winches(ChannelSet& channels, const std::string&) { channels.add_wires({wire_channels::tension}); }

Peak pull_on(MetricRun& run, const std::string& winch, const Phases& phases) {
  Peak pull;
  for (const WireSpec& wire : run.specification().wires) {
    if (wire.winch != winch) continue;
    const Peak tension = run.view().maximum(wire_channels::tension.of(wire), phases);
    pull.take_larger(tension.value, tension.time);
  }
  return pull;
}

Peak largest_use(MetricRun& run, const std::string&, const Phases& phases) {
  Peak use;
  for (const std::string& winch : winch_names(run.specification()))
    for (const WireSpec& wire : run.specification().wires) {
      if (wire.winch != winch || !(wire.tension_max > 0.0)) continue;
      const Peak tension = run.view().maximum(wire_channels::tension.of(wire), phases);
      use.take_larger(tension.value / wire.tension_max, tension.time);
    }
  return use;
}

}  // namespace

std::vector<MetricRow> winch_metrics() {
  return {
      {.name = "winch_speed_max.%",
       .quantity = Quantity::line_speed,
       .element = MetricElement::winch,
       .description = "largest speed of a winch",
       .over = OverPhases::largest,
       .channels = [](ChannelSet& channels, const std::string& winch) { channels.add(winch, {drive_channels::rate}); },
       .value =
           [](MetricRun& run, const std::string& winch, const Phases& phases) {
             return run.view().largest_magnitude(drive_channels::rate.of(winch), phases);
           }},
      {.name = "winch_pull_max.%",
       .quantity = Quantity::force,
       .element = MetricElement::winch,
       .description = "largest tension of the wires on a winch",
       .over = OverPhases::largest,
       .channels = tensions_on_winches,
       .value = pull_on},
      {.name = "winch_pull_max",
       .quantity = Quantity::force,
       .description = "largest tension of the wires on any winch",
       .over = OverPhases::largest,
       .channels = tensions_on_winches,
       .value =
           [](MetricRun& run, const std::string&, const Phases& phases) {
             return run.largest_of("winch_pull_max.%", winch_names(run.specification()), phases);
           }},
      {.name = "winch_utilisation_max",
       .description = "largest tension / winch limit of the wires that give one",
       .over = OverPhases::largest,
       .channels = tensions_on_winches,
       .value = largest_use},
  };
}

}  // namespace stillhook
