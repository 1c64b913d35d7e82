#include "sim/spatial/pose.h"

#include <algorithm>
#include <cmath>

namespace stillhook {

Matrix3 rotation_from(const RollPitchYaw& angles) {
  return (Eigen::AngleAxisd(angles.yaw, Vector3::UnitZ()) * Eigen::AngleAxisd(angles.pitch, Vector3::UnitY()) *
          Eigen::AngleAxisd(angles.roll, Vector3::UnitX()))
      .toRotationMatrix();
}

RollPitchYaw roll_pitch_yaw(const Matrix3& R) {
  RollPitchYaw a;
  const double cos_pitch = std::hypot(R(0, 0), R(1, 0));
  a.pitch = std::atan2(-R(2, 0), cos_pitch);
  if (cos_pitch > 1e-9) {
    a.roll = std::atan2(R(2, 1), R(2, 2));
    a.yaw = std::atan2(R(1, 0), R(0, 0));
  } else {
    a.yaw = std::atan2(-R(0, 1), R(1, 1));
  }
  return a;
}

Matrix3 exp_rotation(const Vector3& phi) {
  const double t2 = phi.squaredNorm();
  double a, b;  // sin(t)/t and (1 - cos t)/t^2
  if (t2 < 1e-8) {
    a = 1.0 - t2 / 6.0 + t2 * t2 / 120.0;
    b = 0.5 - t2 / 24.0 + t2 * t2 / 720.0;
  } else {
    const double t = std::sqrt(t2);
    a = std::sin(t) / t;
    b = (1.0 - std::cos(t)) / t2;
  }
  const Matrix3 K = cross_matrix(phi);
  return Matrix3::Identity() + a * K + b * K * K;
}

Vector3 log_rotation(const Matrix3& R) {
  const Eigen::AngleAxisd aa(R);
  return aa.angle() * aa.axis();
}

Matrix3 right_jacobian(const Vector3& phi) {
  const double t2 = phi.squaredNorm();
  double b, c;  // (1 - cos t)/t^2 and (t - sin t)/t^3
  if (t2 < 1e-8) {
    b = 0.5 - t2 / 24.0;
    c = 1.0 / 6.0 - t2 / 120.0;
  } else {
    const double t = std::sqrt(t2);
    b = (1.0 - std::cos(t)) / t2;
    c = (t - std::sin(t)) / (t2 * t);
  }
  const Matrix3 K = cross_matrix(phi);
  return Matrix3::Identity() - b * K + c * K * K;
}

Matrix3 orthonormalised(const Matrix3& R) {
  // One Newton step of the polar decomposition: quadratic convergence, and R is orthonormal to rounding already.
  return R * (1.5 * Matrix3::Identity() - 0.5 * R.transpose() * R);
}

Matrix3 heading_rotation(const Matrix3& R_WB) {
  const double yaw = std::atan2(R_WB(1, 0), R_WB(0, 0));
  return Eigen::AngleAxisd(yaw, Vector3::UnitZ()).toRotationMatrix();
}

}  // namespace stillhook
