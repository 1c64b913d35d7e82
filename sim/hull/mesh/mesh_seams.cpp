#include "sim/hull/mesh/mesh_seams.h"

#include <algorithm>
#include <cmath>

#include "sim/hull/mesh/mesh_edges.h"
#include "sim/number_text.h"

namespace stillhook {
namespace {

constexpr double kInPlane = 1e-6;               // of the mesh's size
constexpr double kNoArea = 1e-14;               // of its square, as check_mesh has it
constexpr std::size_t kMostOpenEdges = 30'000;  // more are no seams, and every one is compared with all others

double size_of(const Mesh& mesh) {
  const MeshProperties p = properties_of(mesh);
  return (p.high - p.low).norm();
}

/// An open edge of triangle `triangle`, from its corner `side` to the next.
struct OpenEdge {
  int triangle, side;
};

std::vector<OpenEdge> open_edges(const Mesh& mesh, const EdgeMap& edges) {
  std::vector<OpenEdge> open;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    for (int e = 0; e < 3; ++e)
      if (edges.at(edge_key(mesh.triangles[t][e], mesh.triangles[t][(e + 1) % 3])).count == 1) open.push_back({t, e});
  return open;
}

/// Corners of open edges, ascending in x, to find those beside an edge quickly.
class Corners {
 public:
  Corners(const Mesh& mesh, const std::vector<OpenEdge>& open) : mesh_(mesh) {
    for (const OpenEdge& edge : open)
      for (const int k : {0, 1}) corners_.push_back(mesh.triangles[edge.triangle][(edge.side + k) % 3]);
    std::ranges::sort(corners_);
    corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
    std::ranges::stable_sort(corners_, {}, [&](int v) { return mesh.vertices[v].x(); });
  }

  /// Those on the edge from a to b, but not at its ends, in their order from a. `moved` grows to the largest distance.
  std::vector<int> on_edge(int a, int b, double tolerance, double& moved) const {
    const Vector3 &from = mesh_.vertices[a], &to = mesh_.vertices[b];
    const double length = (to - from).norm();
    const Vector3 along = (to - from) / length;
    // At the very ends a corner would make a sliver, and no edge that a neighbour has.
    const double end = std::min(2.0 * tolerance, 0.01 * length);
    std::vector<std::pair<double, int>> found;
    auto v = std::ranges::lower_bound(corners_, std::min(from.x(), to.x()) - tolerance, {},
                                      [&](int n) { return mesh_.vertices[n].x(); });
    for (; v != corners_.end() && mesh_.vertices[*v].x() <= std::max(from.x(), to.x()) + tolerance; ++v) {
      const double place = (mesh_.vertices[*v] - from).dot(along);
      if (*v == a || *v == b || place <= end || place >= length - end) continue;
      const double distance = (mesh_.vertices[*v] - from - place * along).norm();
      if (distance > tolerance) continue;
      moved = std::max(moved, distance);
      found.push_back({place, *v});
    }
    std::ranges::sort(found);
    std::vector<int> result;
    for (const auto& [place, n] : found) result.push_back(n);
    return result;
  }

 private:
  const Mesh& mesh_;
  std::vector<int> corners_;
};

bool is_flat(const Mesh& mesh, const std::array<int, 3>& t, double size) {
  return !(area_vector(mesh, t).norm() > kNoArea * size * size);
}

/// One edge of each triangle divided. False when there is none to divide.
bool divide(Mesh& mesh, double tolerance, double& moved) {
  const std::vector<OpenEdge> open = open_edges(mesh, edges_of(mesh));
  if (open.size() > kMostOpenEdges) return false;
  const Corners corners(mesh, open);
  bool divided = false;
  int last = -1;
  for (const OpenEdge& edge : open) {
    if (edge.triangle == last) continue;  // its other edges wait for the next round
    const std::array<int, 3> t = mesh.triangles[edge.triangle];
    const int a = t[edge.side], b = t[(edge.side + 1) % 3], c = t[(edge.side + 2) % 3];
    std::vector<int> along = corners.on_edge(a, b, tolerance, moved);
    std::erase(along, c);
    if (along.empty()) continue;
    along.push_back(b);
    mesh.triangles[edge.triangle] = {a, along[0], c};
    for (std::size_t n = 0; n + 1 < along.size(); ++n) mesh.triangles.push_back({along[n], along[n + 1], c});
    last = edge.triangle;
    divided = true;
  }
  return divided;
}

}  // namespace

Mesh joined_seams(const Mesh& mesh, double tolerance, double* moved) {
  Mesh result = mesh;
  const double size = size_of(mesh);
  std::erase_if(result.triangles, [&](const auto& t) { return is_flat(mesh, t, size); });
  double farthest = 0.0;
  // A round divides an edge of each triangle at all that lies on it, so that few are needed; the limit keeps what can
  // never close from going on.
  for (int round = 0; round < 20 && result.triangles.size() < kMostTriangles; ++round)
    if (!divide(result, tolerance, farthest)) break;
  if (moved) *moved = farthest;
  return result;
}

bool is_one_sided(const Mesh& mesh) {
  const MeshProperties p = properties_of(mesh);
  const double plane = kInPlane * (p.high - p.low).norm();
  return (std::abs(p.low.y()) <= plane && p.high.y() > plane) || (std::abs(p.high.y()) <= plane && p.low.y() < -plane);
}

Mesh mirrored_mesh(const Mesh& mesh, const std::string& what) {
  const MeshProperties p = properties_of(mesh);
  if (!is_one_sided(mesh))
    throw MeshError(what +
                    ": mesh_mirror is for a file that has one side of the hull, up to the plane y = 0; this one " +
                    "reaches from y = " + number_text(p.low.y()) + " to " + number_text(p.high.y()));
  const double plane = kInPlane * size_of(mesh);
  Mesh result = mesh;
  for (Vector3& v : result.vertices)
    if (std::abs(v.y()) <= plane) v.y() = 0.0;
  std::erase_if(result.triangles, [&](const auto& t) {
    return std::ranges::all_of(t, [&](int v) { return result.vertices[v].y() == 0.0; });
  });
  const int count = static_cast<int>(result.vertices.size());
  const std::size_t triangles = result.triangles.size();
  for (int v = 0; v < count; ++v)
    result.vertices.emplace_back(result.vertices[v].x(), -result.vertices[v].y(), result.vertices[v].z());
  for (std::size_t n = 0; n < triangles; ++n) {
    const std::array<int, 3> t = result.triangles[n];
    result.triangles.push_back({t[0] + count, t[2] + count, t[1] + count});
  }
  return result;
}

}  // namespace stillhook
