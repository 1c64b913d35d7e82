// Mechanisms for the tests of the multibody core, put together from world coordinates; and a spring to hang them on.
#pragma once

#include <memory>
#include <string>

#include "sim/multibody/hht.h"
#include "sim/multibody/system.h"
#include "tests/truth/general_motion.h"

namespace stillhook {

/// A line with spring and damper between two points, pulling and pushing: F on `a` = -(k (l - length) + c l') u along
/// u from b to a. With length zero the spring is the same in all directions.
class LineSpring : public ForceElement {
 public:
  LineSpring(std::string name, BodyPoint a, BodyPoint b, double k, double c, double length)
      : ForceElement(std::move(name)), a_(a), b_(b), k_(k), c_(c), length_(length) {}

  void add_forces(const Instant& now, double, Memory, ForceSum& out) const override {
    const Vector3 F = force(now);
    add_point_force(a_, now, F, out);
    add_point_force(b_, now, -F, out);
  }
  void add_jacobian(const Instant& now, double, Memory, JacobianSum& out) const override {
    const PointMotion a = motion_of(a_, now), b = motion_of(b_, now);
    const Vector3 r = a.p - b.p, v = a.v - b.v, u = r.normalized();
    const Matrix3 along = u * u.transpose(), across = (Matrix3::Identity() - along) / r.norm();
    const double T = k_ * (r.norm() - length_) + c_ * u.dot(v);
    const Matrix3 dF_dr = -k_ * along - T * across - c_ * u * v.transpose() * across;
    add_pair_jacobian(a_, b_, now, force(now), dF_dr, -c_ * along, out);
  }
  double potential_energy(const Instant& now, Memory) const override {
    const double s = (motion_of(a_, now).p - motion_of(b_, now).p).norm() - length_;
    return 0.5 * k_ * s * s;
  }

 private:
  Vector3 force(const Instant& now) const {
    const PointMotion a = motion_of(a_, now), b = motion_of(b_, now);
    const Vector3 r = a.p - b.p, u = r.normalized();
    return -(k_ * (r.norm() - length_) + c_ * u.dot(a.v - b.v)) * u;
  }

  BodyPoint a_, b_;
  double k_, c_, length_;
};

struct Mechanism {
  MultibodySystem system;
  SystemState state;

  /// Bodies get an origin away from their centre of gravity, so that the two are never confused.
  int add_body(const std::string& name, double mass, const Matrix3& inertia, const BodyKinematics& at) {
    const double i = static_cast<double>(system.bodies.size());
    system.bodies.push_back({name, mass, inertia, Vector3(0.3 + i, -0.2, 0.1 * i)});
    state.body.push_back(at);
    return static_cast<int>(system.bodies.size()) - 1;
  }
  /// A slender uniform bar from A to D (m, W) at rest, its line along the body's x.
  int add_bar(const std::string& name, double mass, const Vector3& A, const Vector3& D) {
    BodyKinematics at;
    at.p_WC = (A + D) / 2.0;
    at.R_WB = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitX(), D - A).toRotationMatrix();
    const double J = mass * (D - A).squaredNorm() / 12.0;
    return add_body(name, mass, Vector3(1e-3 * J, J, J).asDiagonal(), at);
  }
  BodyPoint point(int body, const Vector3& p_W) const {
    if (body == kWorld) return {kWorld, p_W};
    return {body, state.body[body].R_WB.transpose() * (p_W - state.body[body].p_WC)};
  }
  /// A joint at p_W; its axis is given in W.
  void add_joint(const std::string& name, JointSpec::Type type, int parent, int child, const Vector3& p_W,
                 const Vector3& axis_W = Vector3::UnitY()) {
    add_joint_between(name, type, parent, child, p_W, p_W, axis_W);
  }
  /// The same with two points that may lie apart: the joint is then open.
  void add_joint_between(const std::string& name, JointSpec::Type type, int parent, int child, const Vector3& on_parent,
                         const Vector3& on_child, const Vector3& axis_W) {
    JointSpec spec;
    spec.name = name;
    spec.type = type;
    const Vector3 cog = parent == kWorld ? Vector3::Zero() : system.bodies[parent].cog;
    spec.point_on_parent = point(parent, on_parent).c_B + cog;
    spec.point_on_child = point(child, on_child).c_B + system.bodies[child].cog;
    spec.axis = parent == kWorld ? axis_W : Vector3(state.body[parent].R_WB.transpose() * axis_W);
    system.joints.push_back(make_joint(spec, parent, child, cog, system.bodies[child].cog, state.instant()));
  }
  /// Gives body i the motion of a turn about the point with angular velocity w_W.
  void spin(int i, const Vector3& about_W, const Vector3& w_W, const Vector3& v_W = Vector3::Zero()) {
    BodyKinematics& b = state.body[i];
    b.w_B = b.R_WB.transpose() * w_W;
    b.v_WC = v_W + w_W.cross(b.p_WC - about_W);
  }
  void finish() {
    system.finish();
    state.acceleration = VectorX::Zero(system.coordinates());
    state.lambda = VectorX::Zero(system.constraints());
    state.element_state.assign(system.element_state_size(), 0.0);
  }
  VectorX velocities() const {
    VectorX u(system.coordinates());
    for (std::size_t i = 0; i < state.body.size(); ++i) u.segment<6>(6 * i) << state.body[i].v_WC, state.body[i].w_B;
    return u;
  }
  VectorX rows() const {
    VectorX C;
    system.constraint_values(state, C);
    return C;
  }
  /// C_q u, the rows at the level of velocities.
  VectorX row_rates() const {
    MatrixX C_q;
    system.constraint_jacobian(state, C_q);
    return C_q * velocities();
  }
  Vector3 reaction(int joint) const {
    Vector3 force, moment;
    system.joint_reaction(state, joint, force, moment);
    return force;
  }
};

/// A full symmetric inertia of a real body: principal values in general directions, none larger than the sum of the
/// others.
inline Matrix3 general_inertia(truth::GeneralMotion& draw, double size) {
  const Matrix3 R = draw.rotation();
  return size * R * Vector3(1.0, 1.5, 2.1).asDiagonal() * R.transpose();
}

/// Steps to time t_end; returns false when a step fails.
inline bool run_to(HhtStepper& stepper, SystemState& state, double t_end, int steps) {
  const double h = (t_end - state.t) / steps;
  for (int k = 0; k < steps; ++k)
    if (!stepper.step(state, h, state.drive)) return false;
  return true;
}

}  // namespace stillhook
