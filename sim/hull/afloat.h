// How a hull of a lift floats: what its coefficients are computed for.
#pragma once

#include "sim/hull/coefficients/coefficient_source.h"
#include "sim/multibody/system.h"

namespace stillhook {

/// m, height of the still water plane above Bo where it meets the vertical of B through the middle of the hull; Bo at
/// p_WBo with axes R_WB.
double waterline_through_middle(const Mesh& mesh, const Vector3& p_WBo, const Matrix3& R_WB);

/// The hull of body number `body` (mesh in B, may be empty) in `state`, the lift's static equilibrium. A case whose run
/// starts from given poses (solver.static_start = false) may start away from where its hulls float, as a decay test
/// does: then the hull lies, upright, where it displaces the mass of everything jointed to it.
HullAfloat hull_afloat(const Specification& spec, const MultibodySystem& system, const SystemState& state,
                       std::size_t body, const Mesh& mesh);

}  // namespace stillhook
