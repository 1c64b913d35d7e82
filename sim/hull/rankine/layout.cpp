#include "sim/hull/rankine/layout.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "sim/hull/rankine/mesh_symmetry.h"
#include "sim/specification.h"

namespace stillhook::rankine {
namespace {

SpecificationError fault(const PanelHull& hull, const std::string& sentence) {
  return SpecificationError("bodies." + hull.name, "hull", sentence);
}

bool is_box(const PanelHull& hull) { return hull.box_size.minCoeff() > 0.0; }

Placement placed(const PanelHull& hull) {
  Placement p;
  const MeshProperties size = properties_of(hull.mesh);
  if (hull.mesh.triangles.empty()) throw fault(hull, "has no panels");
  const Vector3 middle = 0.5 * (size.low + size.high);
  p.from_Bo = {middle.x(), middle.y(), hull.waterline};
  p.mesh = hull.mesh;
  for (Vector3& vertex : p.mesh.vertices) vertex.head<2>() -= middle.head<2>();
  p.length = size.high.x() - size.low.x();
  p.breadth = size.high.y() - size.low.y();
  p.draft = hull.waterline - size.low.z();
  if (p.draft <= 0.0) {
    std::ostringstream sentence;
    sentence << "has no draft: its lowest point is " << -p.draft << " m above the still water";
    throw fault(hull, sentence.str());
  }
  try {
    p.own = is_box(hull) ? Symmetry{true, true} : surface_symmetry(p.mesh, hull.waterline);
  } catch (const MeshError& error) {
    throw fault(hull, error.what());
  }
  return p;
}

/// Turned and moved to its place; with a common plane y = 0 and a hull that looks backwards, its other half.
HullPanels moved(HullPanels panels, const Placement& p, bool keep_y, int which) {
  const Matrix3 R = rotation_from({0.0, 0.0, p.reference.yaw});
  const Vector3 to(p.reference.x, p.reference.y, 0.0);
  const bool backwards = keep_y && std::cos(p.reference.yaw) < 0.0;
  for (FlatPanel& panel : panels.panels) {
    if (backwards) panel = mirrored(panel, 1);
    std::vector<Vector3> corners;
    for (int i = 0; i < panel.corners; ++i) corners.push_back(to + R * panel.v[i]);
    panel = flat_panel(corners);
  }
  panels.hull.assign(panels.panels.size(), which);
  return panels;
}

/// Least distance between the waterplanes of two hulls; for convex strips it is attained at a corner of one of them
/// unless they cross.
double gap_between(const std::vector<Strip>& a, const std::vector<Strip>& b) {
  double least = std::numeric_limits<double>::max();
  // Corners and middles of edges: crossing rectangles may have no corner inside one another.
  for (const auto& [from, to] : {std::pair{&a, &b}, std::pair{&b, &a}})
    for (const Strip& s : *from)
      for (int i = 0; i < 4; ++i) {
        const Eigen::Vector2d middle = 0.5 * (s[i] + s[(i + 1) % 4]);
        least = std::min({least, distance_to(*to, s[i]), distance_to(*to, middle)});
      }
  return least;
}

}  // namespace

Layout place(const std::vector<PanelHull>& hulls) {
  Layout layout;
  for (const PanelHull& hull : hulls) layout.hulls.push_back(placed(hull));
  const auto middle_in_world = [&](std::size_t k) -> Eigen::Vector2d {
    const Eigen::Rotation2Dd turn(hulls[k].yaw);
    return Eigen::Vector2d(hulls[k].x, hulls[k].y) + turn * Eigen::Vector2d(layout.hulls[k].from_Bo.head<2>());
  };
  const Eigen::Vector2d origin = middle_in_world(0);
  const Eigen::Rotation2Dd back(-hulls[0].yaw);
  for (std::size_t k = 0; k < hulls.size(); ++k) {
    Placement& p = layout.hulls[k];
    const Eigen::Vector2d P = back * (middle_in_world(k) - origin);
    const Eigen::Vector2d Bo = back * (Eigen::Vector2d(hulls[k].x, hulls[k].y) - origin);
    p.reference = {P.x(), P.y(), 0.0, hulls[k].yaw - hulls[0].yaw};
    p.Bo_x = Bo.x();
    p.Bo_y = Bo.y();
  }
  layout.symmetry = layout.hulls[0].own;
  if (hulls.size() == 1) return layout;
  layout.symmetry.x = false;
  for (const Placement& p : layout.hulls)
    layout.symmetry.y = layout.symmetry.y && p.own.y && std::abs(p.reference.y) < 1e-6 * p.length &&
                        std::abs(std::sin(p.reference.yaw)) < 1e-9;
  layout.gap = std::numeric_limits<double>::max();
  Layout alone = layout;
  alone.symmetry = {};
  const HullPanels all = panels_of(hulls, alone, std::numeric_limits<double>::max());
  std::vector<std::vector<Strip>> strips;
  for (std::size_t k = 0; k < hulls.size(); ++k) {
    strips.push_back(waterplane_strips(only(all, static_cast<int>(k))));
    for (std::size_t j = 0; j < k; ++j) {
      const double gap = gap_between(strips[j], strips[k]);
      if (gap <= 0.0) throw fault(hulls[k], "overlaps the hull of \"" + hulls[j].name + "\" in the water plane");
      layout.gap = std::min(layout.gap, gap);
    }
  }
  return layout;
}

void require_clearance(const std::vector<PanelHull>& hulls, const Layout& layout, double depth) {
  for (std::size_t k = 0; k < hulls.size(); ++k) {
    const double draft = layout.hulls[k].draft, least = (1.0 + kLeastClearance) * draft;
    if (depth >= least) continue;
    std::ostringstream sentence;
    sentence << "has a draft of " << draft << " m in water of sea.depth_m = " << depth << " m, "
             << (depth > draft ? std::to_string(std::lround(1000.0 * (depth - draft))) + " mm above the bed"
                               : std::string("and stands on the bed"))
             << ": panels need a tenth of the draft under the keel, a depth of " << least
             << " m; sea.deep_waves = true takes waves and hull as in deep water, which is no substitute where the gap "
                "decides the motions";
    throw fault(hulls[k], sentence.str());
  }
}

HullPanels panels_of(const std::vector<PanelHull>& hulls, const Layout& layout, double panel_length) {
  HullPanels all;
  all.symmetry = layout.symmetry;
  // A triangle is half of a square of the panel length, cut along its diagonal.
  const double longest_edge = std::min(std::numbers::sqrt2 * panel_length, std::numeric_limits<double>::max());
  for (std::size_t k = 0; k < hulls.size(); ++k) {
    const Placement& p = layout.hulls[k];
    try {
      HullPanels one = is_box(hulls[k])
                           ? unfolded(box_panels(p.length, p.breadth, p.draft, panel_length), layout.symmetry)
                           : mesh_panels(p.mesh, hulls[k].waterline, longest_edge, layout.symmetry);
      one = moved(std::move(one), p, layout.symmetry.y, static_cast<int>(k));
      all.panels.insert(all.panels.end(), one.panels.begin(), one.panels.end());
      all.hull.insert(all.hull.end(), one.hull.begin(), one.hull.end());
    } catch (const MeshError& error) {
      throw fault(hulls[k], error.what());
    }
  }
  return all;
}

void mark_gap(const Layout& layout, const HullPanels& panels, SurfacePanels& surface) {
  const int hulls = static_cast<int>(layout.hulls.size());
  if (hulls < 2) return;
  std::vector<std::vector<Strip>> strips;
  for (int k = 0; k < hulls; ++k) strips.push_back(waterplane_strips(only(panels, k)));
  surface.in_gap.assign(surface.size(), false);
  for (int j = 0; j < surface.size(); ++j) {
    // The two nearest hulls.
    std::vector<double> distances;
    for (const auto& hull : strips) distances.push_back(distance_to(hull, surface.point[j].head<2>()));
    std::sort(distances.begin(), distances.end());
    surface.in_gap[j] = distances[0] + distances[1] <= 1.5 * layout.gap;
  }
}

MatrixX to_middle(const Layout& layout) {
  const int n = static_cast<int>(layout.hulls.size());
  MatrixX T = MatrixX::Identity(6 * n, 6 * n);
  for (int k = 0; k < n; ++k) T.block<3, 3>(6 * k, 6 * k + 3) = -cross_matrix(layout.hulls[k].from_Bo);
  return T;
}

}  // namespace stillhook::rankine
