// The start pose of a lift against the pose that its case gives: which wires hold what they are fastened to, and what
// has moved and why.
#pragma once

#include <string>
#include <vector>

#include "sim/model.h"

namespace stillhook {

/// Of the wires in `candidates`, which `loose` was found without: those that hold something, since their ends are
/// further apart there than at the pose `given`. A load that stands in both poses, and has only sunk or risen with what
/// floats under it, is not held. Wires under which something has fallen come first and alone: what hangs on it may hang
/// again when they hold.
std::vector<std::size_t> wires_that_hold(const Specification& spec, const MultibodySystem& system,
                                         const std::vector<std::size_t>& candidates, const SystemState& given,
                                         const SystemState& loose);

/// Throws SpecificationError("bodies.<name>.position") for a hull, or the centre of gravity of a body without one, that
/// lies more than 0.5 m under the sea bed (SeaSpec::depth, 0 = no bed); less is what settles into it.
void refuse_below_bed(const Specification& spec, const SystemState& start);

/// A sentence for each body whose start pose is further than 0.5 m or 5 deg from the given one: how far, and why.
std::vector<std::string> start_pose_notes(const Model& model, const SystemState& given, const SystemState& start);

}  // namespace stillhook
