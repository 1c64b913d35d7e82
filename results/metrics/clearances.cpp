// Smallest distances of the clearance pairs.
#include "results/clearance.h"
#include "results/metrics/channel_set.h"
#include "results/metrics/metric_row.h"

namespace stillhook {
namespace {

Peak smallest_distance(MetricRun& run, const std::string& pair, const Phases& phases) {
  const auto& all = run.once("clearances", [&] { return compute_clearances(run.specification(), run.view().run()); });
  Peak smallest;
  for (const ClearanceSeries& series : all) {
    if (series.name != pair || phases.front() >= series.by_phase.size()) continue;
    const Peak& in_phase = series.by_phase[phases.front()];
    smallest.take_smaller(in_phase.value, in_phase.time);
  }
  return smallest;
}

void poses_of_pair(ChannelSet& channels, const std::string& pair) {
  for (const ClearanceSpec& c : channels.specification().clearances)
    if (c.name == pair)
      for (const std::string& body : {c.a.body, c.b.body}) channels.add_pose(body);
}

}  // namespace

std::vector<MetricRow> clearance_metrics() {
  return {{.name = "clearance_min.%",
           .quantity = Quantity::length,
           .element = MetricElement::clearance,
           .description = "smallest distance of a clearance pair; 0 when they touch",
           .over = OverPhases::smallest,
           .better_when_larger = true,
           .channels = poses_of_pair,
           .value = smallest_distance}};
}

}  // namespace stillhook
