// The operation as it ran.
#include "results/metrics/channel_set.h"
#include "results/metrics/metric_row.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

Peak length_of_phases(MetricRun& run, const std::string&, const Phases& phases) {
  const RunView& view = run.view();
  if (run.all(phases)) return {view.end() - view.start(), kNaN};
  double sum = 0.0;
  for (const std::size_t p : phases) sum += view.run().phases[p].end - view.run().phases[p].start;
  return {sum, kNaN};
}

Peak timed_out(MetricRun& run, const std::string&, const Phases& phases) {
  int count = 0;
  for (const std::size_t p : phases) count += run.view().run().phases[p].event_timed_out ? 1 : 0;
  return {static_cast<double>(count), kNaN};
}

void no_channels(ChannelSet&, const std::string&) {}

}  // namespace

std::vector<MetricRow> operation_metrics() {
  return {
      {.name = "duration",
       .quantity = Quantity::time,
       .description = "length of the operation as it ran",
       .channels = no_channels,
       .value = length_of_phases,
       .smooth =
           [](const RunView& view, const std::string&, const SmoothOptions&) {
             return std::optional(view.run().phases.back().end - view.run().phases.front().start);
           }},
      {.name = "event_timeouts",
       .quantity = Quantity::count,
       .description = "phases whose awaited event never came",
       .channels = no_channels,
       .value = timed_out},
  };
}

}  // namespace stillhook
