// Panels that meet without sharing their corners, and hulls of which a file has one side.
#pragma once

#include <string>

#include "sim/hull/mesh/mesh.h"

namespace stillhook {

/// How far a corner may lie off a neighbour's edge and still be on it, of the mesh's size: coordinates are written with
/// six digits.
inline constexpr double kSameSeam = 1e-5;

/// The mesh with every open edge divided where the corner of another open edge lies on it (within `tolerance`, m), and
/// with triangles of no area left out, which fill such edges. Panel codes need no common corners: a row of small panels
/// along a large one is one surface all the same. What is closed stays as it is. `moved` (if given) becomes the largest
/// distance between a corner and the edge it divides, m.
Mesh joined_seams(const Mesh& mesh, double tolerance, double* moved = nullptr);

/// All vertices on one side of the plane y = 0, some of them in it.
bool is_one_sided(const Mesh& mesh);

/// A mesh of one side with its mirror image in the plane y = 0; triangles in that plane are left out, vertices closer
/// to it than a millionth of the mesh's size moved into it. Throws MeshError, opened by `what`, unless is_one_sided.
Mesh mirrored_mesh(const Mesh& mesh, const std::string& what);

}  // namespace stillhook
