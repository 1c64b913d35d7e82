// What is seen of the wind on areas and hulls of bodies: its largest force, an arrow, plots.
#include "results/elements/flow.h"
#include "sim/environment/flow_area.h"
#include "sim/environment/flow_hull.h"

namespace stillhook {

std::vector<MetricRow> metric_rows(const WindAreaSpec*) {
  return {
      largest_flow_force<wind_channels>("wind_force_max.%", "wind area", "largest horizontal wind force on an area")};
}

std::vector<MetricRow> metric_rows(const WindHullSpec*) {
  return {largest_flow_force<wind_hull_channels>("hull_wind_force_max.%", "hull in the wind",
                                                 "largest horizontal wind force on a hull")};
}

void add_shapes(const WindAreaSpec& area, SceneBuilder& scene) {
  add_flow_arrow(area.name, area.body, area.centre,
                 {wind_channels::force_x.of(area), wind_channels::force_y.of(area), wind_channels::force_z.of(area)},
                 scene);
}

void add_shapes(const WindHullSpec& hull, SceneBuilder& scene) {
  const std::string x = wind_hull_channels::force_x.of(hull), y = wind_hull_channels::force_y.of(hull);
  add_flow_arrow(hull.name, hull.body, hull.reference + Vector3(0.0, 0.0, hull.centroid_height), {x, y, ""}, scene);
}

std::vector<ChannelPlot> channel_plots(const WindAreaSpec*) {
  return flow_plots<wind_channels>("Wind force along x", "Wind force along y", "Wind that areas meet");
}

std::vector<ChannelPlot> channel_plots(const WindHullSpec*) {
  return flow_plots<wind_hull_channels>("Wind force on hulls along x", "Wind force on hulls along y",
                                        "Wind that hulls meet");
}

}  // namespace stillhook
