// Pendulums in minimal coordinates: nothing here knows of constraints, multipliers or HHT.
#pragma once

#include <cmath>

#include "tests/truth/runge_kutta.h"

namespace stillhook::truth {

/// A rigid body on a level axis: J th'' = -m g l sin th, with J about the axis.
struct PhysicalPendulum {
  double mass, arm, inertia_about_axis, gravity;

  double small_period() const { return 2.0 * M_PI * std::sqrt(inertia_about_axis / (mass * gravity * arm)); }

  /// Exact for swings between -amplitude and +amplitude (rad): T = T0 (2/pi) K(sin(amplitude/2)), the complete elliptic
  /// integral by the arithmetic-geometric mean (Abramowitz & Stegun 17.6).
  double period(double amplitude) const {
    double a = 1.0, b = std::cos(amplitude / 2.0);
    while (std::abs(a - b) > 1e-15) {
      const double mean = (a + b) / 2.0;
      b = std::sqrt(a * b);
      a = mean;
    }
    return small_period() / a;
  }
};

/// A point mass (or rod without spin about its own line) on a ball joint: n from the joint to the centre of gravity,
/// |n| = 1, J n'' = m g l (n n^T - 1) z - J |n'|^2 n.
struct SphericalPendulum {
  double mass, arm, inertia_about_joint, gravity;
  using Vec = Eigen::Matrix<double, 6, 1>;

  Vec rate(const Vec& y) const {
    const Eigen::Vector3d n = y.head<3>(), v = y.tail<3>(), z = Eigen::Vector3d::UnitZ();
    Vec d;
    d.head<3>() = v;
    d.tail<3>() = mass * gravity * arm / inertia_about_joint * (n * n.z() - z) - v.squaredNorm() * n;
    return d;
  }
  /// (n, n') at time t.
  Vec at(double t, const Vec& start) const {
    return runge_kutta<6>([this](const Vec& y) { return rate(y); }, start, t);
  }
  /// Force of the joint on the body: m (a - g).
  Eigen::Vector3d joint_force(const Vec& y) const {
    return mass * (arm * rate(y).tail<3>() + gravity * Eigen::Vector3d::UnitZ());
  }
};

/// Two bars in one plane, angles from the direction of gravity's share in the plane, both absolute. The first hangs on
/// a fixed axis at one end, the second on the first at `length`.
struct DoublePendulum {
  double mass1, arm1, inertia1, length, mass2, arm2, inertia2;  // inertias about the centres of gravity
  double gravity;                                               // its share in the plane
  using Vec = Eigen::Matrix<double, 4, 1>;                      // th1, th2, th1', th2'

  Vec rate(const Vec& y) const {
    const double s = std::sin(y[0] - y[1]), c = std::cos(y[0] - y[1]);
    const double k = mass2 * length * arm2;
    Eigen::Matrix2d M;
    M << inertia1 + mass1 * arm1 * arm1 + mass2 * length * length, k * c, k * c, inertia2 + mass2 * arm2 * arm2;
    const Eigen::Vector2d Q(-k * s * y[3] * y[3] - (mass1 * arm1 + mass2 * length) * gravity * std::sin(y[0]),
                            k * s * y[2] * y[2] - mass2 * arm2 * gravity * std::sin(y[1]));
    Vec d;
    d.head<2>() = y.tail<2>();
    d.tail<2>() = M.inverse() * Q;
    return d;
  }
  Vec at(double t, const Vec& start) const {
    return runge_kutta<4>([this](const Vec& y) { return rate(y); }, start, t);
  }
};

}  // namespace stillhook::truth
