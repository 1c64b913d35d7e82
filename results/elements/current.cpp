// What is seen of the current on areas and hulls of bodies: its largest force, an arrow, plots.
#include "results/elements/flow.h"
#include "sim/environment/flow_area.h"
#include "sim/environment/flow_hull.h"

namespace stillhook {

std::vector<MetricRow> metric_rows(const CurrentAreaSpec*) {
  return {largest_flow_force<current_channels>("current_force_max.%", "area in the current",
                                               "largest horizontal force of the current on an area")};
}

std::vector<MetricRow> metric_rows(const CurrentHullSpec*) {
  return {largest_flow_force<current_hull_channels>("hull_current_force_max.%", "hull in the current",
                                                    "largest horizontal force of the current on a hull")};
}

void add_shapes(const CurrentAreaSpec& area, SceneBuilder& scene) {
  add_flow_arrow(
      area.name, area.body, area.centre,
      {current_channels::force_x.of(area), current_channels::force_y.of(area), current_channels::force_z.of(area)},
      scene);
}

void add_shapes(const CurrentHullSpec& hull, SceneBuilder& scene) {
  const std::string x = current_hull_channels::force_x.of(hull), y = current_hull_channels::force_y.of(hull);
  add_flow_arrow(hull.name, hull.body, hull.reference - Vector3(0.0, 0.0, 0.5 * hull.draft), {x, y, ""}, scene);
}

std::vector<ChannelPlot> channel_plots(const CurrentAreaSpec*) {
  return flow_plots<current_channels>("Force of the current along x", "Force of the current along y",
                                      "Current that areas meet");
}

std::vector<ChannelPlot> channel_plots(const CurrentHullSpec*) {
  return flow_plots<current_hull_channels>("Force of the current on hulls along x",
                                           "Force of the current on hulls along y", "Current that hulls meet");
}

}  // namespace stillhook
