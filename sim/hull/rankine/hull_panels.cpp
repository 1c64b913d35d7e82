#include "sim/hull/rankine/hull_panels.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace stillhook::rankine {
namespace {

/// A flat patch spanned by nodes along two axes at origin, normal u x v.
void append_patch(const Vector3& origin, const Vector3& u, const Vector3& v, const std::vector<double>& along_u,
                  const std::vector<double>& along_v, std::vector<FlatPanel>& panels) {
  for (std::size_t j = 0; j + 1 < along_v.size(); ++j)
    for (std::size_t i = 0; i + 1 < along_u.size(); ++i) {
      const auto at = [&](double a, double b) -> Vector3 { return origin + a * u + b * v; };
      const std::array<Vector3, 4> corners{at(along_u[i], along_v[j]), at(along_u[i + 1], along_v[j]),
                                           at(along_u[i + 1], along_v[j + 1]), at(along_u[i], along_v[j + 1])};
      panels.push_back(flat_panel(corners));
    }
}

bool vertices_symmetric(const Mesh& mesh, int axis, double tolerance) {
  // Vertices sorted by one coordinate that mirroring keeps; a partner is looked for among those within tolerance.
  const int key = axis == 0 ? 1 : 0;
  std::vector<Vector3> sorted = mesh.vertices;
  std::sort(sorted.begin(), sorted.end(), [&](const Vector3& a, const Vector3& b) { return a(key) < b(key); });
  for (Vector3 wanted : mesh.vertices) {
    wanted(axis) *= -1.0;
    auto it = std::lower_bound(sorted.begin(), sorted.end(), wanted(key) - tolerance,
                               [&](const Vector3& a, double value) { return a(key) < value; });
    bool found = false;
    for (; it != sorted.end() && (*it)(key) <= wanted(key) + tolerance && !found; ++it)
      found = (*it - wanted).squaredNorm() <= tolerance * tolerance;
    if (!found) return false;
  }
  return true;
}

/// Panels of the mesh's part below z = 0 on the kept side of the symmetry planes.
HullPanels wetted(const Mesh& mesh, const Symmetry& symmetry) {
  HullPanels out;
  out.symmetry = symmetry;
  const MeshProperties size = properties_of(mesh);
  if (size.low.z() >= 0.0) throw MeshError("the hull does not reach into the water: no panel is below the waterline");
  if (size.high.z() <= 0.0) throw MeshError("the hull is wholly below the water: it does not float");
  const double scale = (size.high - size.low).norm();
  const double least = 1e-10 * scale * scale;
  for (const auto& triangle : mesh.triangles) {
    std::vector<Vector3> polygon{mesh.vertices[triangle[0]], mesh.vertices[triangle[1]], mesh.vertices[triangle[2]]};
    const double top = std::max({polygon[0].z(), polygon[1].z(), polygon[2].z()});
    const double bottom = std::min({polygon[0].z(), polygon[1].z(), polygon[2].z()});
    if (bottom >= -1e-9 * scale && top <= 1e-9 * scale)
      throw MeshError("panels lie in the still water plane (a lid): the hull must be closed above the water instead");
    polygon = clipped_polygon(polygon, -Vector3::UnitZ(), 0.0);
    if (symmetry.x) polygon = clipped_polygon(polygon, Vector3::UnitX(), 0.0);
    if (symmetry.y) polygon = clipped_polygon(polygon, Vector3::UnitY(), 0.0);
    append_polygon(polygon, least, out.panels);
  }
  out.hull.resize(out.panels.size(), 0);
  return out;
}

}  // namespace

std::vector<double> graded_nodes(double a, double b, double at_a, double at_b, double most, double growth) {
  const double length = b - a;
  // Spacings from both ends until they meet; then all are scaled to fill the length.
  std::vector<double> from_a, from_b;
  double left = length, next_a = at_a > 0.0 ? at_a : most, next_b = at_b > 0.0 ? at_b : most;
  while (left > 0.0) {
    const bool take_a = next_a <= next_b;
    double& next = take_a ? next_a : next_b;
    const double step = std::min(next, most);
    (take_a ? from_a : from_b).push_back(step);
    left -= step;
    next = std::min(next * growth, most);
  }
  std::vector<double> steps(from_a);
  steps.insert(steps.end(), from_b.rbegin(), from_b.rend());
  double sum = 0.0;
  for (const double step : steps) sum += step;
  std::vector<double> nodes{a};
  for (const double step : steps) nodes.push_back(nodes.back() + step * length / sum);
  nodes.back() = b;
  return nodes;
}

std::vector<Vector3> clipped_polygon(const std::vector<Vector3>& polygon, const Vector3& normal, double offset) {
  std::vector<Vector3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = normal.dot(a) - offset, db = normal.dot(b) - offset;
    if (da >= 0.0) kept.push_back(a);
    if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) {
      Vector3 cut = a + da / (da - db) * (b - a);
      // Exactly on the plane, whatever rounding says: neighbours are matched by it.
      for (int axis = 0; axis < 3; ++axis)
        if (std::abs(normal(axis)) == 1.0) cut(axis) = normal(axis) * offset;
      kept.push_back(cut);
    }
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

void append_polygon(const std::vector<Vector3>& polygon, double least_area, std::vector<FlatPanel>& panels) {
  for (std::size_t first = 1; first + 1 < polygon.size(); first += kMaxCorners - 2) {
    std::vector<Vector3> part{polygon[0]};
    for (std::size_t i = first; i < polygon.size() && part.size() < kMaxCorners; ++i) part.push_back(polygon[i]);
    if (part.size() < 3) break;
    FlatPanel panel = flat_panel(part);
    if (panel.area > least_area) panels.push_back(panel);
  }
}

double HullPanels::volume(int which) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < panels.size(); ++i)
    if (hull[i] == which) sum += panels[i].area * panels[i].normal.z() * panels[i].centroid.z();
  return sum * symmetry.images();
}

HullPanels box_panels(double length, double breadth, double draft, double panel_length, const BoxGrading& grading) {
  for (const double value : {length, breadth, draft, panel_length})
    if (!(value > 0.0) || !std::isfinite(value)) throw MeshError("a box needs positive dimensions and panel lengths");
  const double edge = grading.edge * panel_length;
  const auto nodes = [&](double a, double b, bool at_a) {
    return graded_nodes(a, b, at_a ? edge : 0.0, edge, panel_length, grading.growth);
  };
  const std::vector<double> x = nodes(0.0, 0.5 * length, false), y = nodes(0.0, 0.5 * breadth, false),
                            z = nodes(-draft, 0.0, true);
  HullPanels result;
  result.symmetry = {true, true};
  append_patch({0.0, 0.0, -draft}, Vector3::UnitY(), Vector3::UnitX(), y, x, result.panels);
  append_patch({0.5 * length, 0.0, 0.0}, Vector3::UnitY(), Vector3::UnitZ(), y, z, result.panels);
  append_patch({0.0, 0.5 * breadth, 0.0}, Vector3::UnitZ(), Vector3::UnitX(), z, x, result.panels);
  result.hull.resize(result.panels.size(), 0);
  return result;
}

HullPanels mesh_panels(const Mesh& hull, double waterline, double panel_length, const Symmetry& symmetry) {
  if (!(panel_length > 0.0)) throw MeshError("the panel length must be positive");
  Mesh afloat = hull;
  for (Vector3& vertex : afloat.vertices) vertex.z() -= waterline;
  return wetted(refined_mesh(afloat, panel_length), symmetry);
}

Symmetry symmetry_of(const Mesh& hull, double tolerance) {
  return {vertices_symmetric(hull, 0, tolerance), vertices_symmetric(hull, 1, tolerance)};
}

HullPanels only(const HullPanels& panels, int hull) {
  HullPanels one;
  one.symmetry = panels.symmetry;
  for (std::size_t i = 0; i < panels.panels.size(); ++i)
    if (panels.hull[i] == hull) one.panels.push_back(panels.panels[i]);
  one.hull.assign(one.panels.size(), 0);
  return one;
}

HullPanels unfolded(const HullPanels& panels, const Symmetry& keep) {
  HullPanels result = panels;
  for (const int axis : {0, 1}) {
    bool& has = axis == 0 ? result.symmetry.x : result.symmetry.y;
    if (!has || (axis == 0 ? keep.x : keep.y)) continue;
    has = false;
    const std::size_t half = result.panels.size();
    for (std::size_t i = 0; i < half; ++i) {
      result.panels.push_back(mirrored(result.panels[i], axis));
      result.hull.push_back(result.hull[i]);
    }
  }
  return result;
}

}  // namespace stillhook::rankine
