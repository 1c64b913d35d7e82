#include "sim/multibody/point.h"

namespace stillhook {

using Matrix36 = Eigen::Matrix<double, 3, 6>;

PointMotion motion_of(const BodyPoint& point, const Instant& now) {
  if (point.body == kWorld) return {point.c_B, Vector3::Zero()};
  const BodyKinematics& b = now.body[point.body];
  return {b.p_WC + b.R_WB * point.c_B, b.v_WC + b.R_WB * b.w_B.cross(point.c_B)};
}

Matrix36 position_jacobian(const BodyPoint& point, const Instant& now) {
  if (point.body == kWorld) return Matrix36::Zero();
  Matrix36 P;
  P.leftCols<3>().setIdentity();
  P.rightCols<3>() = -now.body[point.body].R_WB * cross_matrix(point.c_B);
  return P;
}

Matrix36 velocity_stiffness(const BodyPoint& point, const Instant& now) {
  Matrix36 V = Matrix36::Zero();
  if (point.body == kWorld) return V;
  const BodyKinematics& b = now.body[point.body];
  // d(R (w x c)) = R (dtheta x (w x c))
  V.rightCols<3>() = -b.R_WB * cross_matrix(b.w_B.cross(point.c_B));
  return V;
}

void add_point_force(const BodyPoint& point, const Instant& now, const Vector3& F_W, ForceSum& out) {
  if (point.body == kWorld) return;
  out.add(point.body, F_W, point.c_B.cross(now.body[point.body].R_WB.transpose() * F_W));
}

void add_force_jacobian(const BodyPoint& at, const Instant& now, const Vector3& F_W, int j, const Matrix36& A,
                        const Matrix36& B, bool own, JacobianSum& out) {
  if (at.body == kWorld || j == kWorld) return;
  const Matrix3 R_BW = now.body[at.body].R_WB.transpose();
  const Matrix3 arm = cross_matrix(at.c_B) * R_BW;
  Matrix6 K, C;
  K.topRows<3>() = A;
  K.bottomRows<3>() = arm * A;
  C.topRows<3>() = B;
  C.bottomRows<3>() = arm * B;
  // d(R^T F) = (R^T F) x dtheta for a fixed F
  if (own) K.bottomRightCorner<3, 3>() += cross_matrix(at.c_B) * cross_matrix(R_BW * F_W);
  out.add_stiffness(at.body, j, K);
  out.add_damping(at.body, j, C);
}

void add_pair_jacobian(const BodyPoint& a, const BodyPoint& b, const Instant& now, const Vector3& F_W,
                       const Matrix3& dF_dr, const Matrix3& dF_dv, JacobianSum& out) {
  const Matrix36 Pa = position_jacobian(a, now), Pb = position_jacobian(b, now);
  const Matrix36 Va = velocity_stiffness(a, now), Vb = velocity_stiffness(b, now);
  const Matrix36 Aa = dF_dr * Pa + dF_dv * Va, Ab = -(dF_dr * Pb + dF_dv * Vb);
  const Matrix36 Ba = dF_dv * Pa, Bb = -(dF_dv * Pb);
  add_force_jacobian(a, now, F_W, a.body, Aa, Ba, true, out);
  add_force_jacobian(a, now, F_W, b.body, Ab, Bb, false, out);
  add_force_jacobian(b, now, -F_W, b.body, -Ab, -Bb, true, out);
  add_force_jacobian(b, now, -F_W, a.body, -Aa, -Ba, false, out);
}

}  // namespace stillhook
