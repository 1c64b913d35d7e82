// What is seen of contacts.
#include "results/channel_plot.h"
#include "results/metrics/metric_row.h"
#include "results/scene_builder.h"

namespace stillhook {

std::vector<MetricRow> metric_rows(const ContactSpec*) { return contact_metrics(); }

void add_shapes(const ContactSpec& c, SceneBuilder& scene) {
  scene.scene().surfaces.push_back(
      {c.name, c.role, scene.body(c.surface_body), c.surface_centre, c.surface_length, c.surface_breadth});
}

// Their plot marks where contacts begin: results/report_plots.cpp.
std::vector<ChannelPlot> channel_plots(const ContactSpec*) { return {}; }

}  // namespace stillhook
