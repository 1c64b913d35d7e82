// What is seen of ballast transfers.
#include "sim/lifting/ballast.h"
#include "results/channel_plot.h"
#include "results/metrics/metric_row.h"
#include "results/scene_builder.h"

namespace stillhook {

std::vector<MetricRow> metric_rows(const BallastSpec*) { return {}; }

void add_shapes(const BallastSpec&, SceneBuilder&) {}  // water in tanks is not drawn

std::vector<ChannelPlot> channel_plots(const BallastSpec*) {
  return {channel_plot("Geometry, vessel and contact", "Ballast moved", "weight, t", ballast_channels::moved,
                       1.0 / kTonneForce)};
}

}  // namespace stillhook
