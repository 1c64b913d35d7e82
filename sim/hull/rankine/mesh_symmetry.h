// The planes about which a hull given as a mesh is symmetric.
#pragma once

#include "sim/hull/mesh/mesh.h"
#include "sim/hull/rankine/hull_panels.h"

namespace stillhook::rankine {

/// The planes x = 0 and y = 0 about which the mesh's surface is symmetric, its middle in the origin and the still water at
/// z = waterline (m). The triangles need not be each other's mirror images: two triangulations of one hull differ by the
/// diagonals of their quadrilaterals, and by what of them a refinement divides. A surface counts as symmetric when the
/// mirror images of its vertices lie on it up to kSurfaceRms of the shorter side in the root mean square and kSurfaceMost
/// at most, and the half below the water has half of the displaced volume up to kHalfVolume; the half that is kept then
/// stands for both.
Symmetry surface_symmetry(const Mesh& hull, double waterline);

inline constexpr double kSurfaceRms = 0.003, kSurfaceMost = 0.025, kHalfVolume = 0.002;  // 1

}  // namespace stillhook::rankine
