#include "sim/lifting/plane_angle.h"

#include <ceres/jet.h>

#include <cmath>

namespace stillhook {

namespace {

using Row6 = Eigen::Matrix<double, 1, 6>;

// psi and its rate, and their derivatives with respect to the body's rotation; that of the rate with respect to w is
// that of psi with respect to dtheta.
struct Heading {
  double psi = 0.0, rate = 0.0;
  Eigen::RowVector3d psi_theta = Eigen::RowVector3d::Zero(), rate_theta = Eigen::RowVector3d::Zero();
};

Heading heading_of(int body, const Instant& now) {
  Heading h;
  if (body == kWorld) return h;
  const BodyKinematics& k = now.body[body];
  const Vector3 ahead = Vector3::UnitX(), b = k.R_WB.col(0), swing = k.w_B.cross(ahead), b_rate = k.R_WB * swing;
  const double s = b.x() * b.x() + b.y() * b.y();
  const Eigen::RowVector3d q(-b.y() / s, b.x() / s, 0.0);  // dpsi/db
  h.psi = std::atan2(b.y(), b.x());
  h.rate = q.dot(b_rate);
  // d(R a) = -R [a]x dtheta for a constant in B, with a = e_x for b and a = w x e_x for its rate.
  Matrix3 q_b = Matrix3::Zero();
  q_b(0, 1) = -1.0 / s;
  q_b(1, 0) = 1.0 / s;
  q_b -= 2.0 / s * q.transpose() * Eigen::RowVector3d(b.x(), b.y(), 0.0);
  const Matrix3 b_theta = -k.R_WB * cross_matrix(ahead);
  h.psi_theta = q * b_theta;
  h.rate_theta = b_rate.transpose() * q_b * b_theta - q * k.R_WB * cross_matrix(swing);
  return h;
}

template <typename T>
struct AngleOf {
  T angle = T(0.0), rate = T(0.0);
};

// d, v (3 each): lower end relative to the upper end; psi and its rate; n_H.
template <typename T>
AngleOf<T> plane_angle(const T d[3], const T v[3], const T& psi, const T& psi_rate, const Vector3& n_H) {
  using std::atan2, std::cos, std::sin;
  const T c = cos(psi), s = sin(psi);
  const T nx = c * n_H.x() - s * n_H.y(), ny = s * n_H.x() + c * n_H.y();
  const T out = nx * d[0] + ny * d[1], down = -d[2];
  const T out_rate = nx * v[0] + ny * v[1] + psi_rate * (nx * d[1] - ny * d[0]);
  const T square = out * out + down * down;
  if (!(square > T(1e-18))) return {};
  return {atan2(out, down), (out_rate * down + out * v[2]) / square};
}

}  // namespace

double heading_angle(int body, const Instant& now) { return heading_of(body, now).psi; }

PlaneAngle::Value PlaneAngle::value(const Instant& now) const {
  const PointMotion up = motion_of(upper, now), low = motion_of(lower, now);
  const Vector3 d = low.p - up.p, v = low.v - up.v;
  const Heading h = heading_of(heading_body, now);
  const AngleOf<double> a = plane_angle(d.data(), v.data(), h.psi, h.rate, n_H);
  return {a.angle, a.rate};
}

std::array<PlaneAngle::Gradient, 3> PlaneAngle::gradient(const Instant& now) const {
  using Dual = ceres::Jet<double, 8>;
  const PointMotion up = motion_of(upper, now), low = motion_of(lower, now);
  const Heading h = heading_of(heading_body, now);
  Dual d[3], v[3];
  for (int i = 0; i < 3; ++i) {
    d[i] = Dual(low.p[i] - up.p[i], i);
    v[i] = Dual(low.v[i] - up.v[i], 3 + i);
  }
  const AngleOf<Dual> a = plane_angle(d, v, Dual(h.psi, 6), Dual(h.rate, 7), n_H);
  const Eigen::RowVector3d angle_d = a.angle.v.head<3>().transpose();
  const Eigen::RowVector3d rate_d = a.rate.v.head<3>().transpose(), rate_v = a.rate.v.segment<3>(3).transpose();

  std::array<Gradient, 3> all;
  const BodyPoint* ends[2] = {&lower, &upper};
  for (int i = 0; i < 2; ++i) {
    const double sign = i == 0 ? 1.0 : -1.0;
    const Eigen::Matrix<double, 3, 6> P = position_jacobian(*ends[i], now), V = velocity_stiffness(*ends[i], now);
    all[i].body = ends[i]->body;
    all[i].angle_xi = sign * angle_d * P;
    all[i].rate_xi = sign * (rate_d * P + rate_v * V);
    all[i].rate_u = sign * rate_v * P;
  }
  Gradient& turning = all[2];
  turning.body = heading_body;
  turning.angle_xi << 0.0, 0.0, 0.0, a.angle.v[6] * h.psi_theta;
  turning.rate_xi << 0.0, 0.0, 0.0, a.rate.v[6] * h.psi_theta + a.rate.v[7] * h.rate_theta;
  turning.rate_u << 0.0, 0.0, 0.0, a.rate.v[7] * h.psi_theta;
  return all;
}

}  // namespace stillhook
