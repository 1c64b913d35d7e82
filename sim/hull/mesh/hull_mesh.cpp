#include "sim/hull/mesh/hull_mesh.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "sim/hull/hydrostatics.h"
#include "sim/hull/mesh/mesh_file.h"
#include "sim/number_text.h"

namespace stillhook {
namespace {

constexpr double kPanelsPerWave = 5.0;

/// m, of the mean wave number of the energy; infinite without waves.
double length_of_energy(const WaveField& waves) {
  double energy = 0.0, moment = 0.0;
  for (const WaveComponent& c : waves.components()) {
    energy += c.amplitude * c.amplitude;
    moment += c.amplitude * c.amplitude * c.wavenumber;
  }
  return energy > 0.0 ? 2.0 * std::numbers::pi * energy / moment : std::numeric_limits<double>::infinity();
}

}  // namespace

Mesh build_hull_mesh(const HullSpec& hull, std::string* mended) {
  if (hull.shape == HullSpec::Shape::none) return {};
  if (hull.panel_length < 0.0 || !std::isfinite(hull.panel_length)) throw MeshError("the panel length must be > 0 m");
  if (hull.shape == HullSpec::Shape::box) {
    const Vector3& s = hull.size;
    const double area = 2.0 * (s.x() * s.y() + s.y() * s.z() + s.z() * s.x());
    return box_mesh(s, hull.centre, hull.panel_length > 0.0 ? hull.panel_length : automatic_panel_length(area));
  }
  const MeshFileOptions options{hull.mesh_scale, hull.mesh_origin,      hull.mesh_attitude,
                                hull.mesh_mend,  hull.mesh_deck_height, hull.mesh_mirror};
  const Mesh mesh = read_mesh(hull.mesh_file, options, mended);
  const double panel = hull.panel_length > 0.0 ? hull.panel_length : automatic_panel_length(properties_of(mesh).area);
  return refined_mesh(mesh, panel * std::numbers::sqrt2);
}

Mesh hull_mesh_in(const BodySpec& body, const WaveField& waves) {
  const std::string entry = "bodies." + body.name;
  try {
    Mesh mesh = build_hull_mesh(body.hull);
    const MeshProperties size = properties_of(mesh);
    const double panel = size.longest_edge / std::numbers::sqrt2, length = length_of_energy(waves);
    const double needed = length / kPanelsPerWave;
    if (panel <= needed) return mesh;
    if (body.hull.panel_length > 0.0 || size.area > kMostHullPanels * needed * needed)
      throw SpecificationError(entry, "hull.panel_length",
                               "panels of " + number_text(panel) + " m do not resolve waves of " + number_text(length) +
                                   " m; at most " + number_text(needed) + " m is needed");
    HullSpec finer = body.hull;
    // A little less, so that rounding does not leave an edge longer than what was asked for.
    finer.panel_length = 0.999 * needed;
    return build_hull_mesh(finer);
  } catch (const MeshError& error) {
    throw SpecificationError(entry, "hull", error.what());
  }
}

}  // namespace stillhook
