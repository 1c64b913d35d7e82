#include "sim/hull/coefficients/motion_scales.h"

#include <algorithm>

#include "sim/hull/silent_modes.h"

namespace stillhook {
namespace {

// Where no spring holds a hull - surge, sway, yaw - an error dB of the damping changes a motion by dB/(w m), m the
// inertia of the displaced water: a tenth of w m as scale lets it change by 0.1 x 8 % = 0.8 %. In heave the spring is
// known, C = rho g A_waterplane, and above resonance the motion changes by dB/|w (m + A) - C/w|, so that a tenth of this
// is the scale: the bottom of a deep hull hardly makes waves there, and what the pressure has of B is the error of the
// panels alone. Roll and pitch have springs that depend on the centre of gravity: there only noise is let pass.
constexpr double kDampingInertia = 0.1, kDampingNoise = 1e-5;
// There too an error dA counts beside m + A: the added mass of a shallow barge in sway is a tenth of m, that in heave as
// large as m. With half of m as scale both may change a motion by half of 6 %.
// In heave, below resonance, the spring governs and the motion changes by dA/|C/w^2 - (m + A)|: over a bed A_33 grows like
// -ln w, where a hull is the least concerned.
constexpr double kAddedInertia = 0.5;

}  // namespace

bool is_free(int mode) { return mode % 6 < 2 || mode % 6 == 5; }

double least_damping_scale(const HydrodynamicCoefficients& c, int mode, double w, double A) {
  const double m = displaced_inertia(c, mode);
  const std::size_t hull = static_cast<std::size_t>(mode / 6);
  if (is_free(mode)) return kDampingInertia * w * m;
  double scale = kDampingNoise * w * m;
  if (mode % 6 == 2 && hull < c.waterplane.size() && c.waterplane[hull] > 0.0)
    scale = std::max(scale, kDampingInertia * (w * (m + A) - c.density * c.gravity * c.waterplane[hull] / w));
  return scale;
}

double least_inertia_scale(const HydrodynamicCoefficients& c, int mode, double w, double A) {
  const double m = displaced_inertia(c, mode);
  if (is_free(mode)) return kAddedInertia * m;
  const std::size_t hull = static_cast<std::size_t>(mode / 6);
  if (mode % 6 != 2 || hull >= c.waterplane.size()) return 0.0;
  return kAddedInertia * (c.density * c.gravity * c.waterplane[hull] / (w * w) - m - A);
}

}  // namespace stillhook
