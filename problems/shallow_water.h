// What is to be known of a sea that feels the bottom, in sentences.
#pragma once

#include <string>
#include <vector>

#include "sim/specification.h"

namespace stillhook {

/// Of the active sea: that its waves are shorter than in deep water and by how much, what it means that hulls are
/// calculated as in deep water, and that waves are too high for linear theory in so little water (Ursell's number above
/// 26). Empty in deep water.
std::vector<std::string> shallow_water_gaps(const SeaSpec& sea);

}  // namespace stillhook
