// What the model leaves out that matters in this lift, told before anybody uses the numbers.
#pragma once

#include <string>
#include <vector>

#include "sim/operation.h"

namespace stillhook {

/// One sentence each:
///   waves that feel the bottom       water shallower than half the length of the active sea's waves: hulls are
///                                    calculated as in deep water (shallow_water.h)
///   a load through the surface       no slamming, no drag on the velocity of the water, added mass and damping that do
///                                    not change with immersion
///   a vessel that nothing holds      a horizontal period of a floating vessel of the operation beyond 200 s
std::vector<std::string> model_gaps(const Model& model, const Operation& operation);

}  // namespace stillhook
