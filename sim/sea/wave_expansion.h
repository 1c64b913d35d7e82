// Elevation and pressure of an irregular sea near given points, by a Taylor series of the second order.
//
//   zeta(x + dx, y + dy, t + dt)          and   h(x + dx, y + dy, z + dz, t + dt),
//   h = r(t) sum_j a_j exp(k_j (z - zeta)) cos th_j                            (the dynamic head of wave_field.h)
//
// One sum over the components gives the series' 25 terms at a point, for about twice the price of one value; the series
// then serves every instant and iterate near by. Between two instants t_a and t_b = t_a + H that have such series, the
// field is the quintic Hermite interpolant of value, rate and curvature in time, each continued in space:
//
//   f(x, t) = sum over both of  p0 (f + f_i dx_i + f_ij dx_i dx_j / 2) + p1 (f_t + f_it dx_i) + p2 f_tt
//
// It is twice continuously differentiable in time, and its gradients in space are exact derivatives of it. Errors
// relative to a component: (w H)^6 / 46080 in time, (k dx)^3 / 6 in space. The curvature is not continued in space,
// which costs (w H)^2 k d / 32 at most, where d is the part of the displacement that both ends share: how far a hull is
// from the straight line between the poses it was expected in. Above the surface h is continued analytically, not
// linearly.
#pragma once

#include <memory>

#include "sim/sea/wave_field.h"

namespace stillhook {

/// Terms of the series at one point: 10 of the elevation, 15 of the head.
inline constexpr int kExpansionTerms = 25;

/// Weights of value, rate (s) and curvature (s2) of one end of an interval.
struct HermiteWeights {
  double value, rate, curvature;
};

/// The ends' weights at the share 0 <= s <= 1 of an interval of length H (s).
std::pair<HermiteWeights, HermiteWeights> quintic_hermite(double s, double H);

class WaveExpansion {
 public:
  explicit WaveExpansion(std::shared_ptr<const WaveField> waves);

  /// Longest interval (s) whose interpolation is wrong by 1e-5 of the sea's rms elevation; at most 1 s.
  double interval() const { return interval_; }
  /// Displacement (m) shared by both ends at which the field is wrong by 1e-3 of the rms elevation.
  double reach() const { return reach_; }

  /// The series at n points at time t (s): term i of point p goes to terms[i * stride + p]. x, y, z in W, m.
  void expand(double t, std::span<const double> x, std::span<const double> y, std::span<const double> z,
              std::size_t stride, double* terms) const;

  /// Adds one end's share to `out` at points displaced by (dx, dy, dz) (m) from those of the series. The head is the
  /// dynamic one. An empty out.head means that only the elevation is wanted.
  static void add(const double* terms, std::size_t stride, const HermiteWeights& weights, std::span<const double> dx,
                  std::span<const double> dy, std::span<const double> dz, bool gradients, const WaveSamples& out);

 private:
  std::shared_ptr<const WaveField> waves_;
  std::vector<double> factor_;  // of each component in each sum of the kernel, a sum after the other
  double interval_ = 0.0, reach_ = 0.0;
};

}  // namespace stillhook
