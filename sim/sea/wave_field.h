// Linear deep-water waves as a sum of components, with Wheeler-stretched dynamic pressure.
//
//   zeta(x, y, t) = r(t) sum_j a_j cos(th_j),  th_j = k_j (x cos b_j + y sin b_j) - w_j t + e_j,  k_j = w_j^2 / g
//   p_dyn/(rho g)  = r(t) sum_j a_j exp(k_j (z - zeta)) cos(th_j)     so the total pressure is zero on z = zeta
//
// r(t) is a smooth ramp (C2) from 0 to 1. Heading b is the direction the wave travels towards. (Faltinsen 1990,
// ch. 2; Wheeler 1970 for the stretching.)
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/sea/sea_spec.h"

namespace stillhook {

struct WaveComponent {
  double amplitude;     // m
  double frequency;     // rad/s
  double wavenumber;    // 1/m
  double cos_heading, sin_heading;
  double phase;         // rad, added to theta
  bool operator==(const WaveComponent&) const = default;
};

/// Elevation and pressure head at points, and their spatial gradients. Arrays of equal length, structure of arrays.
struct WaveSamples {
  std::span<double> elevation;                  // m, zeta at (x, y)
  std::span<double> elevation_x, elevation_y;   // 1, d zeta/dx, d zeta/dy
  std::span<double> head;                       // m, (p - p_atm)/(rho g) = zeta-stretched dynamic head - z; 0 at z = zeta
  std::span<double> head_x, head_y, head_z;     // 1, total gradient of head
};

class WaveField {
 public:
  WaveField() = default;  // calm
  WaveField(std::vector<WaveComponent> components, double ramp);

  bool operator==(const WaveField&) const = default;
  bool calm() const { return components_.empty(); }
  const std::vector<WaveComponent>& components() const { return components_; }

  /// r(t).
  double ramp(double t) const;
  /// r(t), r'(t) (1/s) and r''(t) (1/s2).
  std::array<double, 3> ramp_derivatives(double t) const;

  /// Elevation (m) at (x, y) (m) and time t (s).
  double elevation(double x, double y, double t) const;

  /// Fills elevation, head and, when `gradients`, the gradients. Above the surface the head is continued linearly:
  /// head = zeta - z. Points: x, y, z in W, m. An empty out.head means that only the elevation is wanted.
  void sample(double t, std::span<const double> x, std::span<const double> y, std::span<const double> z,
              bool gradients, const WaveSamples& out) const;

  /// Velocity of the undisturbed water at p_W (no stretching: z is cut off at 0), m/s.
  Vector3 velocity(const Vector3& p_W, double t) const;

 private:
  std::vector<WaveComponent> components_;
  double ramp_ = 0.0;
};

/// The wave field of one sea state; irregular seas draw phases (and amplitudes are deterministic) from state.seed.
WaveField build_wave_field(const SeaStateSpec& state, double gravity, double ramp);

}  // namespace stillhook
