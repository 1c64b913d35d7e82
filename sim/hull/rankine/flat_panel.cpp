#include "sim/hull/rankine/flat_panel.h"

#include <cmath>
#include <stdexcept>

namespace stillhook::rankine {
namespace {

/// Area, centroid and second moments by fan triangles from the first corner.
void integrate(FlatPanel& panel) {
  const Vector3& a = panel.v[0];
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();
  for (int i = 1; i + 1 < panel.corners; ++i) {
    const Vector3 b = panel.v[i] - a, c = panel.v[i + 1] - a;
    const double area = 0.5 * panel.normal.dot(b.cross(c));
    panel.area += area;
    first += area / 3.0 * (b + c);
    second += area / 12.0 * (b * b.transpose() + c * c.transpose() + (b + c) * (b + c).transpose());
  }
  if (panel.area <= 0.0) {
    panel.area = 0.0;
    panel.centroid = a;
    return;
  }
  const Vector3 centre = first / panel.area;
  panel.centroid = a + centre;
  panel.moment = second - panel.area * centre * centre.transpose();
  for (int i = 0; i < panel.corners; ++i) panel.reach = std::max(panel.reach, (panel.v[i] - panel.centroid).norm());
}

}  // namespace

FlatPanel flat_panel(std::span<const Vector3> corners) {
  if (corners.size() < 3 || corners.size() > kMaxCorners) throw std::invalid_argument("flat_panel: 3 to 8 corners");
  FlatPanel panel;
  panel.corners = static_cast<int>(corners.size());
  std::copy(corners.begin(), corners.end(), panel.v.begin());
  Vector3 vector_area = Vector3::Zero();
  for (int i = 1; i + 1 < panel.corners; ++i)
    vector_area += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
  if (vector_area.norm() == 0.0) return panel;
  panel.normal = vector_area.normalized();
  Vector3 middle = Vector3::Zero();
  for (const Vector3& corner : corners) middle += corner / panel.corners;
  for (int i = 0; i < panel.corners; ++i) panel.v[i] -= panel.normal.dot(panel.v[i] - middle) * panel.normal;
  integrate(panel);
  return panel;
}

FlatPanel mirrored(const FlatPanel& panel, int axis) {
  FlatPanel m = panel;
  for (int i = 0; i < panel.corners; ++i) {
    m.v[i] = panel.v[panel.corners - 1 - i];
    m.v[i](axis) *= -1.0;
  }
  m.centroid(axis) *= -1.0;
  m.normal(axis) *= -1.0;
  m.moment.row(axis) *= -1.0;
  m.moment.col(axis) *= -1.0;
  return m;
}

Influence exact_influence(const FlatPanel& panel, const Vector3& x) {
  const double h = panel.normal.dot(x - panel.v[0]), H = std::abs(h);
  double sum = 0.0, angle = 0.0;
  for (int i = 0; i < panel.corners; ++i) {
    const Vector3 &a = panel.v[i], &b = panel.v[i + 1 == panel.corners ? 0 : i + 1];
    const double length = (b - a).norm();
    if (length <= 1e-12 * panel.reach) continue;
    const Vector3 t = (b - a) / length, to_a = a - x;
    const double p = to_a.dot(t.cross(panel.normal));
    // On the line of an edge both terms are zero in the limit.
    if (std::abs(p) <= 1e-12 * panel.reach) continue;
    const double l1 = to_a.dot(t), l2 = l1 + length;
    const double r1 = to_a.norm(), r2 = (b - x).norm();
    // r + l loses its digits when x lies far before the edge; this form of the logarithm does not.
    sum += p * std::log((r1 + r2 + length) / (r1 + r2 - length));
    const double R2 = p * p + h * h;
    angle += std::atan(p * l2 / (R2 + H * r2)) - std::atan(p * l1 / (R2 + H * r1));
  }
  Influence result;
  result.S = sum - H * angle;
  if (H > 1e-12 * panel.reach) result.D = h > 0.0 ? angle : -angle;
  return result;
}

}  // namespace stillhook::rankine
