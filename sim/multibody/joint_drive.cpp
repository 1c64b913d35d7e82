#include "sim/multibody/joint_drive.h"

#include <cmath>

namespace stillhook {
namespace {

using Matrix36 = Eigen::Matrix<double, 3, 6>;

}  // namespace

JointDrive::JointDrive(std::string name, Joint joint, double stiffness, double damping, double rest, int drive)
    : ForceElement(std::move(name)),
      joint_(std::move(joint)),
      stiffness_(stiffness),
      damping_(damping),
      rest_(rest),
      drive_(drive) {}

double JointDrive::stretch(const Instant& now) const {
  const double s = joint_.coordinate(now) - rest_ - (drive_ >= 0 ? now.drive[drive_].position : 0.0);
  // An angle is known up to full turns: the spring takes the shorter way, so a drive may pass half a turn.
  return joint_.type == JointSpec::Type::revolute ? std::remainder(s, 2.0 * M_PI) : s;
}

double JointDrive::stretch_rate(const Instant& now) const {
  return joint_.coordinate_rate(now) - (drive_ >= 0 ? now.drive[drive_].rate : 0.0);
}

double JointDrive::load(const Instant& now) const { return -stiffness_ * stretch(now) - damping_ * stretch_rate(now); }

bool JointDrive::same_as(const ForceElement& other) const {
  const auto* drive = dynamic_cast<const JointDrive*>(&other);
  return drive && drive->stiffness_ == stiffness_ && drive->damping_ == damping_ && drive->rest_ == rest_ &&
         drive->joint_.on_parent == joint_.on_parent && drive->joint_.on_child == joint_.on_child &&
         drive->joint_.frame_on_parent == joint_.frame_on_parent &&
         drive->joint_.frame_on_child == joint_.frame_on_child;
}

void JointDrive::add_forces(const Instant& now, double, Memory, ForceSum& out) const {
  const Vector3 load_W = load(now) * joint_.axis(now);
  const int p = joint_.on_parent.body, c = joint_.on_child.body;
  if (joint_.type == JointSpec::Type::revolute) {
    if (c != kWorld) out.add(c, Vector3::Zero(), now.body[c].R_WB.transpose() * load_W);
    if (p != kWorld) out.add(p, Vector3::Zero(), -(now.body[p].R_WB.transpose() * load_W));
    return;
  }
  // Prismatic: the pair acts along one line, through the child's joint point.
  add_point_force(joint_.on_child, now, load_W, out);
  if (p == kWorld) return;
  const Vector3 arm_W = motion_of(joint_.on_child, now).p - now.body[p].p_WC;
  out.add(p, -load_W, -(now.body[p].R_WB.transpose() * arm_W.cross(load_W)));
}

void JointDrive::add_jacobian(const Instant& now, double, Memory, JacobianSum& out) const {
  if (joint_.type == JointSpec::Type::revolute)
    add_turning_jacobian(now, out);
  else
    add_sliding_jacobian(now, out);
}

// The generalised force is tau s_p^T on the parent and tau s_c^T on the child (virtual work), where the coordinate
// changes by ds = s_p xi_p + s_c xi_c and its rate by s_p du_p + s_c du_c + r_p xi_p + r_c xi_c. This adds the share of
// the load's change.
void JointDrive::add_load_jacobian(const Row6& s_p, const Row6& s_c, const Row6& r_p, const Row6& r_c,
                                   JacobianSum& out) const {
  const int p = joint_.on_parent.body, c = joint_.on_child.body;
  const Row6 k_p = -stiffness_ * s_p - damping_ * r_p, k_c = -stiffness_ * s_c - damping_ * r_c;
  const auto add = [&out](int i, const Row6& s_i, int j, const Row6& k, const Row6& c_j) {
    out.add_stiffness(i, j, s_i.transpose() * k);
    out.add_damping(i, j, s_i.transpose() * c_j);
  };
  const Row6 c_p = -damping_ * s_p, c_c = -damping_ * s_c;
  add(p, s_p, p, k_p, c_p);
  add(p, s_p, c, k_c, c_c);
  add(c, s_c, p, k_p, c_p);
  add(c, s_c, c, k_c, c_c);
}

void JointDrive::add_turning_jacobian(const Instant& now, JacobianSum& out) const {
  const int p = joint_.on_parent.body, c = joint_.on_child.body;
  const Matrix3 R_P = rotation_of(p, now), R_C = rotation_of(c, now), R_CP = R_C.transpose() * R_P;
  const Vector3 e_P = joint_.frame_on_parent.col(0), e_C = R_CP * e_P, w_C = spin_of(c, now);
  Row6 s_p = Row6::Zero(), s_c = Row6::Zero(), r_p = Row6::Zero(), r_c = Row6::Zero();
  s_p.tail<3>() = -e_P.transpose();
  s_c.tail<3>() = e_C.transpose();
  // rate = (R_P e_P) . (R_C w_C) - e_P . w_P; only its first term changes with the angles
  r_p.tail<3>() = -(R_CP.transpose() * w_C).transpose() * cross_matrix(e_P);
  r_c.tail<3>() = -e_C.transpose() * cross_matrix(w_C);
  add_load_jacobian(s_p, s_c, r_p, r_c, out);
  // The moment on the child, tau e_C, turns with the parent's axis.
  const double tau = load(now);
  Matrix6 K = Matrix6::Zero();
  K.bottomRightCorner<3, 3>() = tau * cross_matrix(e_C);
  out.add_stiffness(c, c, K);
  K.bottomRightCorner<3, 3>() = -tau * R_CP * cross_matrix(e_P);
  out.add_stiffness(c, p, K);
}

void JointDrive::add_sliding_jacobian(const Instant& now, JacobianSum& out) const {
  const int p = joint_.on_parent.body, c = joint_.on_child.body;
  const Matrix3 R_P = rotation_of(p, now), R_PW = R_P.transpose();
  const Vector3 e_P = joint_.frame_on_parent.col(0), e = R_P * e_P, w_P = spin_of(p, now);
  const PointMotion tip = motion_of(joint_.on_child, now), centre = motion_of({p, Vector3::Zero()}, now);
  const Vector3 tip_P = R_PW * (tip.p - centre.p);  // from the parent's centre of gravity
  const Matrix36 tip_moves = position_jacobian(joint_.on_child, now);
  Matrix36 dtip_P;  // change of tip_P with the parent
  dtip_P << -R_PW, cross_matrix(tip_P);

  Row6 s_p, s_c = e.transpose() * tip_moves;
  s_p.head<3>() = -e;
  s_p.tail<3>() = -tip_P.cross(e_P);
  // rate = e_P . (R_P^T (v_tip - v_P) - w_P x tip_P)
  const Eigen::Matrix<double, 1, 3> swing = -e_P.cross(w_P).transpose();
  Row6 r_p = swing * dtip_P;
  r_p.tail<3>() += e_P.transpose() * cross_matrix(R_PW * (tip.v - centre.v));
  const Row6 r_c = e.transpose() * velocity_stiffness(joint_.on_child, now) + swing * R_PW * tip_moves;
  add_load_jacobian(s_p, s_c, r_p, r_c, out);

  // The force tau e on the child at its point and -tau e on the parent at the same place: e turns with the parent, the
  // place moves with both.
  const double tau = load(now);
  const Matrix36 zero = Matrix36::Zero();
  Matrix36 turned = zero;
  turned.rightCols<3>() = -tau * R_P * cross_matrix(e_P);
  add_force_jacobian(joint_.on_child, now, tau * e, c, zero, zero, true, out);
  add_force_jacobian(joint_.on_child, now, tau * e, p, turned, zero, false, out);
  const Matrix3 arm = tau * cross_matrix(e_P);
  Matrix6 K = Matrix6::Zero();
  K.topRows<3>() = -turned;
  K.bottomRows<3>() = arm * dtip_P;
  out.add_stiffness(p, p, K);
  K.topRows<3>().setZero();
  K.bottomRows<3>() = arm * R_PW * tip_moves;
  out.add_stiffness(p, c, K);
}

double JointDrive::potential_energy(const Instant& now, Memory) const {
  const double s = stretch(now);
  return 0.5 * stiffness_ * s * s;
}

double JointDrive::dissipated_power(const Instant& now, Memory) const {
  const double v = stretch_rate(now);
  return damping_ * v * v;
}

std::vector<Channel> JointDrive::channels() const {
  const bool turning = joint_.type == JointSpec::Type::revolute;
  return {{name() + ".load", turning ? "N m" : "N", "drive moment or force on the child about the joint's axis"}};
}

void JointDrive::measure(const Instant& now, Memory, std::span<double> out) const { out[0] = load(now); }

}  // namespace stillhook
