// Is an equilibrium stable? Small motions about rest obey M x'' = -K x on the motions x = Z y that the joints allow
// (C_q Z = 0); they stay small if no eigenvalue of (Z^T M Z)^-1 (Z^T K Z) is negative, with K = -dQ/dxi of the forces
// and of the joints' reactions. (Shabana 2005; the energy criterion where the forces have an energy.) The eigenvalues
// are those of the matrix as it is, not of its symmetric part: sliding friction makes it unsymmetric.
#pragma once

#include <string>

#include "sim/multibody/system.h"

namespace stillhook {

struct WeakestMotion {
  double stiffness = 0.0;  // 1/s2: the least eigenvalue, 0 when the equilibrium is found stable without it
  VectorX motion;          // 6 per body (m in W, rad in B), its largest entry 1; empty when stable
  bool stable() const { return motion.size() == 0; }
};

/// What the system does least to resist at this equilibrium (lambda included). A motion that nothing resists (the
/// heading of a load on one wire) counts as stable.
WeakestMotion weakest_motion(const MultibodySystem& system, SystemState& state);

/// Name of the body that moves most.
std::string mover(const MultibodySystem& system, const VectorX& xi);

/// A motion in words: the body that moves most and its direction, as in "'load' in z" or "'crane' in roll".
std::string describe_motion(const MultibodySystem& system, const VectorX& xi);

}  // namespace stillhook
