// Closing a mesh of the wetted surface alone, as codes of hydrodynamics have it.
#pragma once

#include <string>

#include "sim/hull/mesh/mesh_edges.h"

namespace stillhook {

/// Every open edge lies at the top of the mesh, within a ten thousandth of its size.
bool open_at_top_only(const Mesh& mesh, const EdgeMap& edges);

/// The mesh with its sides drawn straight up along B's z axis from the rims at its top to a flat deck `height` (m)
/// above. Where `at_water`, the top lies in the still water: triangles in its plane are left out first, the lid by which
/// some codes keep irregular frequencies away. Elsewhere they are the hull's own deck. Throws MeshError, opened by
/// `what`, when the mesh is not open at its top alone.
Mesh decked_mesh(const Mesh& mesh, double height, bool at_water, const std::string& what);

}  // namespace stillhook
