// The angle of a hanging line from the vertical, seen in a vertical plane that turns with a body's heading.
//
//   theta = atan2(n . d, -d_z)     d  lower end from upper end, m      n  horizontal unit vector of the plane
//   n = Rz(psi) n_H                psi heading of the body, n_H constant: theta and its rate are smooth at any pose
//                                  in which the body does not stand on its bow or stern
#pragma once

#include <array>

#include "sim/multibody/point.h"

namespace stillhook {

/// What the angle is measured between: fixed after construction.
struct PlaneAngle {
  BodyPoint upper, lower;          // ends of the hanging line
  int heading_body = kWorld;       // turns the plane
  Vector3 n_H = Vector3::UnitX();  // horizontal unit vector, in the heading frame of that body

  struct Value {
    double angle = 0.0, rate = 0.0;  // rad, rad/s; zero while the ends coincide in the plane
  };
  /// Derivatives with respect to one body: angle by xi, rate by xi and rate by u.
  struct Gradient {
    int body = kWorld;
    Eigen::Matrix<double, 1, 6> angle_xi, rate_xi, rate_u;
  };

  Value value(const Instant& now) const;
  /// The bodies are those of `upper`, `lower` and `heading_body`; equal bodies add up.
  std::array<Gradient, 3> gradient(const Instant& now) const;
};

/// The heading psi of a body: psi = atan2(R_10, R_00), as in heading_rotation().
double heading_angle(int body, const Instant& now);

}  // namespace stillhook
