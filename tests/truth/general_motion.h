// Bodies at general poses in general motion, and central differences of what depends on them: the material of every
// derivative test. Poses are drawn from a seeded generator, so a failure repeats.
#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "sim/multibody/force_element.h"

namespace stillhook::truth {

class GeneralMotion {
 public:
  explicit GeneralMotion(unsigned seed) : engine_(seed) {}

  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Vector3 vector(double size) { return {number(-size, size), number(-size, size), number(-size, size)}; }
  Vector3 unit() {
    Vector3 v = vector(1.0);
    while (v.norm() < 0.3) v = vector(1.0);
    return v.normalized();
  }
  /// Built from a unit quaternion, not from the exponential map under test.
  Matrix3 rotation() {
    Eigen::Quaterniond q(number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1));
    while (q.norm() < 0.3) q = Eigen::Quaterniond(number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1));
    return q.normalized().toRotationMatrix();
  }
  BodyKinematics body(double place = 5.0, double speed = 2.0, double spin = 1.0) {
    return {rotation(), vector(place), vector(speed), vector(spin)};
  }

 private:
  std::mt19937 engine_;
};

/// The body turned and shifted by xi = (dp in W, dtheta in B), velocities held.
inline BodyKinematics moved(BodyKinematics b, const Vector6& xi) {
  b.p_WC += xi.head<3>();
  const double angle = xi.tail<3>().norm();
  if (angle > 0.0) b.R_WB = b.R_WB * Eigen::AngleAxisd(angle, xi.tail<3>() / angle).toRotationMatrix();
  return b;
}

/// The body with velocities changed by du.
inline BodyKinematics hastened(BodyKinematics b, const Vector6& du) {
  b.v_WC += du.head<3>();
  b.w_B += du.tail<3>();
  return b;
}

using BodyChange = BodyKinematics (*)(BodyKinematics, const Vector6&);

/// Central differences of f over the 6 coordinates of each body; one column a coordinate. Error about step^2 and
/// 1e-16 / step, relative to f and its third derivative.
inline MatrixX central_differences(const std::vector<BodyKinematics>& at, BodyChange change,
                                   const std::function<VectorX(const std::vector<BodyKinematics>&)>& f,
                                   double step = 1e-5) {
  const int n = 6 * static_cast<int>(at.size());
  MatrixX D;
  for (int k = 0; k < n; ++k) {
    std::vector<BodyKinematics> low = at, high = at;
    Vector6 d = Vector6::Zero();
    d[k % 6] = step;
    high[k / 6] = change(at[k / 6], d);
    d[k % 6] = -step;
    low[k / 6] = change(at[k / 6], d);
    const VectorX column = (f(high) - f(low)) / (2.0 * step);
    if (k == 0) D.resize(column.size(), n);
    D.col(k) = column;
  }
  return D;
}

}  // namespace stillhook::truth
