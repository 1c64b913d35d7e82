#include "sim/multibody/joint.h"

#include <cmath>

namespace stillhook {
namespace {

// The pairs (parent axis, child axis) that stay square, in the order of the rows.
struct Square {
  int parent_axis, child_axis;
};
constexpr Square kRevolute[] = {{1, 0}, {2, 0}};
constexpr Square kLocked[] = {{0, 1}, {0, 2}, {1, 2}};
constexpr int kPlanes[] = {1, 2};

struct Layout {
  int point_rows;               // 0 or 3
  std::span<const int> planes;  // parent axes
  std::span<const Square> squares;
};

Layout layout_of(JointSpec::Type type) {
  switch (type) {
    case JointSpec::Type::revolute:
      return {3, {}, kRevolute};
    case JointSpec::Type::spherical:
      return {3, {}, {}};
    case JointSpec::Type::fixed:
      return {3, {}, kLocked};
    case JointSpec::Type::prismatic:
      return {0, kPlanes, kLocked};
  }
  return {3, {}, {}};
}

// Acceleration of a point that the body has at zero dv, dw.
Vector3 centripetal(const BodyPoint& point, const Instant& now) {
  if (point.body == kWorld) return Vector3::Zero();
  const Vector3& w = now.body[point.body].w_B;
  return now.body[point.body].R_WB * w.cross(w.cross(point.c_B));
}

}  // namespace

int Joint::rows() const {
  const Layout l = layout_of(type);
  return l.point_rows + static_cast<int>(l.planes.size() + l.squares.size());
}

Joint::Parent Joint::parent(const Instant& now) const {
  Parent P;
  if (!motion) {
    P.R = rotation_of(on_parent.body, now);
    P.w = P.R * spin_of(on_parent.body, now);
    P.point = motion_of(on_parent, now);
    P.acceleration = centripetal(on_parent, now);
    return P;
  }
  const FrameMotion F = motion->at(now.t);
  const Vector3 arm = F.R * on_parent.c_B;
  P.R = F.R;
  P.w = F.w;
  P.w_dot = F.w_dot;
  P.point = {F.p + arm, F.v + F.w.cross(arm)};
  P.acceleration = F.a + F.w_dot.cross(arm) + F.w.cross(F.w.cross(arm));
  return P;
}

void Joint::values(const Instant& now, Rows& C) const {
  const Layout l = layout_of(type);
  const Parent P = parent(now);
  const Vector3 d = motion_of(on_child, now).p - P.point.p;
  const Matrix3 Fp = P.R * frame_on_parent, Fc = rotation_of(on_child.body, now) * frame_on_child;
  int r = 0;
  if (l.point_rows) {
    C.segment<3>(0) = d;
    r = 3;
  }
  for (int i : l.planes) C[r++] = Fp.col(i).dot(d);
  for (const Square& s : l.squares) C[r++] = Fp.col(s.parent_axis).dot(Fc.col(s.child_axis));
}

void Joint::jacobian(const Instant& now, Block& parent_block, Block& child) const {
  const Layout l = layout_of(type);
  parent_block.setZero();
  child.setZero();
  const Parent P = parent(now);
  const Matrix3 &Rp = P.R, Rc = rotation_of(on_child.body, now);
  const Vector3 d = motion_of(on_child, now).p - P.point.p;
  int r = 0;
  if (l.point_rows) {
    parent_block.topRows<3>() = -position_jacobian(on_parent, now);
    child.topRows<3>() = position_jacobian(on_child, now);
    r = 3;
  }
  for (int i : l.planes) {
    const Vector3 a_P = frame_on_parent.col(i), a = Rp * a_P;
    parent_block.row(r).head<3>() = -a.transpose();
    parent_block.row(r).tail<3>() = a_P.cross(Rp.transpose() * d + on_parent.c_B).transpose();
    child.row(r).head<3>() = a.transpose();
    child.row(r).tail<3>() = on_child.c_B.cross(Rc.transpose() * a).transpose();
    ++r;
  }
  for (const Square& s : l.squares) {
    const Vector3 a_P = frame_on_parent.col(s.parent_axis), b_C = frame_on_child.col(s.child_axis);
    parent_block.row(r).tail<3>() = a_P.cross(Rp.transpose() * (Rc * b_C)).transpose();
    child.row(r).tail<3>() = b_C.cross(Rc.transpose() * (Rp * a_P)).transpose();
    ++r;
  }
}

void Joint::quadratic_velocity(const Instant& now, Rows& gamma) const {
  const Layout l = layout_of(type);
  const Parent P = parent(now);
  const Matrix3 Rc = rotation_of(on_child.body, now);
  const Vector3 wc = spin_of(on_child.body, now);
  const PointMotion C = motion_of(on_child, now);
  const Vector3 d = C.p - P.point.p, d_dot = C.v - P.point.v;
  const Vector3 d_quadratic = centripetal(on_child, now) - P.acceleration;
  int r = 0;
  if (l.point_rows) {
    gamma.segment<3>(0) = -d_quadratic;
    r = 3;
  }
  const auto turning = [&P](const Vector3& a) { return Vector3(P.w.cross(P.w.cross(a)) + P.w_dot.cross(a)); };
  for (int i : l.planes) {
    const Vector3 a = P.R * frame_on_parent.col(i), a_dot = P.w.cross(a);
    gamma[r++] = -(turning(a).dot(d) + 2.0 * a_dot.dot(d_dot) + a.dot(d_quadratic));
  }
  for (const Square& s : l.squares) {
    const Vector3 a = P.R * frame_on_parent.col(s.parent_axis), b_C = frame_on_child.col(s.child_axis);
    gamma[r++] = -(turning(a).dot(Rc * b_C) + 2.0 * P.w.cross(a).dot(Rc * wc.cross(b_C)) +
                   a.dot(Rc * wc.cross(wc.cross(b_C))));
  }
}

void Joint::drift(const Instant& now, Rows& C_t) const {
  C_t.setZero();
  if (!motion) return;
  const Layout l = layout_of(type);
  const Parent P = parent(now);
  const Vector3 d = motion_of(on_child, now).p - P.point.p;
  const Matrix3 Fc = rotation_of(on_child.body, now) * frame_on_child;
  int r = 0;
  if (l.point_rows) {
    C_t.segment<3>(0) = -P.point.v;
    r = 3;
  }
  for (int i : l.planes) {
    const Vector3 a = P.R * frame_on_parent.col(i);
    C_t[r++] = P.w.cross(a).dot(d) - a.dot(P.point.v);
  }
  for (const Square& s : l.squares)
    C_t[r++] = P.w.cross(P.R * frame_on_parent.col(s.parent_axis)).dot(Fc.col(s.child_axis));
}

void Joint::add_stiffness(const Instant& now, const Rows& lambda, JacobianSum& out) const {
  const Layout l = layout_of(type);
  const int p = on_parent.body, c = on_child.body;
  const Parent P = parent(now);
  const Matrix3 &Rp = P.R, Rc = rotation_of(c, now);
  const Vector3 d = motion_of(on_child, now).p - P.point.p;
  Matrix6 Kpp = Matrix6::Zero(), Kpc = Matrix6::Zero(), Kcp = Matrix6::Zero(), Kcc = Matrix6::Zero();
  int r = 0;
  if (l.point_rows) {
    const Vector3 f = lambda.segment<3>(0);
    Kcc.bottomRightCorner<3, 3>() += cross_matrix(on_child.c_B) * cross_matrix(Rc.transpose() * f);
    Kpp.bottomRightCorner<3, 3>() -= cross_matrix(on_parent.c_B) * cross_matrix(Rp.transpose() * f);
    r = 3;
  }
  for (int i : l.planes) {
    const double f = lambda[r++];
    const Vector3 a_P = frame_on_parent.col(i), a = Rp * a_P, a_C = Rc.transpose() * a;
    const Matrix3 da = -Rp * cross_matrix(a_P);  // da / dtheta_P
    const Eigen::Matrix<double, 3, 6> dd_p = -position_jacobian(on_parent, now),
                                      dd_c = position_jacobian(on_child, now);
    const Matrix3 arm_p = cross_matrix(a_P) * Rp.transpose(), arm_c = cross_matrix(on_child.c_B);
    Kpp.topRightCorner<3, 3>() -= f * da;
    Kcp.topRightCorner<3, 3>() += f * da;
    Kpp.bottomRows<3>() += f * arm_p * dd_p;
    Kpc.bottomRows<3>() += f * arm_p * dd_c;
    Kpp.bottomRightCorner<3, 3>() += f * cross_matrix(a_P) * cross_matrix(Rp.transpose() * d);
    Kcc.bottomRightCorner<3, 3>() += f * arm_c * cross_matrix(a_C);
    Kcp.bottomRightCorner<3, 3>() += f * arm_c * Rc.transpose() * da;
  }
  for (const Square& s : l.squares) {
    const double f = lambda[r++];
    const Vector3 a_P = frame_on_parent.col(s.parent_axis), b_C = frame_on_child.col(s.child_axis);
    const Matrix3 R_PC = Rp.transpose() * Rc;
    Kpp.bottomRightCorner<3, 3>() += f * cross_matrix(a_P) * cross_matrix(R_PC * b_C);
    Kpc.bottomRightCorner<3, 3>() -= f * cross_matrix(a_P) * R_PC * cross_matrix(b_C);
    Kcc.bottomRightCorner<3, 3>() += f * cross_matrix(b_C) * cross_matrix(R_PC.transpose() * a_P);
    Kcp.bottomRightCorner<3, 3>() -= f * cross_matrix(b_C) * R_PC.transpose() * cross_matrix(a_P);
  }
  out.add_stiffness(p, p, -Kpp);
  out.add_stiffness(p, c, -Kpc);
  out.add_stiffness(c, p, -Kcp);
  out.add_stiffness(c, c, -Kcc);
}

double Joint::coordinate(const Instant& now) const {
  const Parent P = parent(now);
  const Matrix3 Fp = P.R * frame_on_parent;
  if (type == JointSpec::Type::revolute) {
    const Vector3 e2 = rotation_of(on_child.body, now) * frame_on_child.col(1);
    return std::atan2(Fp.col(2).dot(e2), Fp.col(1).dot(e2));
  }
  if (type == JointSpec::Type::prismatic) return Fp.col(0).dot(motion_of(on_child, now).p - P.point.p);
  return 0.0;
}

double Joint::coordinate_rate(const Instant& now) const {
  const Parent P = parent(now);
  const Vector3 e1 = P.R * frame_on_parent.col(0);
  if (type == JointSpec::Type::revolute)
    return e1.dot(rotation_of(on_child.body, now) * spin_of(on_child.body, now) - P.w);
  if (type == JointSpec::Type::prismatic) {
    const PointMotion C = motion_of(on_child, now);
    return e1.dot(C.v - P.point.v - P.w.cross(C.p - P.point.p));
  }
  return 0.0;
}

Vector3 Joint::axis(const Instant& now) const { return parent(now).R * frame_on_parent.col(0); }

Joint make_joint(const JointSpec& spec, int parent, int child, const Vector3& parent_cog, const Vector3& child_cog,
                 const Instant& now) {
  Joint joint;
  joint.name = spec.name;
  joint.type = spec.type;
  joint.on_parent = {parent, parent == kWorld ? spec.point_on_parent : Vector3(spec.point_on_parent - parent_cog)};
  joint.on_child = {child, spec.point_on_child - child_cog};
  const Vector3 e1 = spec.axis.normalized();
  const Vector3 e2 = e1.unitOrthogonal();
  joint.frame_on_parent << e1, e2, e1.cross(e2);
  joint.frame_on_child = now.body[child].R_WB.transpose() * (rotation_of(parent, now) * joint.frame_on_parent);
  return joint;
}

}  // namespace stillhook
