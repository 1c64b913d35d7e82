// A closed mesh of an upright circular cylinder, graded to the edge of its bottom, mirrored about x = 0 and y = 0.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "sim/hull/rankine/hull_panels.h"

namespace stillhook::truth {

/// From z = -draft to `top` (m), with the area and volume of a circle of `radius` (m); `around` corners, a multiple of
/// four; panels at most `longest` (m).
inline Mesh upright_cylinder(double radius, double draft, double top, int around, double longest) {
  // The polygon has the area of the circle.
  const double corner = radius * std::sqrt(2.0 * std::numbers::pi / around / std::sin(2.0 * std::numbers::pi / around));
  const auto nodes = [&](double a, double b, bool at_a) {
    const rankine::BoxGrading grading;
    return rankine::graded_nodes(a, b, at_a ? grading.edge * longest : 0.0, grading.edge * longest, longest,
                                 grading.growth);
  };
  std::vector<std::pair<double, double>> profile;  // radius and height, from the bottom's middle outwards and up
  const std::vector<double> outwards = nodes(0.0, corner, false), upwards = nodes(-draft, 0.0, true);
  for (std::size_t i = 1; i < outwards.size(); ++i) profile.emplace_back(outwards[i], -draft);
  for (std::size_t i = 1; i < upwards.size(); ++i) profile.emplace_back(corner, upwards[i]);
  profile.emplace_back(corner, top);
  Mesh mesh;
  mesh.vertices.emplace_back(0.0, 0.0, -draft);
  const auto exact = [](double v) { return std::abs(v) < 1e-12 ? 0.0 : v; };
  for (const auto& [r, z] : profile)
    for (int j = 0; j < around; ++j) {
      const double phi = 2.0 * std::numbers::pi * j / around;
      mesh.vertices.emplace_back(r * exact(std::cos(phi)), r * exact(std::sin(phi)), z);
    }
  mesh.vertices.emplace_back(0.0, 0.0, top);
  const int last = static_cast<int>(mesh.vertices.size()) - 1, rings = static_cast<int>(profile.size());
  const auto at = [&](int i, int j) { return 1 + i * around + j % around; };
  for (int j = 0; j < around; ++j) {
    mesh.triangles.push_back({0, at(0, j + 1), at(0, j)});
    for (int i = 0; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
    mesh.triangles.push_back({last, at(rings - 1, j), at(rings - 1, j + 1)});
  }
  return mesh;
}

}  // namespace stillhook::truth
