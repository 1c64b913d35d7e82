// A planar four-bar linkage that turns without stopping, from the geometry of its loop and the conservation of energy
// alone: th' = sqrt(2 (E - V(th)) / I(th)), th the angle of the crank.
#pragma once

#include <Eigen/Dense>
#include <cmath>

#include "tests/truth/runge_kutta.h"

namespace stillhook::truth {

/// Crank from A, coupler from B to D, rocker from the ground pivot G to D; uniform slender bars, all in one plane with
/// x level and y up. Angles of the bars from x.
struct FourBar {
  double crank, coupler, rocker, base;           // m; G lies at (base, 0) from A
  double crank_mass, coupler_mass, rocker_mass;  // kg
  double gravity;
  using Scalar = Eigen::Matrix<double, 1, 1>;

  struct Angles {
    double crank, coupler, rocker;
  };

  /// The open branch: D above the line from B to G.
  Angles angles(double th) const {
    const Eigen::Vector2d B = crank * Eigen::Vector2d(std::cos(th), std::sin(th)), G(base, 0.0), d = G - B;
    const double r = d.norm(), along = (r * r + coupler * coupler - rocker * rocker) / (2.0 * r);
    const double across = std::sqrt(coupler * coupler - along * along);
    const Eigen::Vector2d D = B + along * d / r + across * Eigen::Vector2d(-d.y(), d.x()) / r;
    return {th, std::atan2(D.y() - B.y(), D.x() - B.x()), std::atan2(D.y() - G.y(), D.x() - G.x())};
  }
  /// Angular velocities per unit of the crank's, from the velocity of D.
  Eigen::Vector2d ratios(const Angles& a) const {
    Eigen::Matrix2d A;
    A << -coupler * std::sin(a.coupler), rocker * std::sin(a.rocker), coupler * std::cos(a.coupler),
        -rocker * std::cos(a.rocker);
    return A.inverse() * Eigen::Vector2d(crank * std::sin(a.crank), -crank * std::cos(a.crank));
  }
  /// Kinetic energy is I th'^2 / 2.
  double inertia(double th) const {
    const Angles a = angles(th);
    const Eigen::Vector2d k = ratios(a);
    const double vx = -crank * std::sin(th) - 0.5 * coupler * k[0] * std::sin(a.coupler);
    const double vy = crank * std::cos(th) + 0.5 * coupler * k[0] * std::cos(a.coupler);
    return crank_mass * crank * crank / 3.0 + rocker_mass * rocker * rocker / 3.0 * k[1] * k[1] +
           coupler_mass * (vx * vx + vy * vy + coupler * coupler / 12.0 * k[0] * k[0]);
  }
  double height_energy(double th) const {
    const Angles a = angles(th);
    return gravity * (crank_mass * 0.5 * crank * std::sin(th) + rocker_mass * 0.5 * rocker * std::sin(a.rocker) +
                      coupler_mass * (crank * std::sin(th) + 0.5 * coupler * std::sin(a.coupler)));
  }
  double crank_angle(double t, double th, double rate) const {
    const double E = 0.5 * inertia(th) * rate * rate + height_energy(th);
    const auto f = [&](const Scalar& y) { return Scalar(std::sqrt(2.0 * (E - height_energy(y[0])) / inertia(y[0]))); };
    return runge_kutta<1>(f, Scalar(th), t)[0];
  }
};

}  // namespace stillhook::truth
