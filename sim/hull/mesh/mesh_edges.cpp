#include "sim/hull/mesh/mesh_edges.h"

#include <algorithm>

namespace stillhook {

std::uint64_t edge_key(int a, int b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | static_cast<std::uint32_t>(std::max(a, b));
}

EdgeMap edges_of(const Mesh& mesh) {
  EdgeMap edges;
  edges.reserve(mesh.triangles.size() * 3 / 2 + 1);
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    for (int e = 0; e < 3; ++e) {
      const int a = mesh.triangles[t][e], b = mesh.triangles[t][(e + 1) % 3];
      EdgeTriangles& n = edges[edge_key(a, b)];
      if (n.count < 2) {
        n.triangle[n.count] = t;
        n.forward[n.count] = a < b;
      }
      ++n.count;
    }
  return edges;
}

bool is_closed(const EdgeMap& edges) {
  return std::ranges::all_of(edges, [](const auto& edge) { return edge.second.count == 2; });
}

std::vector<std::vector<int>> rims_of(const Mesh& mesh, const EdgeMap& edges) {
  std::unordered_map<int, int> next;
  for (const auto& t : mesh.triangles)
    for (int e = 0; e < 3; ++e) {
      const int a = t[e], b = t[(e + 1) % 3];
      if (edges.at(edge_key(a, b)).count == 1) next[b] = a;
    }
  std::vector<std::vector<int>> rims;
  while (!next.empty()) {
    std::vector<int> rim{next.begin()->first};
    for (auto it = next.find(rim[0]); it != next.end(); it = next.find(rim.back())) {
      const int to = it->second;
      next.erase(it);
      if (to == rim[0]) {
        rims.push_back(rim);
        break;
      }
      rim.push_back(to);
    }
  }
  return rims;
}

std::vector<int> parts_of(const Mesh& mesh, const EdgeMap& edges) {
  std::vector<int> part(mesh.triangles.size(), -1);
  int count = 0;
  for (int seed = 0; seed < static_cast<int>(part.size()); ++seed) {
    if (part[seed] >= 0) continue;
    std::vector<int> members{seed};
    part[seed] = count;
    for (std::size_t next = 0; next < members.size(); ++next)
      for (int e = 0; e < 3; ++e) {
        const auto& t = mesh.triangles[members[next]];
        for (const int other : edges.at(edge_key(t[e], t[(e + 1) % 3])).triangle)
          if (other >= 0 && part[other] < 0) {
            part[other] = count;
            members.push_back(other);
          }
      }
    ++count;
  }
  return part;
}

}  // namespace stillhook
