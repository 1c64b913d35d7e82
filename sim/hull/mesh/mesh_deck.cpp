#include "sim/hull/mesh/mesh_deck.h"

#include <algorithm>

namespace stillhook {
namespace {

constexpr double kSameHeight = 1e-4;  // of the mesh's size

double same_height(const MeshProperties& p) { return kSameHeight * (p.high - p.low).norm(); }

/// A point in the plane of the loop from which every one of its edges is seen at an angle, so that a fan from there has
/// no triangle without an area. Triangles that it turns over cancel what others count twice.
Vector3 middle_of(const std::vector<Vector3>& loop) {
  Vector3 mean = Vector3::Zero();
  double around = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    mean += loop[i] / static_cast<double>(loop.size());
    around += (loop[(i + 1) % loop.size()] - loop[i]).norm();
  }
  const auto sees_all = [&](const Vector3& p) {
    for (std::size_t i = 0; i < loop.size(); ++i)
      if ((loop[i] - p).cross(loop[(i + 1) % loop.size()] - p).norm() < 1e-9 * around * around) return false;
    return true;
  };
  for (const Vector3& corner : loop) {
    if (sees_all(mean)) break;
    mean += 0.137 * (corner - mean);
  }
  return mean;
}

void add_walls_and_deck(Mesh& mesh, const std::vector<int>& rim, double deck) {
  const int first = static_cast<int>(mesh.vertices.size()), count = static_cast<int>(rim.size());
  std::vector<Vector3> loop;
  for (const int v : rim) {
    Vector3 p = mesh.vertices[v];
    p.z() = deck;
    loop.push_back(p);
  }
  mesh.vertices.insert(mesh.vertices.end(), loop.begin(), loop.end());
  mesh.vertices.push_back(middle_of(loop));
  for (int i = 0; i < count; ++i) {
    const int next = (i + 1) % count;
    mesh.triangles.push_back({rim[i], rim[next], first + next});
    mesh.triangles.push_back({rim[i], first + next, first + i});
    mesh.triangles.push_back({first + i, first + next, first + count});
  }
}

}  // namespace

bool open_at_top_only(const Mesh& mesh, const EdgeMap& edges) {
  const MeshProperties p = properties_of(mesh);
  const double lowest = p.high.z() - same_height(p);
  return std::ranges::all_of(edges, [&](const auto& edge) {
    return edge.second.count != 1 || (mesh.vertices[static_cast<std::size_t>(edge.first >> 32)].z() >= lowest &&
                                      mesh.vertices[static_cast<std::size_t>(edge.first & 0xffffffffu)].z() >= lowest);
  });
}

Mesh decked_mesh(const Mesh& mesh, double height, bool at_water, const std::string& what) {
  if (!(height > 0.0)) throw MeshError(what + ": the deck must lie above the rim of the mesh");
  const MeshProperties p = properties_of(mesh);
  const double top = p.high.z(), lowest = top - same_height(p);
  Mesh result = mesh;
  std::erase_if(result.triangles, [&](const auto& t) {
    return at_water && std::ranges::all_of(t, [&](int v) { return mesh.vertices[v].z() >= lowest; });
  });
  const EdgeMap edges = edges_of(result);
  std::size_t open = 0, drawn = 0;
  for (const auto& [key, edge] : edges) open += edge.count == 1;
  if (open == 0)
    throw MeshError(what + ": the mesh is closed, it needs no mesh_deck_height_m (a lid of the water surface, which is "
                           "left out, lies at the top of the mesh and at z = 0 of the file)");
  if (!open_at_top_only(result, edges))
    throw MeshError(
        what + ": mesh_deck_height_m draws sides up from a rim at the top of the mesh, and of its " +
        std::to_string(open) +
        " open edges some lie below: panels whose corners do not meet those of their neighbours, or a hole");
  for (const std::vector<int>& rim : rims_of(result, edges)) {
    drawn += rim.size();
    add_walls_and_deck(result, rim, top + height);
  }
  if (drawn != open) throw MeshError(what + ": the open edges at the top of the mesh do not form rims");
  return result;
}

}  // namespace stillhook
