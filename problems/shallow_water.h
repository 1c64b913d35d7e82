// What is to be known of a sea that feels the bottom, in sentences.
#pragma once

#include <string>
#include <vector>

#include "sim/model.h"

namespace stillhook {

/// Of the active sea: that its waves are shorter than in deep water and by how much, what it means for hulls whose
/// coefficients are those of deep water, and that waves are too high for linear theory in so little water (Ursell's
/// number above 26). Empty in deep water.
std::vector<std::string> shallow_water_gaps(const Model& model);

}  // namespace stillhook
