// What is seen of wires.
#include "sim/lifting/wire.h"
#include "results/channel_plot.h"
#include "results/metrics/metric_row.h"
#include "results/scene_builder.h"

namespace stillhook {
namespace {

SceneLine::Kind line_kind(WireSpec::Role role) {
  switch (role) {
    case WireSpec::Role::hoist:
      return SceneLine::Kind::hoist;
    case WireSpec::Role::luffing:
      return SceneLine::Kind::luffing;
    case WireSpec::Role::stay:
      return SceneLine::Kind::stay;
    case WireSpec::Role::sling:
      return SceneLine::Kind::sling;
    case WireSpec::Role::other:
      break;
  }
  return SceneLine::Kind::other;
}

}  // namespace

std::vector<MetricRow> metric_rows(const WireSpec*) {
  std::vector<MetricRow> rows = sway_metrics();
  for (MetricRow& row : lead_metrics()) rows.push_back(std::move(row));
  for (MetricRow& row : wire_metrics()) rows.push_back(std::move(row));
  for (MetricRow& row : winch_metrics()) rows.push_back(std::move(row));
  for (MetricRow& row : lift_off_metrics()) rows.push_back(std::move(row));
  return rows;
}

void add_shapes(const WireSpec& w, SceneBuilder& scene) {
  const std::string tension = wire_channels::tension.of(w);
  scene.scene().lines.push_back({w.name, line_kind(w.role), scene.body(w.from), scene.body(w.to), w.point_from,
                                 w.point_to, scene.largest_static(tension), scene.phase_start(""), tension});
}

// Their plots follow the roles of the wires: results/report_plots.cpp.
std::vector<ChannelPlot> channel_plots(const WireSpec*) { return {}; }

}  // namespace stillhook
