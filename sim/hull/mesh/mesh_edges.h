// The edges of a triangle mesh and what hangs together by them.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "sim/hull/mesh/mesh.h"

namespace stillhook {

/// The triangles at an edge; of more than two, the first two.
struct EdgeTriangles {
  int triangle[2] = {-1, -1};
  bool forward[2] = {false, false};  // runs from the smaller vertex number to the larger
  int count = 0;
};

using EdgeMap = std::unordered_map<std::uint64_t, EdgeTriangles>;

std::uint64_t edge_key(int a, int b);
EdgeMap edges_of(const Mesh& mesh);
/// Every edge has two triangles.
bool is_closed(const EdgeMap& edges);

/// Rims of holes: closed loops of edges that belong to one triangle only, run against that triangle's own direction.
std::vector<std::vector<int>> rims_of(const Mesh& mesh, const EdgeMap& edges);

/// For each triangle the part that it belongs to, from 0: parts share no edge.
std::vector<int> parts_of(const Mesh& mesh, const EdgeMap& edges);

}  // namespace stillhook
