// An elastic line on a seabed, integrated element by element along its unstretched length from the upper end down: the
// equilibrium of each element, no catenary formula. Independent truth for sim/lifting/catenary.
#pragma once

#include <algorithm>
#include <cmath>

namespace stillhook::truth {

struct IntegratedLine {
  double x = 0.0, z = 0.0;  // m, of the upper end from the anchor
  double energy = 0.0;      // J, elastic plus weight above the anchor
};

/// Midpoint rule on n elements on either side of the touchdown; error of order (length/n)^2.
inline IntegratedLine integrate_line(double H, double V, double length, double weight, double axial_stiffness,
                                     double friction, bool on_seabed, int n) {
  const double lifted = on_seabed ? std::min(length, V / weight) : length;
  IntegratedLine line;
  double hanging_energy = 0.0, fall = 0.0;  // of the weight, measured from the upper end
  const double ds = lifted / n;
  for (int i = 0; i < n; ++i) {
    const double vertical = V - weight * (i + 0.5) * ds, tension = std::hypot(H, vertical);
    const double stretched = ds * (1.0 + tension / axial_stiffness);
    const double drop = stretched * vertical / tension;
    line.x += stretched * H / tension;
    line.energy += 0.5 * tension * tension / axial_stiffness * ds;
    hanging_energy -= weight * ds * (fall + 0.5 * drop);
    fall += drop;
  }
  line.z = fall;
  line.energy += hanging_energy + weight * lifted * line.z;
  const double grounded = length - lifted, dg = grounded / n;
  for (int i = 0; i < n; ++i) {
    const double tension = std::max(0.0, H - friction * weight * (i + 0.5) * dg);
    line.x += dg * (1.0 + tension / axial_stiffness);
    line.energy += 0.5 * tension * tension / axial_stiffness * dg;
  }
  return line;
}

}  // namespace stillhook::truth
