// A closed mesh of a sphere by circles of latitude, with vertices mirrored about all three planes and on the equator.
#pragma once

#include <cmath>
#include <numbers>

#include "sim/hull/mesh/mesh.h"

namespace stillhook::truth {

/// radius (m); n circles from pole to pole (even), 4 n / 2 meridians. Vertices lie on the sphere, so volume and area are
/// below the sphere's by about (pi / n)^2.
inline Mesh sphere_mesh(double radius, int n) {
  Mesh mesh;
  const int around = 2 * n;
  const auto exact = [](double v) { return std::abs(v) < 1e-12 ? 0.0 : v; };
  mesh.vertices.push_back(Vector3(0.0, 0.0, -radius));
  for (int i = 1; i < n; ++i)
    for (int j = 0; j < around; ++j) {
      const double theta = std::numbers::pi * i / n, phi = 2.0 * std::numbers::pi * j / around;
      mesh.vertices.push_back(radius * Vector3(exact(std::sin(theta) * std::cos(phi)),
                                               exact(std::sin(theta) * std::sin(phi)), exact(-std::cos(theta))));
    }
  mesh.vertices.push_back(Vector3(0.0, 0.0, radius));
  const int top = static_cast<int>(mesh.vertices.size()) - 1;
  const auto at = [&](int i, int j) { return 1 + (i - 1) * around + (j + around) % around; };
  for (int j = 0; j < around; ++j) {
    mesh.triangles.push_back({0, at(1, j + 1), at(1, j)});
    for (int i = 1; i + 1 < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
    mesh.triangles.push_back({top, at(n - 1, j), at(n - 1, j + 1)});
  }
  return mesh;
}

}  // namespace stillhook::truth
