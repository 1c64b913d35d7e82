#include "sim/hull/damping.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace stillhook {

Vector6 critical_damping(const Vector6& fraction, const Vector6& stiffness, const Vector6& inertia) {
  Vector6 b = Vector6::Zero();
  for (int i = 0; i < 6; ++i) {
    if (fraction(i) == 0.0) continue;
    if (!(stiffness(i) > 0.0) || !(inertia(i) > 0.0))
      throw std::invalid_argument("mode " + std::to_string(i + 1) +
                                  " has no restoring stiffness, so no critical damping");
    b(i) = fraction(i) * 2.0 * std::sqrt(stiffness(i) * inertia(i));
  }
  return b;
}

double natural_frequency(double stiffness, double inertia, const std::function<double(double)>& added_mass) {
  if (!(stiffness > 0.0)) throw std::invalid_argument("a mode without restoring stiffness has no natural frequency");
  // w^2 (m + A(w)) grows with w for every hull afloat, so bisection finds the one crossing; from far below any
  // vessel's period to far above.
  double low = 1e-3, high = 1e2;
  for (int n = 0; n < 60; ++n) {
    const double w = std::sqrt(low * high);
    (w * w * (inertia + added_mass(w)) < stiffness ? low : high) = w;
  }
  return std::sqrt(low * high);
}

}  // namespace stillhook
