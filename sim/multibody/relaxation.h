// Equilibria that Newton's method alone does not find, or finds and should not: dynamic relaxation, the motion of the
// system in a fluid so thick that inertia does not count,
//
//   M xi' = Q - C_q^T lambda        C(q) = 0
//
// by implicit steps of length 1/s, s (1/s2) as in equilibrium.h. A step is kept only if the forces do positive work
// along it (trapezoidal rule), so that energy falls whatever s is: the motion ends where a slowly let go lift would
// come to rest, and no contact or slack wire is jumped over. (Day 1965.)
#pragma once

#include "sim/multibody/equilibrium.h"

namespace stillhook {

/// Lets the system move as above from `state` until it is all but at rest, then polishes as solve_equilibrium() does.
/// Where it does not come to rest, the report tells what goes on moving.
EquilibriumReport relax(const MultibodySystem& system, SystemState& state);

/// solve_equilibrium() with a stable end: an equilibrium that is unstable, or none, is replaced by the one that relax()
/// finds from where the state began. `converged` is true for stable equilibria alone.
EquilibriumReport settle_stably(const MultibodySystem& system, SystemState& state, bool close = false);

}  // namespace stillhook
