// Viscous damping of a hull, mode by mode about its centre of gravity:
//
//   F_i = -b_i V_i - q_i |V_i| V_i
//
// V: the velocity of C along the axes of the hull's heading frame H (m/s) and the angular velocity in B (rad/s). The
// centre of gravity is where roll decay tests and critical fractions are commonly referred to. (Faltinsen 1990, ch. 7;
// Himeno 1981 for the split into a linear and a quadratic part.)
#pragma once

#include <functional>

#include "sim/spatial/pose.h"

namespace stillhook {

struct ViscousDamping {
  Vector6 linear = Vector6::Zero();     // b, N s/m and N m s, >= 0
  Vector6 quadratic = Vector6::Zero();  // q, N s2/m2 and N m s2, >= 0

  bool operator==(const ViscousDamping&) const = default;
  bool none() const { return linear.isZero(0.0) && quadratic.isZero(0.0); }
  Vector6 force(const Vector6& V) const {
    return -((linear.array() + quadratic.array() * V.array().abs()) * V.array()).matrix();
  }
  /// Diagonal of dF/dV.
  Vector6 derivative(const Vector6& V) const {
    return -(linear.array() + 2.0 * quadratic.array() * V.array().abs()).matrix();
  }
  /// W, never negative.
  double power(const Vector6& V) const { return -V.dot(force(V)); }
};

/// b_i = fraction_i * 2 sqrt(stiffness_i * inertia_i): the linear damping that is this share of critical for one mode
/// oscillating alone. stiffness: N/m and N m/rad; inertia: mass plus added mass, kg and kg m2. Modes with fraction 0
/// are not looked at; throws std::invalid_argument when another has no positive stiffness or inertia.
Vector6 critical_damping(const Vector6& fraction, const Vector6& stiffness, const Vector6& inertia);

/// Frequency w = sqrt(stiffness / (inertia + A(w))) of one mode alone with added mass that depends on frequency,
/// rad/s. Throws std::invalid_argument when stiffness is not positive.
double natural_frequency(double stiffness, double inertia, const std::function<double(double)>& added_mass);

}  // namespace stillhook
