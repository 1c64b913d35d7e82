// Tensions of the mooring lines.
#include "results/metrics/channel_set.h"
#include "results/metrics/metric_row.h"
#include "sim/lifting/mooring.h"

namespace stillhook {
namespace {

std::vector<std::string> mooring_names(const Specification& s) {
  std::vector<std::string> names;
  for (const MooringSpec& line : s.moorings) names.push_back(line.name);
  return names;
}

void all_moorings(ChannelSet& channels, const std::string&) {
  for (const std::string& line : mooring_names(channels.specification()))
    channels.add(line, {mooring_channels::tension});
}

}  // namespace

std::vector<MetricRow> mooring_metrics() {
  return {
      {.name = "mooring_tension_max",
       .quantity = Quantity::force,
       .description = "largest tension of any mooring line",
       .over = OverPhases::largest,
       .channels = all_moorings,
       .value =
           [](MetricRun& run, const std::string&, const Phases& phases) {
             return run.largest_of("mooring_tension_max.%", mooring_names(run.specification()), phases);
           }},
      {.name = "mooring_tension_max.%",
       .quantity = Quantity::force,
       .element = MetricElement::entry,
       .kind = "mooring",
       .description = "largest tension of a mooring line",
       .over = OverPhases::largest,
       .channels = all_moorings,
       .value = [](MetricRun& run, const std::string& line,
                   const Phases& phases) { return run.view().maximum(mooring_channels::tension.of(line), phases); }},
  };
}

}  // namespace stillhook
