// What is seen of mooring lines.
#include <cmath>

#include "results/channel_plot.h"
#include "results/metrics/metric_row.h"
#include "results/scene_builder.h"
#include "sim/lifting/catenary.h"
#include "sim/lifting/mooring.h"

namespace stillhook {
namespace {

SceneMooring scene_mooring(const MooringSpec& spec, const SceneBuilder& scene) {
  const double depth = scene.specification().sea.depth;
  SceneMooring m;
  m.name = spec.name;
  m.body = scene.body(spec.body);
  m.fairlead = spec.fairlead;
  m.tow = spec.tow;
  m.tow_direction = spec.tow_direction;
  const Vector3 fairlead = scene.start_pose(m.body) * spec.fairlead;
  const Vector3 outward(std::cos(spec.azimuth), std::sin(spec.azimuth), 0.0);
  m.anchor = spec.anchor.value_or(Vector3(fairlead + spec.anchor_distance * outward));
  if (spec.type != MooringSpec::Type::catenary) return m;
  // The drawing knows lines that come up from the bottom; what hangs free or is buoyant it draws straight.
  const bool from_the_bottom = spec.weight > 0.0 && !(spec.anchor && spec.anchor->z() > -depth + 0.05);
  if (from_the_bottom) m.weight = spec.weight;
  if (spec.anchor) return m;
  const CatenaryLine line{spec.length, spec.weight, spec.axial_stiffness, spec.seabed_friction, true};
  m.anchor = fairlead + catenary_distance(line, spec.pretension, fairlead.z() + depth) * outward;
  m.anchor.z() = -depth;
  return m;
}

}  // namespace

std::vector<MetricRow> metric_rows(const MooringSpec*) { return mooring_metrics(); }

void add_shapes(const MooringSpec& m, SceneBuilder& scene) {
  scene.scene().moorings.push_back(scene_mooring(m, scene));
}

std::vector<ChannelPlot> channel_plots(const MooringSpec*) {
  return {channel_plot("Taglines and moorings", "Mooring line tensions", "tension, t", mooring_channels::tension,
                       1.0 / kTonneForce)};
}

}  // namespace stillhook
