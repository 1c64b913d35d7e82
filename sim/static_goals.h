// Goals in statics: how far drives have to go until coordinates of the lift in equilibrium have wanted values.
#pragma once

#include <string>
#include <vector>

#include "sim/multibody/equilibrium.h"
#include "sim/statics.h"

namespace stillhook {

/// Moves `state`, a stable equilibrium in calm water (state.t < 0), and its drives until every goal is met, by Newton's
/// method on the drives; with a single goal never out of the interval that is known to hold the answer. Throws
/// SpecificationError naming `entry` and the goal that is out of reach, with the nearest that was found.
void reach_goals(const Model& model, SystemState& state, const std::vector<StaticGoal>& goals,
                 const std::string& entry);

/// Throws the SpecificationError of a lift that has no stable equilibrium.
/// `state`: where the search for one ended.
[[noreturn]] void refuse_without_equilibrium(const MultibodySystem& system, const SystemState& state,
                                             const EquilibriumReport& report, const std::string& entry);

}  // namespace stillhook
