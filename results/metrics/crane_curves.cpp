// How far the cranes are used against their capacity curves.
#include <algorithm>

#include "results/crane_use.h"
#include "results/metrics/channel_set.h"
#include "results/metrics/metric_row.h"
#include "sim/crane_parts.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

Peak largest_use(MetricRun& run, const std::string& crane, const Phases& phases) {
  Peak largest;
  const CraneUse& use = run.once("use of " + crane, [&] { return crane_use(run.view(), crane); });
  const RunView::Range range = run.view().samples(phases.front());
  for (std::size_t i = range.first; i < std::min(range.last, use.use.size()); ++i)
    largest.take_larger(use.use[i], run.view().run().time[i]);
  return largest;
}

}  // namespace

std::vector<MetricRow> crane_curve_metrics() {
  return {{.name = "crane_utilisation_max",
           .description = "largest hook load / capacity at its radius, of any crane with a curve",
           .over = OverPhases::largest,
           .channels =
               [](ChannelSet& channels, const std::string&) {
                 for (const std::string& crane : cranes_with_curves(channels.specification()))
                   add_crane_channels(channels, crane);
               },
           .value =
               [](MetricRun& run, const std::string&, const Phases& phases) {
                 return run.largest_of("crane_utilisation_max.%", cranes_with_curves(run.specification()), phases);
               }},
          {.name = "crane_utilisation_max.%",
           .element = MetricElement::crane,
           .description = "largest hook load of a crane / its capacity at the radius, by its curve",
           .over = OverPhases::largest,
           .channels =
               [](ChannelSet& channels, const std::string& crane) {
                 const std::vector<std::string> cranes = cranes_with_curves(channels.specification());
                 if (std::find(cranes.begin(), cranes.end(), crane) != cranes.end()) add_crane_channels(channels, crane);
               },
           .value = largest_use}};
}

}  // namespace stillhook
