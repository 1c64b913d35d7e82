// Ideal joints as rows of constraints C(q) = 0 between a parent and a child body.
//
// A joint carries a frame J on each body, equal at the initial pose: axis e1 (of rotation or sliding), e2, e3. With
// a = e_i of the parent, b = e_j of the child, p the joint point of each, the rows are made of three primitives:
//
//   point      p_C - p_P = 0           (3 rows)  revolute, spherical, fixed
//   square     a . b = 0               (1 row)   revolute 2 (the paper's Eq. 2), prismatic 3, fixed 3
//   in plane   a . (p_C - p_P) = 0     (1 row)   prismatic 2
//
// The parent's side may be a frame that moves by itself (prescribed_motion.h) instead of a body: C(q, t) = 0. Its rows
// stay those above, with that frame's pose in them; their rate at a fixed child is drift().
//
// Derivatives are with respect to xi = (dp in W, dtheta in B) of each body (see force_element.h). C_q^T lambda stands
// on the left of the equations of motion, so the joint pushes its child with -lambda.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "sim/multibody/joint_spec.h"
#include "sim/multibody/point.h"
#include "sim/multibody/prescribed_motion.h"

namespace stillhook {

class Joint {
 public:
  static constexpr int kMaxRows = 6;

  /// One body's share of the rows' Jacobian; only the first rows() rows are used.
  using Block = Eigen::Matrix<double, kMaxRows, 6>;
  using Rows = Eigen::Matrix<double, kMaxRows, 1>;

  std::string name;
  JointSpec::Type type = JointSpec::Type::revolute;
  BodyPoint on_parent, on_child;
  Matrix3 frame_on_parent = Matrix3::Identity();  // columns e1, e2, e3 in the parent's B
  Matrix3 frame_on_child = Matrix3::Identity();   // the same in the child's B, equal in W at the initial pose
  std::shared_ptr<const PrescribedMotion> motion;  // of the frame that the parent's side is fixed to, with the parent
                                                   // the world; null: it is fixed to the parent

  int rows() const;
  /// Values of the rows, m for points and planes, 1 for squares.
  void values(const Instant& now, Rows& C) const;
  void jacobian(const Instant& now, Block& parent, Block& child) const;
  /// The right-hand side of the acceleration constraint: -(C_q u)_q u, and what the prescribed motion adds to it.
  void quadratic_velocity(const Instant& now, Rows& gamma) const;
  /// Rate of the rows with the child at rest: zero without a prescribed motion.
  void drift(const Instant& now, Rows& C_t) const;
  /// Subtracts d(C_q^T lambda)/dxi from the stiffness (the stiffness of -C_q^T lambda).
  void add_stiffness(const Instant& now, const Rows& lambda, JacobianSum& out) const;

  /// Revolute: angle (rad, in (-pi, pi]) of the child about e1 relative to the initial pose. Prismatic: travel (m)
  /// along e1. Zero for the others.
  double coordinate(const Instant& now) const;
  double coordinate_rate(const Instant& now) const;
  /// e1 in W.
  Vector3 axis(const Instant& now) const;

 private:
  /// What the parent's side is fixed to: a body, the world, or a frame with a motion of its own. Rotations in W.
  struct Parent {
    Matrix3 R = Matrix3::Identity();
    Vector3 w = Vector3::Zero(), w_dot = Vector3::Zero();  // rad/s, rad/s2; w_dot of a prescribed motion only
    PointMotion point;                                     // the joint point
    Vector3 acceleration = Vector3::Zero();  // m/s2, of the joint point at zero dv, dw of a body
  };
  Parent parent(const Instant& now) const;
};

/// A joint between bodies (kWorld allowed for the parent) whose frames agree at `now`.
Joint make_joint(const JointSpec& spec, int parent, int child, const Vector3& parent_cog, const Vector3& child_cog,
                 const Instant& now);

}  // namespace stillhook
