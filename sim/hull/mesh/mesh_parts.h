// Closed surfaces of one mesh that lie inside each other or overlap: their common volume would count as buoyancy twice.
#pragma once

#include <vector>

#include "sim/hull/mesh/mesh_edges.h"

namespace stillhook {

struct NestedParts {
  std::vector<int> part;   // of each triangle, as parts_of
  std::vector<int> inner;  // parts that lie wholly inside another one
  int overlapping = 0;     // pairs of parts of which each is partly inside the other
};

/// Of a closed mesh; which way the surfaces face does not matter. Two parts that touch do not overlap: what counts is a
/// point of one deeper than a hundred thousandth of the mesh's size inside the other.
NestedParts nested_parts(const Mesh& mesh, const EdgeMap& edges);

}  // namespace stillhook
