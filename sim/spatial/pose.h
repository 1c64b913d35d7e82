// Frames, poses and rotations.
//
// Frames used everywhere in stillhook (DESIGN of the project, "Conventions" in docs/theory.md):
//   W  world: right-handed, z up, origin on the mean free surface.
//   B  body: fixed to a rigid body, x forward, y port, z up. B's origin Bo is the one the case file uses.
//   C  the body's centre of gravity, axes parallel to B. It is where the equations of motion are written.
//
// Monogram notation (as in Drake): p_WT is the position of T from Wo expressed in W; R_WB turns components in B
// into components in W; X_WB = (R_WB, p_WB); v_WC the velocity of C in W; w_B the angular velocity of B in W
// expressed in B. A product is right when neighbouring letters cancel: p_WT = X_WB * p_BT.
//
// Roll, pitch and yaw are the ZYX Euler angles R_WB = Rz(yaw) Ry(pitch) Rx(roll) and exist at input and output
// only. roll+ is port side up, pitch+ is bow down, yaw+ is bow to port.
#pragma once

#include <Eigen/Dense>

namespace stillhook {

using Vector3 = Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix3 = Eigen::Matrix3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using MatrixX = Eigen::MatrixXd;
using VectorX = Eigen::VectorXd;

/// Position and orientation of one frame in another: X_AB maps components in B to components in A.
struct Pose {
  Matrix3 R = Matrix3::Identity();
  Vector3 p = Vector3::Zero();  // m

  Vector3 operator*(const Vector3& p_B) const { return p + R * p_B; }
  Pose operator*(const Pose& X_BC) const { return {R * X_BC.R, p + R * X_BC.p}; }
  Pose inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

/// ZYX Euler angles, rad.
struct RollPitchYaw {
  double roll = 0.0, pitch = 0.0, yaw = 0.0;
};

/// The matrix [v]x with [v]x w = v x w.
inline Matrix3 cross_matrix(const Vector3& v) {
  Matrix3 m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

/// R_WB from ZYX Euler angles (rad).
Matrix3 rotation_from(const RollPitchYaw& angles);

/// ZYX Euler angles of R_WB; at the singularity pitch = +-90 deg the roll is returned as zero.
RollPitchYaw roll_pitch_yaw(const Matrix3& R_WB);

/// Exponential map: the rotation by |phi| rad about phi.
Matrix3 exp_rotation(const Vector3& phi);

/// Inverse of exp_rotation for angles below pi.
Vector3 log_rotation(const Matrix3& R);

/// Right Jacobian of the exponential: exp(phi + d) = exp(phi) exp(J d) to first order in d.
Matrix3 right_jacobian(const Vector3& phi);

/// The nearest rotation to R; R must be close to one already.
Matrix3 orthonormalised(const Matrix3& R);

/// Rotation about z by the yaw (heading) of R_WB alone.
Matrix3 heading_rotation(const Matrix3& R_WB);

}  // namespace stillhook
