// Where a hull has its deck.
#pragma once

#include <vector>

#include "sim/specification.h"

namespace stillhook {

/// Corners of the deck of a hull, m, in B: of a box those of its top; of a mesh those of the triangles in the upper
/// half of its height that face up within 30 deg, so that a pontoon or a bulb under water is none. Empty where there is
/// no hull or its file is gone. The mesh of a file is read once.
std::vector<Vector3> deck_corners(const HullSpec& hull);

}  // namespace stillhook
