// Static equilibrium: Q(q) - C_q^T lambda = 0, C(q) = 0 with everything at rest, by pseudo-transient Newton steps
//
//   [ s M - K   C_q^T ] [ xi     ]   [ Q  ]
//   [ C_q       0     ] [ lambda ] = [ -C ]
//
// s (1/s2) falls with the residual (switched evolution relaxation, Kelley & Keyes 1998), so that contacts and slack
// wires are passed safely and the end is Newton's method. A small s stays: coordinates without any stiffness (the
// heading of a body on one wire) rest where they are.
#pragma once

#include <string>

#include "sim/multibody/system.h"

namespace stillhook {

struct EquilibriumReport {
  bool converged = false;
  int iterations = 0;
  double residual = 0.0;   // largest out-of-balance force as a share of the largest body's weight
  std::string worst_body;  // where it is
  std::string motion;      // what goes on moving where no equilibrium is found, in words; may be empty
};

/// Adds a small motion (6 per body: m in W, rad in B) to the bodies' poses.
void move_bodies(SystemState& state, const VectorX& xi);

/// Scales a motion back to the largest that one step may make; returns the factor.
double limit_motion(VectorX& xi);

/// How far a system is out of balance, as a share of the largest body's weight; a moment counts as a force at the
/// body's radius of gyration.
class BalanceMeasure {
 public:
  explicit BalanceMeasure(const MultibodySystem& system);
  double out_of_balance(const VectorX& Q, const MatrixX& C_q, const VectorX& lambda, std::string& worst_body) const;

 private:
  const MultibodySystem& system_;
  double weight_ = 1e-3;  // N
  VectorX scale_;
};

/// Moves the bodies of `state` to equilibrium; velocities and accelerations become zero, lambda the reactions, the
/// elements' states steady (they are started first if the state has none). The elements see the time state.t (use t < 0
/// for calm water). `close`: the state, lambda included, is already nearly there; s is small from the start. The
/// equilibrium may be unstable: see relaxation.h.
EquilibriumReport solve_equilibrium(const MultibodySystem& system, SystemState& state, bool close = false,
                                    int max_iterations = 600);

/// True if at rest in this state both systems have the same weights, joints and forces, to the last bit, so that an
/// equilibrium of one is an equilibrium of the other. `state` is one of `b`, whose elements may go on after those of `a`.
bool same_statics(const MultibodySystem& a, const MultibodySystem& b, const SystemState& state);

/// Moves the bodies as little as possible so that C(q) = 0. Returns the largest remaining row, and its joint.
double assemble_joints(const MultibodySystem& system, SystemState& state, std::string& joint);

}  // namespace stillhook
