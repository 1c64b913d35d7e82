// What is seen of taglines.
#include "sim/lifting/tagline.h"
#include "results/channel_plot.h"
#include "results/metrics/metric_row.h"
#include "results/scene_builder.h"

namespace stillhook {

std::vector<MetricRow> metric_rows(const TaglineSpec*) { return tagline_metrics(); }

void add_shapes(const TaglineSpec& t, SceneBuilder& scene) {
  if (!t.active) return;
  scene.scene().lines.push_back({t.name, SceneLine::Kind::tagline, scene.body(t.from), scene.body(t.to), t.point_from,
                                 t.point_to, t.tension_max, scene.phase_start(t.active_from),
                                 tagline_channels::tension.of(t)});
}

// Their plots show the winches' limits: results/report_plots.cpp.
std::vector<ChannelPlot> channel_plots(const TaglineSpec*) { return {}; }

}  // namespace stillhook
