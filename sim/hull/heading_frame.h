// The heading frame H of linear theory, and its maps to the coordinates of the equations of motion.
//
//   V = T u     Q = T^T F     T = [R_WH^T  [c]x ; 0  1],  c = p_BC
//
// u = (v_WC in W, w_B) and Q = (force in W, moment about C in B) are those of force_element.h; V = (v_Bo, w) and
// F = (force, moment about Bo) are in H, whose origin is Bo and whose axes are the world's turned by the yaw psi of the
// mean position. Linear theory holds about that position, so T is constant: V^T F = u^T Q exactly, and the added mass
// T^T A T is constant too. Roll, pitch and changes of yaw are small; their products with forces are of second order.
#pragma once

#include "sim/multibody/force_element.h"

namespace stillhook {

struct HeadingFrame {
  int body = 0;
  Vector3 cog = Vector3::Zero();  // m, c = p_BC
  double heading = 0.0;           // rad, psi
  Matrix3 R_WH = Matrix3::Identity();

  bool operator==(const HeadingFrame&) const = default;
  HeadingFrame() = default;
  HeadingFrame(int body_, const Vector3& cog_, double heading_)
      : body(body_), cog(cog_), heading(heading_), R_WH(rotation_from({0.0, 0.0, heading_})) {}

  Matrix6 transform() const {
    Matrix6 T = Matrix6::Zero();
    T.topLeftCorner<3, 3>() = R_WH.transpose();
    T.topRightCorner<3, 3>() = cross_matrix(cog);
    T.bottomRightCorner<3, 3>().setIdentity();
    return T;
  }
  Vector6 velocity(const Instant& now) const {
    const BodyKinematics& b = now.body[body];
    Vector6 V;
    V.head<3>() = R_WH.transpose() * b.v_WC;
    V.head<3>() += cog.cross(b.w_B);
    V.tail<3>() = b.w_B;
    return V;
  }
  /// Velocity of C instead of Bo, axes as above.
  Vector6 velocity_of_cog(const Instant& now) const {
    const BodyKinematics& b = now.body[body];
    Vector6 V;
    V.head<3>() = R_WH.transpose() * b.v_WC;
    V.tail<3>() = b.w_B;
    return V;
  }
  void add_force(const Vector6& F, ForceSum& out) const {
    out.add(body, R_WH * F.head<3>(), F.tail<3>() - cog.cross(F.head<3>()));
  }
  /// A force and moment about C instead of Bo.
  void add_force_at_cog(const Vector6& F, ForceSum& out) const { out.add(body, R_WH * F.head<3>(), F.tail<3>()); }
  /// Where Bo is, m in W, at the body's actual attitude.
  Vector3 origin(const Instant& now) const { return now.body[body].p_WC - now.body[body].R_WB * cog; }
};

}  // namespace stillhook
