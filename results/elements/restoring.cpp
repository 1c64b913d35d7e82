// What is seen of springs and dampers to the world: an arrow of their force.
#include <cmath>

#include "results/channel_plot.h"
#include "results/metrics/metric_row.h"
#include "results/scene_builder.h"
#include "sim/lifting/restoring.h"

namespace stillhook {

std::vector<MetricRow> metric_rows(const RestoringSpec*) { return {}; }

void add_shapes(const RestoringSpec& r, SceneBuilder& scene) {
  using namespace restoring_channels;
  const std::array<std::string, 3> force = {force_x.of(r), force_y.of(r), force_z.of(r)};
  const double largest = std::hypot(scene.largest(force[0]), scene.largest(force[1]), scene.largest(force[2]));
  if (largest > 0.0) scene.scene().arrows.push_back({r.name, scene.body(r.body), r.point, force, largest});
}

std::vector<ChannelPlot> channel_plots(const RestoringSpec*) {
  using namespace restoring_channels;
  const std::string group = "Taglines and moorings";
  return {channel_plot(group, "Springs to the world: force along x", "force, kN", force_x, 1e-3),
          channel_plot(group, "Springs to the world: force along y", "force, kN", force_y, 1e-3),
          channel_plot(group, "Springs to the world: force along z", "force, kN", force_z, 1e-3)};
}

}  // namespace stillhook
