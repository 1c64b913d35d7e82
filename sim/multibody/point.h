// A point fixed to a body: its motion, its derivatives, and the assembly of forces that act at points.
#pragma once

#include "sim/multibody/force_element.h"

namespace stillhook {

/// A point fixed to a body (or to the world), given relative to the centre of gravity.
struct BodyPoint {
  int body = kWorld;
  Vector3 c_B = Vector3::Zero();  // m, p_CT in B; for the world: p_WT
  bool operator==(const BodyPoint&) const = default;
};

/// Position and velocity of a point, and the maps from (dp, dtheta) and (dv, dw) of its body.
struct PointMotion {
  Vector3 p = Vector3::Zero();  // m, in W
  Vector3 v = Vector3::Zero();  // m/s, in W
};

PointMotion motion_of(const BodyPoint& point, const Instant& now);

/// R_WB of a body; the identity for the world.
inline Matrix3 rotation_of(int body, const Instant& now) {
  return body == kWorld ? Matrix3::Identity() : now.body[body].R_WB;
}

/// Angular velocity w_B of a body in its own frame, rad/s; zero for the world.
inline Vector3 spin_of(int body, const Instant& now) {
  return body == kWorld ? Vector3::Zero() : now.body[body].w_B;
}

/// dp_T = P xi with P (3 x 6). For the world the result is zero.
Eigen::Matrix<double, 3, 6> position_jacobian(const BodyPoint& point, const Instant& now);

/// dv_T = P du + V xi; this returns V (3 x 6), P is position_jacobian.
Eigen::Matrix<double, 3, 6> velocity_stiffness(const BodyPoint& point, const Instant& now);

/// Adds force F_W (N) at the point.
void add_point_force(const BodyPoint& point, const Instant& now, const Vector3& F_W, ForceSum& out);

/// Adds the derivatives of a pair of forces F_W at `a` and -F_W at `b` that depend on the relative position
/// r = p_a - p_b through dF/dr (3 x 3) and on the relative velocity through dF/dv (3 x 3). F_W is needed for the
/// moment that the same force makes about a turned body. Exact for any pose.
void add_pair_jacobian(const BodyPoint& a, const BodyPoint& b, const Instant& now, const Vector3& F_W,
                       const Matrix3& dF_dr, const Matrix3& dF_dv, JacobianSum& out);

/// General form of one side: a force F_W at `at` on its body changes with the configuration and velocity of body j
/// by dF = A xi_j + B du_j (each 3 x 6). Adds force and moment rows. `own` must be true when j is the point's own
/// body, so that the turning of the force in its frame is counted once.
void add_force_jacobian(const BodyPoint& at, const Instant& now, const Vector3& F_W, int j,
                        const Eigen::Matrix<double, 3, 6>& A, const Eigen::Matrix<double, 3, 6>& B, bool own,
                        JacobianSum& out);

}  // namespace stillhook
