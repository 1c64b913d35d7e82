// Elevation and pressure of an irregular sea near given points, by a Taylor series of the second order.
//
//   zeta(x + dx, y + dy, t + dt)          and   h(x + dx, y + dy, z + dz, t + dt),
//   h = r(t) sum_j a_j C_j(z') cos th_j                                         (the dynamic head of wave_field.h)
//
// One sum over the components gives the series' 30 terms at a point; the series then serves every instant and iterate
// near by. Between two instants t and t + H that have such series, with a third at t - H, the field is the Hermite
// interpolant of degree eight of value, rate and curvature in time, each continued in space:
//
//   f(x, t) = sum over the three of  p0 (f + f_i dx_i + f_ij dx_i dx_j / 2) + p1 (f_t + f_it dx_i) + p2 (f_tt + f_itt
//   dx_i)
//
// It is twice continuously differentiable in time, and its gradients in space are exact derivatives of it. Errors
// relative to a component: (w H)^9 / 6.36e6 in time, (k dx)^3 / 6 in space. Of h the curvature's slope f_itt is that of
// the pressure at a fixed depth under the surface; what is left out is its product with the slopes and rates of the
// elevation, 0.06 (w H)^2 k d times 2 k zeta, where d is the part of the displacement that all three share: how far a
// hull is from the straight line through the poses it was expected in. Above the surface h is continued analytically,
// not linearly. Over a bed z' depends on z and zeta by a quotient, whose derivatives are exact to the second order in
// the waves.
#pragma once

#include <array>
#include <memory>

#include "sim/sea/wave_field.h"

namespace stillhook {

/// Terms of the series at one point: 12 of the elevation, 18 of the head.
inline constexpr int kExpansionTerms = 30;

/// Weights of value, rate (s) and curvature (s2) of one instant.
struct HermiteWeights {
  double value, rate, curvature;
};

/// The weights of the instants t - H, t and t + H at t + s H, 0 <= s <= 1; H in s.
std::array<HermiteWeights, 3> hermite_weights(double s, double H);

class WaveExpansion {
 public:
  explicit WaveExpansion(std::shared_ptr<const WaveField> waves);

  /// Longest interval (s) whose interpolation is wrong by 1e-5 of the sea's rms elevation; at most 1 s.
  double interval() const { return interval_; }
  /// Displacement (m) shared by all instants at which the field is wrong by 1e-3 of the rms elevation.
  double reach() const { return reach_; }

  /// The series at n points at time t (s): term i of point p goes to terms[i * stride + p]. x, y, z in W, m.
  void expand(double t, std::span<const double> x, std::span<const double> y, std::span<const double> z,
              std::size_t stride, double* terms) const;

  /// Adds one instant's share to `out` at points displaced by (dx, dy, dz) (m) from those of the series. The head is
  /// the dynamic one; out is filled with gradients.
  static void add(const double* terms, std::size_t stride, const HermiteWeights& weights, std::span<const double> dx,
                  std::span<const double> dy, std::span<const double> dz, const WaveSamples& out);

 private:
  std::shared_ptr<const WaveField> waves_;
  std::vector<double> factor_;  // of each component in each sum of wave_sums.h, a component after the other
  double interval_ = 0.0, reach_ = 0.0;
};

}  // namespace stillhook
