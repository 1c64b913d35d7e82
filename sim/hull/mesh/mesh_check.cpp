// Is a triangle mesh a hull? (check_mesh of mesh.h)
#include <algorithm>

#include "sim/hull/mesh/mesh_deck.h"
#include "sim/hull/mesh/mesh_edges.h"
#include "sim/hull/mesh/mesh_parts.h"

namespace stillhook {

namespace {

std::string count_of(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

void check_numbers(const Mesh& mesh, const std::string& what) {
  if (mesh.triangles.empty()) throw MeshError(what + ": the mesh has no triangles");
  std::size_t bad = 0;
  for (const Vector3& v : mesh.vertices) bad += !v.allFinite();
  if (bad > 0)
    throw MeshError(what + ": " +
                    count_of(bad, "vertex has a coordinate that is", "vertices have coordinates that are") +
                    " not a number");
  for (const auto& t : mesh.triangles)
    for (const int v : t)
      if (v < 0 || v >= static_cast<int>(mesh.vertices.size()))
        throw MeshError(what + ": a triangle refers to vertex " + std::to_string(v) + " of " +
                        std::to_string(mesh.vertices.size()));
  const MeshProperties p = properties_of(mesh);
  const double size = (p.high - p.low).norm();
  std::size_t flat = 0;
  for (const auto& t : mesh.triangles) flat += !(area_vector(mesh, t).norm() > 1e-14 * size * size);
  if (flat > 0) throw MeshError(what + ": " + count_of(flat, "triangle has", "triangles have") + " no area");
}

void check_closed(const Mesh& mesh, const EdgeMap& edges, const std::string& what) {
  std::size_t open = 0, crowded = 0;
  for (const auto& [key, n] : edges) {
    open += n.count == 1;
    crowded += n.count > 2;
  }
  if (crowded > 0)
    throw MeshError(what + ": the mesh is not a single surface, " + count_of(crowded, "edge is", "edges are") +
                    " shared by more than two triangles");
  if (open > 0)
    throw MeshError(what + ": the mesh is open, " + count_of(open, "edge belongs", "edges belong") +
                    " to one triangle only; a hull must be closed, deck included" +
                    (open_at_top_only(mesh, edges)
                         ? ". It is open at its top alone, as a wetted surface is (WAMIT's GDF): mesh_deck_height_m "
                           "draws its sides up to a deck"
                         : ""));
}

// Turns the triangles of each connected part the same way and compares the result with what was given.
class Orientation {
 public:
  Orientation(const Mesh& mesh, const EdgeMap& edges)
      : mesh_(mesh), edges_(edges), turned_(mesh.triangles.size(), -1), outward_(mesh.triangles.size(), 0) {}

  /// The triangles that face inwards; nothing when a part has only one side.
  std::vector<int> to_turn() {
    std::vector<int> inward;
    if (inward_triangles() < 0) return inward;
    for (std::size_t t = 0; t < turned_.size(); ++t)
      if (turned_[t] != outward_[t]) inward.push_back(static_cast<int>(t));
    return inward;
  }

  /// Number of triangles that face inwards; -1 when a part has only one side.
  long inward_triangles() {
    long inward = 0;
    for (int seed = 0; seed < static_cast<int>(turned_.size()); ++seed) {
      if (turned_[seed] >= 0) continue;
      const long n = inward_in_part(seed);
      if (n < 0) return -1;
      inward += n;
    }
    return inward;
  }

 private:
  long inward_in_part(int seed) {
    std::vector<int> part{seed};
    turned_[seed] = 0;
    for (std::size_t next = 0; next < part.size(); ++next) {
      const int t = part[next];
      for (int e = 0; e < 3; ++e) {
        const EdgeTriangles& n = edges_.at(edge_key(mesh_.triangles[t][e], mesh_.triangles[t][(e + 1) % 3]));
        const int other = n.triangle[0] == t ? n.triangle[1] : n.triangle[0];
        const int wanted = turned_[t] ^ (n.forward[0] == n.forward[1]);
        if (turned_[other] < 0) {
          turned_[other] = wanted;
          part.push_back(other);
        } else if (turned_[other] != wanted) {
          return -1;
        }
      }
    }
    double volume = 0.0;
    long turned = 0;
    const Vector3 about = mesh_.vertices[mesh_.triangles[seed][0]];
    for (const int t : part) {
      const auto& v = mesh_.triangles[t];
      const double six =
          (mesh_.vertices[v[0]] - about).dot((mesh_.vertices[v[1]] - about).cross(mesh_.vertices[v[2]] - about));
      volume += turned_[t] ? -six : six;
      turned += turned_[t];
    }
    // Those that stand as in the orientation of positive volume face outwards.
    for (const int t : part) outward_[t] = volume > 0.0 ? 0 : 1;
    return volume > 0.0 ? turned : static_cast<long>(part.size()) - turned;
  }

  const Mesh& mesh_;
  const EdgeMap& edges_;
  std::vector<int> turned_;   // 0 as given, 1 the other way round, -1 not visited
  std::vector<int> outward_;  // the value of turned_ that faces outwards in the triangle's part
};

/// The mesh without the parts that lie inside others.
Mesh without_inner_parts(const Mesh& mesh, const NestedParts& nested) {
  Mesh result;
  std::vector<int> renumbered(mesh.vertices.size(), -1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (std::ranges::find(nested.inner, nested.part[t]) != nested.inner.end()) continue;
    std::array<int, 3> corners = mesh.triangles[t];
    for (int& v : corners) {
      if (renumbered[v] < 0) {
        renumbered[v] = static_cast<int>(result.vertices.size());
        result.vertices.push_back(mesh.vertices[v]);
      }
      v = renumbered[v];
    }
    result.triangles.push_back(corners);
  }
  return result;
}

void check_parts(const Mesh& mesh, const EdgeMap& edges, const std::string& what) {
  const NestedParts nested = nested_parts(mesh, edges);
  if (nested.overlapping > 0)
    throw MeshError(
        what + ": " +
        count_of(nested.overlapping, "pair of closed surfaces overlaps", "pairs of closed surfaces overlap") +
        ", their common volume would count as buoyancy twice; unite the parts of the hull into one surface");
  if (!nested.inner.empty())
    throw MeshError(what + ": " + count_of(nested.inner.size(), "closed surface lies", "closed surfaces lie") +
                    " inside another (a tank, or the inner side of plating) and would count as buoyancy twice; take it "
                    "out of the file, or leave it out with mesh_mend = true");
}

}  // namespace

Mesh mended_mesh(const Mesh& mesh, std::string& done) {
  Mesh result = mesh;
  const MeshProperties p = properties_of(mesh);
  const double size = (p.high - p.low).norm();
  int holes = 0;
  for (const std::vector<int>& rim : rims_of(mesh, edges_of(mesh))) {
    double around = 0.0;
    Vector3 middle = Vector3::Zero();
    for (std::size_t i = 0; i < rim.size(); ++i) {
      around += (mesh.vertices[rim[i]] - mesh.vertices[rim[(i + 1) % rim.size()]]).norm();
      middle += mesh.vertices[rim[i]] / static_cast<double>(rim.size());
    }
    if (rim.size() < 3 || around > kSmallHole * size) continue;
    ++holes;
    if (rim.size() == 3) {
      result.triangles.push_back({rim[0], rim[1], rim[2]});
      continue;
    }
    result.vertices.push_back(middle);
    for (std::size_t i = 0; i < rim.size(); ++i)
      result.triangles.push_back({rim[i], rim[(i + 1) % rim.size()], static_cast<int>(result.vertices.size()) - 1});
  }
  std::vector<int> turn;
  std::size_t left_out = 0;
  if (const EdgeMap edges = edges_of(result); is_closed(edges)) {
    // First what lies inside goes: turned outwards it would count as buoyancy a second time.
    const NestedParts nested = nested_parts(result, edges);
    left_out = nested.inner.size();
    if (left_out > 0) {
      result = without_inner_parts(result, nested);
      turn = Orientation(result, edges_of(result)).to_turn();
    } else {
      turn = Orientation(result, edges).to_turn();
    }
  }
  for (const int t : turn) std::swap(result.triangles[t][1], result.triangles[t][2]);
  done.clear();
  if (holes > 0) done = count_of(holes, "hole closed", "holes closed");
  if (left_out > 0)
    done += (done.empty() ? "" : ", ") +
            count_of(left_out, "closed surface inside another left out", "closed surfaces inside others left out");
  if (!turn.empty())
    done += (done.empty() ? "" : ", ") + count_of(turn.size(), "triangle turned outwards", "triangles turned outwards");
  return result;
}

void check_mesh(const Mesh& mesh, const std::string& what) {
  check_numbers(mesh, what);
  const EdgeMap edges = edges_of(mesh);
  check_closed(mesh, edges, what);
  const long inward = Orientation(mesh, edges).inward_triangles();
  const long all = static_cast<long>(mesh.triangles.size());
  if (inward < 0) throw MeshError(what + ": the surface has only one side, no choice of normals is consistent");
  check_parts(mesh, edges, what);
  if (inward == all)
    throw MeshError(what + ": the mesh is inverted, all " + std::to_string(all) +
                    " triangles face inwards; mesh_mend = true turns them");
  if (inward > 0)
    throw MeshError(what + ": the mesh is inverted in parts, " + std::to_string(inward) + " of " + std::to_string(all) +
                    " triangles face inwards; mesh_mend = true turns them");
}

}  // namespace stillhook
