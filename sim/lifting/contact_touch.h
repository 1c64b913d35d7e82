// One point of a contact as its surface sees it: what contact.cpp and contact_measure.cpp share.
#pragma once

#include <cmath>

#include "sim/lifting/contact.h"

namespace stillhook {

// The surface body: its frame, and its motion expressed in it.
struct Contact::Surface {
  Matrix3 R_WS = Matrix3::Identity();
  Vector3 p_WC = Vector3::Zero(), v_WC = Vector3::Zero(), w_S = Vector3::Zero();
};

// One point as seen from the surface body.
struct Contact::Touch {
  BodyPoint point;
  PointMotion motion;   // in W
  Vector3 x_S, v_S;     // m, m/s: position from the surface body's C, and velocity seen by it
  double depth = 0.0;   // m, below the plane of the rectangle
  double beside = 0.0;  // m, horizontal distance from the rectangle, 0 above it
  bool touching() const { return depth > 0.0 && beside == 0.0; }
  double gap(const Instant& now) const { return now.on(beside > 0.0) ? std::hypot(beside, depth) : -depth; }
};

// The derivatives of x_S and v_S: by the configuration of the point's body (xA, vA) and of the surface's (xS, vS).
// Those of v_S by the bodies' velocities are xA and xS again.
struct Contact::Seen {
  Eigen::Matrix<double, 3, 6> xA, vA, xS, vS;
};

// The tangential force on one point: of the spring (E), and in all (F).
struct Contact::Grip {
  Eigen::Vector2d spring, force;  // N
  bool slips = false;             // the anchor is dragged along
  // By the spring's uncut force, by the damper's and by the cone mu N.
  Eigen::Matrix2d by_spring, by_damper;
  Eigen::Vector2d by_cone;
};

}  // namespace stillhook
