// What is seen of the wind on bodies: its largest force, an arrow, plots.
#include <cmath>

#include "results/channel_plot.h"
#include "results/metrics/channel_set.h"
#include "results/metrics/metric_row.h"
#include "results/scene_builder.h"
#include "sim/environment/wind_area.h"

namespace stillhook {
namespace {

/// Largest horizontal wind force of an area in a phase, by the samples.
Peak largest_wind_force(MetricRun& run, const std::string& area, const Phases& phases) {
  const auto x = run.view().series(wind_channels::force_x.of(area)),
             y = run.view().series(wind_channels::force_y.of(area));
  Peak largest;
  if (x.empty() || y.empty()) return largest;
  const RunView::Range range = run.view().samples(phases.front());
  for (std::size_t i = range.first; i < range.last; ++i)
    largest.take_larger(std::hypot(x[i], y[i]), run.view().run().time[i]);
  return largest;
}

}  // namespace

std::vector<MetricRow> metric_rows(const WindAreaSpec*) {
  return {{.name = "wind_force_max.%",
           .quantity = Quantity::force,
           .element = MetricElement::entry,
           .kind = "wind area",
           .description = "largest horizontal wind force on an area",
           .over = OverPhases::largest,
           .channels =
               [](ChannelSet& channels, const std::string& area) {
                 channels.add(area, {wind_channels::force_x, wind_channels::force_y});
               },
           .value = largest_wind_force}};
}

void add_shapes(const WindAreaSpec& area, SceneBuilder& scene) {
  const std::array<std::string, 3> force = {wind_channels::force_x.of(area), wind_channels::force_y.of(area),
                                            wind_channels::force_z.of(area)};
  const double largest = std::hypot(scene.largest(force[0]), scene.largest(force[1]), scene.largest(force[2]));
  if (largest > 0.0) scene.scene().arrows.push_back({area.name, scene.body(area.body), area.centre, force, largest});
}

std::vector<ChannelPlot> channel_plots(const WindAreaSpec*) {
  const std::string group = "Wind and water";
  return {channel_plot(group, "Wind force along x", "force, kN", wind_channels::force_x, 1e-3),
          channel_plot(group, "Wind force along y", "force, kN", wind_channels::force_y, 1e-3)};
}

}  // namespace stillhook
