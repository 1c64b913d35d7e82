// Equilibria along a way of the drives: a lift whose winches turn slowly goes from one stable equilibrium to the next.
// Each stretch of the way is predicted along the tangent (K dq = -dQ/ds ds with the joints closed), corrected by
// Newton's method and kept if the lift came out stable and near where it was predicted; else the stretch is shortened
// (Allgower & Georg 1990). Where the way has an end, at a fall or a snap, the lift moves on as in relaxation.h.
#pragma once

#include <vector>

#include "sim/multibody/relaxation.h"

namespace stillhook {

/// Brings the drives of `state` to `to` (rates aside) and the bodies with them, stable equilibrium by stable
/// equilibrium. `state` need not be one itself. The drives of a state without an equilibrium have come as far as the
/// state says.
EquilibriumReport follow_drives(const MultibodySystem& system, SystemState& state, const std::vector<DriveState>& to);

}  // namespace stillhook
