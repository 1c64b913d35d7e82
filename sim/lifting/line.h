// A straight massless line between two points: its length, and the forces and derivatives of a tension in it.
//
//   l = |r|, r = p_a - p_b, e = r / l, ldot = e . v,      force at a = -T e, at b = +T e
//   dF_a/dr = -[ e (T_l e^T + T_ldot (v - ldot e)^T / l) + T (1 - e e^T) / l ],     dF_a/dv = -T_ldot e e^T
#pragma once

#include "sim/multibody/point.h"

namespace stillhook {

struct LineMotion {
  Vector3 v = Vector3::Zero();  // m/s, of a relative to b, in W
  Vector3 e = Vector3::Zero();  // from b to a, in W; zero when the ends coincide
  double length = 0.0;          // m
  double rate = 0.0;            // m/s
};

/// Ends closer than this have no direction: the line then carries no force. (m)
inline constexpr double kShortestLine = 1e-9;

inline LineMotion line_motion(const BodyPoint& a, const BodyPoint& b, const Instant& now) {
  const PointMotion ma = motion_of(a, now), mb = motion_of(b, now);
  LineMotion line;
  const Vector3 r = ma.p - mb.p;
  line.v = ma.v - mb.v;
  line.length = r.norm();
  if (line.length < kShortestLine) return line;
  line.e = r / line.length;
  line.rate = line.e.dot(line.v);
  return line;
}

/// Adds the pull of a tension (N) on both ends.
inline void add_line_forces(const BodyPoint& a, const BodyPoint& b, const Instant& now, const LineMotion& line,
                            double tension, ForceSum& out) {
  const Vector3 F_W = -tension * line.e;
  add_point_force(a, now, F_W, out);
  add_point_force(b, now, -F_W, out);
}

/// Adds the derivatives of add_line_forces for a tension with the given derivatives with respect to length (N/m) and
/// rate (N s/m).
inline void add_line_jacobian(const BodyPoint& a, const BodyPoint& b, const Instant& now, const LineMotion& line,
                              double tension, double by_length, double by_rate, JacobianSum& out) {
  if (line.length < kShortestLine) return;
  const Matrix3 along = line.e * line.e.transpose();
  const Vector3 rate_by_r = (line.v - line.rate * line.e) / line.length;
  const Matrix3 dF_dr = -(by_length * along + by_rate * line.e * rate_by_r.transpose() +
                          tension / line.length * (Matrix3::Identity() - along));
  add_pair_jacobian(a, b, now, -tension * line.e, dF_dr, -by_rate * along, out);
}

}  // namespace stillhook
