#include "sim/hull/immersion.h"

#include <algorithm>

namespace stillhook {

namespace {

// Integrals over the wet surface, each of f n_z dS. Horizontal coordinates are relative to a point amidst the hull.
struct WetIntegrals {
  double one = 0.0, z = 0.0, xz = 0.0, yz = 0.0, zz = 0.0;
  double x = 0.0, y = 0.0, xx = 0.0, yy = 0.0;

  // A triangle with z-component Sz of its area vector. The rule of the three edge middles is exact to second degree.
  void add(const Vector3& a, const Vector3& b, const Vector3& c, double Sz) {
    one += Sz;
    for (const Vector3& p : {Vector3(0.5 * (a + b)), Vector3(0.5 * (b + c)), Vector3(0.5 * (c + a))}) {
      const double w = Sz / 3.0;
      z += w * p.z();
      xz += w * p.x() * p.z();
      yz += w * p.y() * p.z();
      zz += w * p.z() * p.z();
      x += w * p.x();
      y += w * p.y();
      xx += w * p.x() * p.x();
      yy += w * p.y() * p.y();
    }
  }

  // The part of a triangle below z = 0, as a fan of at most two triangles.
  void add_wet_part(const std::array<Vector3, 3>& p) {
    std::array<Vector3, 4> wet;
    int n = 0;
    for (int i = 0; i < 3; ++i) {
      const Vector3 &from = p[i], &to = p[(i + 1) % 3];
      const bool from_wet = from.z() < 0.0, to_wet = to.z() < 0.0;
      if (from_wet) wet[n++] = from;
      if (from_wet != to_wet) {
        wet[n] = from + (to - from) * (from.z() / (from.z() - to.z()));
        wet[n++].z() = 0.0;
      }
    }
    for (int i = 2; i < n; ++i) {
      const Vector3 u = wet[i - 1] - wet[0], v = wet[i] - wet[0];
      add(wet[0], wet[i - 1], wet[i], 0.5 * (u.x() * v.y() - u.y() * v.x()));
    }
  }
};

}  // namespace

HydrostaticSummary immersion_of(const Mesh& mesh, const Pose& X_WB) {
  HydrostaticSummary out;
  out.centre_of_buoyancy = X_WB.p;
  out.centre_of_flotation = X_WB.p.head<2>();
  if (mesh.vertices.empty()) return out;

  // Work in the heading frame about the middle of the hull.
  const MeshProperties box = properties_of(mesh);
  const Matrix3 R_WH = heading_rotation(X_WB.R);
  Vector3 p_WH = X_WB * Vector3(0.5 * (box.low + box.high));
  p_WH.z() = 0.0;
  const Pose X_HB = Pose{R_WH, p_WH}.inverse() * X_WB;

  std::vector<Vector3> p(mesh.vertices.size());
  std::ranges::transform(mesh.vertices, p.begin(), [&](const Vector3& v) { return X_HB * v; });
  const auto [low, high] = std::ranges::minmax(p, {}, [](const Vector3& v) { return v.z(); });
  out.lowest = low.z();
  out.freeboard = high.z();
  WetIntegrals s;
  for (const auto& t : mesh.triangles) s.add_wet_part({p[t[0]], p[t[1]], p[t[2]]});
  if (!(s.z > 0.0)) return out;

  out.volume = s.z;
  out.centre_of_buoyancy = p_WH + R_WH * (Vector3(s.xz, s.yz, 0.5 * s.zz) / s.z);
  // Nothing but rounding is left of the waterplane of a hull that is wholly under water.
  if (out.freeboard <= 0.0) return out;
  out.waterplane_area = -s.one;
  const double x = -s.x / out.waterplane_area, y = -s.y / out.waterplane_area;
  out.centre_of_flotation = (p_WH + R_WH * Vector3(x, y, 0.0)).head<2>();
  out.transverse_inertia = -s.yy - out.waterplane_area * y * y;
  out.longitudinal_inertia = -s.xx - out.waterplane_area * x * x;
  return out;
}

double floating_height(const Mesh& mesh, double volume) {
  const MeshProperties size = properties_of(mesh);
  double low = size.low.z(), high = size.high.z();
  for (int k = 0; k < 60; ++k) {  // halvings: to rounding
    const double middle = 0.5 * (low + high);
    (immersion_of(mesh, {Matrix3::Identity(), {0.0, 0.0, -middle}}).volume < volume ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

MetacentricHeights metacentric_heights(const HydrostaticSummary& hull, double mass, const Vector3& p_WG,
                                       double density) {
  const double centre = density * hull.volume * hull.centre_of_buoyancy.z();
  return {(density * hull.transverse_inertia + centre) / mass - p_WG.z(),
          (density * hull.longitudinal_inertia + centre) / mass - p_WG.z()};
}

}  // namespace stillhook
