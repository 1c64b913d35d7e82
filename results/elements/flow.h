// What areas and hulls in wind and current show alike.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "results/channel_plot.h"
#include "results/metrics/channel_set.h"
#include "results/metrics/metric_row.h"
#include "results/scene_builder.h"

namespace stillhook {

/// Largest horizontal force of an entry in a phase, by the samples. `Channels` has force_x and force_y.
template <class Channels>
MetricRow largest_flow_force(const std::string& name, const std::string& kind, const std::string& description) {
  return {.name = name,
          .quantity = Quantity::force,
          .element = MetricElement::entry,
          .kind = kind,
          .description = description,
          .over = OverPhases::largest,
          .channels =
              [](ChannelSet& channels, const std::string& entry) {
                channels.add(entry, {Channels::force_x, Channels::force_y});
              },
          .value =
              [](MetricRun& run, const std::string& entry, const Phases& phases) {
                const auto x = run.view().series(Channels::force_x.of(entry)),
                           y = run.view().series(Channels::force_y.of(entry));
                Peak largest;
                if (x.empty() || y.empty()) return largest;
                const RunView::Range range = run.view().samples(phases.front());
                for (std::size_t i = range.first; i < range.last; ++i)
                  largest.take_larger(std::hypot(x[i], y[i]), run.view().run().time[i]);
                return largest;
              }};
}

/// An arrow at a point of the body (m, in B) that is as long as the force of three channels; one without name is 0.
inline void add_flow_arrow(const std::string& name, const std::string& body, const Vector3& point,
                           const std::array<std::string, 3>& force, SceneBuilder& scene) {
  double square = 0.0;
  for (const std::string& channel : force)
    if (!channel.empty()) square += scene.largest(channel) * scene.largest(channel);
  if (square > 0.0) scene.scene().arrows.push_back({name, scene.body(body), point, force, std::sqrt(square)});
}

template <class Channels>
std::vector<ChannelPlot> flow_plots(const std::string& along_x, const std::string& along_y, const std::string& speed) {
  const std::string group = "Wind and water";
  return {channel_plot(group, along_x, "force, kN", Channels::force_x, 1e-3),
          channel_plot(group, along_y, "force, kN", Channels::force_y, 1e-3),
          channel_plot(group, speed, "speed, m/s", Channels::speed, 1.0)};
}

}  // namespace stillhook
