// The equations of motion of the paper's Eq. 3 in residual form, assembled from bodies, joints and force elements.
//
//   M a + h(u) + C_q^T lambda = Q(q, u, t)        C(q, t) = 0
//
// with u_i = (v_WC, w_B), M constant (rigid bodies plus the added mass of the hulls), h the gyroscopic moment
// w x (J w), C_q the constraint Jacobian and lambda the Lagrange multipliers. (Cha, Nam & Ha 2018, Eq. 1-4; Shabana
// 2005, ch. 5.)
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/multibody/force_element.h"
#include "sim/multibody/joint.h"

namespace stillhook {

struct RigidBody {
  std::string name;
  double mass = 0.0;                  // kg
  Matrix3 inertia = Matrix3::Zero();  // kg m2, about C in B
  Vector3 cog = Vector3::Zero();      // m, p_BC
};

/// The state of a simulation: a value that can be copied, stored and restored.
struct SystemState {
  double t = 0.0;  // s
  int phase = 0;   // index of the operation's phase
  std::vector<BodyKinematics> body;
  std::vector<DriveState> drive;
  VectorX acceleration;               // 6 per body: dv_WC/dt, dw_B/dt
  VectorX lambda;                     // one per kept constraint row
  std::vector<double> element_state;  // of all elements, in order

  Instant instant() const { return {t, body, drive, phase}; }
};

/// X_WB of a body from the motion of its centre of gravity.
inline Pose pose_of(const BodyKinematics& k, const RigidBody& b) { return {k.R_WB, k.p_WC - k.R_WB * b.cog}; }

/// Scratch of one thread.
struct SystemWorkspace {
  explicit SystemWorkspace(int bodies) : forces(bodies), jacobian(bodies) {}
  std::vector<double> element_scratch;
  ForceSum forces;
  JacobianSum jacobian;
};

class MultibodySystem {
 public:
  std::vector<RigidBody> bodies;
  std::vector<Joint> joints;
  std::vector<std::unique_ptr<const ForceElement>> elements;
  double gravity = 9.80665;  // m/s2

  /// Lays out memory and sums the mass matrix; call when bodies, joints and elements are in place, and again after a
  /// change. Keeps every constraint row.
  void finish();

  int coordinates() const { return 6 * static_cast<int>(bodies.size()); }
  int constraints() const { return static_cast<int>(rows_.size()); }
  int element_state_size() const { return state_size_; }
  const MatrixX& mass(int phase = 0) const {
    const Mass* valid = &masses_.front();
    for (const Mass& mass : masses_)
      if (phase >= mass.from_phase) valid = &mass;
    return valid->M;
  }
  SystemWorkspace make_workspace() const;
  Memory memory(int element, SystemState& state, SystemWorkspace& work) const {
    return memory_in(element, state.element_state, work.element_scratch);
  }
  /// The element's parts of the states and the scratch of all elements.
  Memory memory_in(int element, std::vector<double>& states, std::vector<double>& scratch) const;
  /// Where the element's state begins among those of all elements.
  int state_offset(int element) const { return state_offset_[element]; }

  // Internal states of the elements, see ForceElement.
  void start_elements(SystemState& state, SystemWorkspace& work) const;
  void settle_elements(SystemState& state, SystemWorkspace& work) const;
  void begin_step(SystemState& state, double h, SystemWorkspace& work) const;
  void end_step(SystemState& state, double h, SystemWorkspace& work) const;

  /// Q - h(u): applied, weight and gyroscopic forces. `out` has 6 rows a body.
  void forces(SystemState& state, double h, SystemWorkspace& work, VectorX& out) const;
  /// Their derivatives, left in work.jacobian; with the stiffness of -C_q^T lambda.
  void jacobian(SystemState& state, double h, SystemWorkspace& work) const;

  // Constraints: the rows kept by select_independent_rows(), all of them before that.
  void constraint_values(const SystemState& state, VectorX& C) const;
  void constraint_jacobian(const SystemState& state, MatrixX& C_q) const;
  /// -(C_q u)_q u, and what prescribed motions add to it.
  void constraint_acceleration(const SystemState& state, VectorX& gamma) const;

  /// Drops rows that depend on the others at this state (closed loops of parallel axes have such rows); returns the
  /// names of the joints that lost rows. What the dropped rows would carry then shows as zero.
  std::vector<std::string> select_independent_rows(const SystemState& state);
  /// Name of the joint a kept row belongs to.
  const std::string& row_joint(int row) const { return joints[rows_[row].joint].name; }
  /// Largest value of a dropped row at this state: not small means that joints contradict each other. Returns the
  /// joint's name in `where`.
  double dropped_violation(const SystemState& state, std::string& where) const;
  /// Force (N, W) and moment (N m, W, about the joint point) that joint j exerts on its child.
  void joint_reaction(const SystemState& state, int joint, Vector3& force, Vector3& moment) const;

  /// Power that prescribed motions give to the bodies, W: that of the joints' reactions, lambda^T dC/dt.
  double prescribed_power(const SystemState& state) const;
  /// Kinetic energy of the bodies with their added mass, J.
  double kinetic_energy(const SystemState& state) const;
  /// Height energy of the weights, J, and what the elements store.
  double potential_energy(SystemState& state, SystemWorkspace& work) const;

 private:
  struct Row {
    int joint, row;
  };
  std::vector<Row> rows_, dropped_;
  struct Mass {
    int from_phase;
    MatrixX M;
  };
  std::vector<Mass> masses_;  // ascending; the first holds from the start
  std::vector<int> state_offset_, scratch_offset_;
  int state_size_ = 0, scratch_size_ = 0;
};

}  // namespace stillhook
