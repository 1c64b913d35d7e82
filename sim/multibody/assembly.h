// Which bodies hang together through joints.
#pragma once

#include <vector>

#include "sim/multibody/system.h"

namespace stillhook {

/// For each body, whether a chain of joints leads from it to `body` without passing the world; true for itself.
std::vector<bool> jointed_to(const MultibodySystem& system, int body);

}  // namespace stillhook
