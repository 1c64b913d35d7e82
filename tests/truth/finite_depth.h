// Hulls over a flat bed and the numbers of other codes for them (tests/validation/data says whose).
#pragma once

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/hull/mesh/hull_mesh.h"
#include "sim/hull/rankine/panel_method.h"
#include "tests/truth/upright_cylinder.h"

namespace stillhook::truth {

/// Rows of cells of a file of tests/validation/data with lines of comment and one of names.
inline std::vector<std::vector<std::string>> depth_rows(const std::string& name) {
  std::ifstream in(STILLHOOK_SOURCE_DIR "/tests/validation/data/" + name);
  if (!in) throw std::runtime_error(name + " is missing");
  std::vector<std::vector<std::string>> rows;
  bool names = true;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (!names) rows.push_back(cells);
    names = false;
  }
  return rows;
}

/// A value of the box hull 110 x 46 x 4 m: A, B of modes i and j, or X of mode i and heading j (deg).
struct DepthRow {
  std::string quantity;
  int i = 0;
  double frequency = 0.0, j = 0.0, value = 0.0, phase = 0.0, error = 0.0;  // rad/s, 1 or deg, SI, deg, %
};

/// Of one depth, as the file has it: "inf", "40", "20" or "10" m.
inline std::vector<DepthRow> box_over_bed(const std::string& depth) {
  std::vector<DepthRow> rows;
  for (const auto& cell : depth_rows("box_finite_depth.csv"))
    if (cell[0] == depth)
      rows.push_back({cell[2], std::stoi(cell[3]) - 1, std::stod(cell[1]), std::stod(cell[4]), std::stod(cell[5]),
                      cell[6].empty() ? 0.0 : std::stod(cell[6]), std::stod(cell[8])});
  return rows;
}

inline const std::vector<double>& box_frequencies() {  // rad/s
  static const std::vector<double> w = {0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0};
  return w;
}

inline PanelHull box_in_water() {
  PanelHull hull;
  hull.name = "box";
  hull.box_size = {110.0, 46.0, 7.5};
  hull.box_centre = {0.0, 0.0, -0.25};
  hull.mesh = box_mesh(hull.box_size, hull.box_centre, 4.0);
  return hull;
}

inline constexpr double kCylinderRadius = 10.0;  // m

/// A truncated cylinder at one Ka; lengths over its radius, A and B over rho V and rho V w (with the radius squared for
/// modes 5), X over rho g pi a^2.
struct CylinderRow {
  double draft = 0.0, depth = 0.0, Ka = 0.0, A11 = 0.0, B11 = 0.0, A33 = 0.0, B33 = 0.0, A55 = 0.0, X1 = 0.0, X3 = 0.0;
  double frequency() const { return std::sqrt(Ka * 9.80665 / kCylinderRadius); }  // rad/s
};

inline std::vector<CylinderRow> cylinder_over_bed(double draft, double depth) {
  std::vector<CylinderRow> rows;
  for (const auto& cells : depth_rows("cylinder_finite_depth.csv")) {
    const auto at = [&](int column) { return std::stod(cells[static_cast<std::size_t>(column)]); };
    if (at(0) == draft && at(1) == depth)
      rows.push_back({at(0), at(1), at(2), at(4), at(5), at(6), at(7), at(9), at(11), at(12)});
  }
  return rows;
}

inline PanelHull cylinder_in_water(double draft) {
  PanelHull hull;
  hull.name = "cylinder";
  hull.mesh = upright_cylinder(kCylinderRadius, draft * kCylinderRadius, 3.0, 64, 2.5);
  return hull;
}

/// What the six geometries have in common: a small hull in waves as short as a third of its length.
inline PanelMethodOptions cylinder_options(const std::vector<CylinderRow>& rows) {
  PanelMethodOptions options;
  options.headings = 16;
  options.depth = rows.front().depth * kCylinderRadius;
  options.refinement = 1.7;
  for (const CylinderRow& row : rows) options.chosen.push_back(row.frequency());
  return options;
}

}  // namespace stillhook::truth
