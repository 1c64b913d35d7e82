// The usual reason why a load that should stand does not: it is not over the surface.
#pragma once

#include <string>

#include "sim/multibody/system.h"

namespace stillhook {

/// The contact nearest to holding what passed it by: points lower than its surface, but beside its edges. A clause that
/// begins with "; " and names contact, points and distance, for the end of a refusal; empty where there is none. A
/// contact counts that acts in the state's phase, and only within the surface's own larger side of its edges: the deck
/// that a load left long ago is no reason.
std::string missed_surface(const MultibodySystem& system, const SystemState& state);

}  // namespace stillhook
