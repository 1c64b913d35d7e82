// The unilateral spring-damper, the law of wires and of contacts.
//
//   N = max(0, k d + c s(d / d0) ddot)   for d > 0,   N = 0 for d <= 0        s(x) = x (2 - x) for x < 1, 1 above
//
//   d  elongation or penetration, m     k  stiffness, N/m     c  damping, N s/m
//   d0 depth over which the damping grows to its full value, m
//
// A damper that acts in full from d = 0 on makes the force jump by c ddot at the touch, which no step size resolves.
// Here N is continuous at d = 0. s is concave, so that when the parts separate N falls through zero once and does not
// come back (a cubic smooth step would leave a bump of force just before the end). Above d0 the element is the linear
// spring-damper. N never pulls (or pushes, for a wire): where the damper would, it is released and the energy left in
// the spring is lost. The heat (N - k d) ddot is therefore never negative:
// c s ddot^2 where N > 0, -k d ddot with ddot < 0 where it is released.
#pragma once

#include "sim/multibody/branches.h"

namespace stillhook {

/// N for a scalar type T (double or a dual number); along `branches` it may be just below zero.
template <typename T>
T unilateral_force(const T& d, const T& d_rate, const T& k, const T& c, const T& d0, Branches* branches = nullptr) {
  if (!on_branch(branches, d > T(0.0))) return T(0.0);
  T force = k * d;
  if (on_branch(branches, d < d0)) {
    const T x = d / d0;
    force += c * x * (T(2.0) - x) * d_rate;
  } else {
    force += c * d_rate;
  }
  return on_branch(branches, force > T(0.0)) ? force : T(0.0);
}

/// Energy of the spring, J.
inline double unilateral_energy(double d, double k) { return d > 0.0 ? 0.5 * k * d * d : 0.0; }

/// Power turned into heat, W, never negative; `force` is what unilateral_force returns.
inline double unilateral_dissipation(double force, double d, double d_rate, double k) {
  return d > 0.0 ? (force - k * d) * d_rate : 0.0;
}

}  // namespace stillhook
