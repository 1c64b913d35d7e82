// The period with which a load swings on its hoist wires.
//
// It is that of the natural mode (sim/modes.h) in which the load's displacement along the move has the largest share:
// of the whole pendulum with its block, slings and centre of gravity, and of falls that carry the load side by side,
// along which it swings by the length of the falls alone. Where the load stands, or nothing is said to be the load, the
// period is that of a point on the falls.
#pragma once

#include "sim/model.h"

namespace stillhook {

/// Mean of the periods (s) before and after a move, in those of the two equilibria in which the load hangs; 0 without a
/// hoist wire.
double swing_period(const Model& model, const SystemState& before, const SystemState& after);

}  // namespace stillhook
