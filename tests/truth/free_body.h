// A rigid body that nothing acts on, turning about its principal axes: Jacobi's elliptic functions (Landau & Lifshitz,
// Mechanics, par. 37), for energies on the side of the largest moment of inertia or of the smallest.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

namespace stillhook::truth {

/// sn, cn, dn of u for parameter m = k^2 in (0, 1), by descending Landen steps (Abramowitz & Stegun 16.4).
struct JacobiFunctions {
  double sn, cn, dn;
  JacobiFunctions(double u, double m) {
    double a[16], c[16], b = std::sqrt(1.0 - m);
    a[0] = 1.0;
    c[0] = std::sqrt(m);
    int n = 0;
    while (std::abs(c[n]) > 1e-16 && n < 15) {
      a[n + 1] = (a[n] + b) / 2.0;
      c[n + 1] = (a[n] - b) / 2.0;
      b = std::sqrt(a[n] * b);
      ++n;
    }
    double phi = std::ldexp(a[n] * u, n);
    for (; n > 0; --n) phi = (std::asin(c[n] * std::sin(phi) / a[n]) + phi) / 2.0;
    sn = std::sin(phi);
    cn = std::cos(phi);
    dn = std::sqrt(1.0 - m * sn * sn);
  }
};

/// Started with no spin about the middle axis: w = (w1, 0, w3), I1 < I2 < I3.
struct FreeBody {
  Eigen::Vector3d inertia;
  double w1, w3;

  /// Angular velocity (rad/s) in the body at time t.
  Eigen::Vector3d spin(double t) const {
    const double I1 = inertia[0], I2 = inertia[1], I3 = inertia[2];
    const double E2 = I1 * w1 * w1 + I3 * w3 * w3, L2 = I1 * I1 * w1 * w1 + I3 * I3 * w3 * w3;
    if (L2 <= E2 * I2) throw std::invalid_argument("the formula here is for L^2 > 2 E I2");
    // w1 = A cn, w2 = B sn, w3 = D dn; the signs follow from I2 w2' = (I3 - I1) w3 w1 at the start.
    const double B = std::sqrt((E2 * I3 - L2) / (I2 * (I3 - I2)));
    const double p = std::sqrt((I3 - I2) * (L2 - E2 * I1) / (I1 * I2 * I3));
    const double m = (I2 - I1) * (E2 * I3 - L2) / ((I3 - I2) * (L2 - E2 * I1));
    const JacobiFunctions j(p * t, m);
    return {w1 * j.cn, std::copysign(B, w1 * w3) * j.sn, w3 * j.dn};
  }
};

}  // namespace stillhook::truth
