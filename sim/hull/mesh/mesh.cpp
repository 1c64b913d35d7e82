#include "sim/hull/mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>

#include "sim/number_text.h"

namespace stillhook {

namespace {


// Builds the six faces of a box from the points of a lattice, numbering each surface point once.
class BoxSurface {
 public:
  BoxSurface(const Vector3& low, const Vector3& size, const std::array<int, 3>& panels)
      : low_(low), size_(size), panels_(panels) {}

  Mesh build() {
    for (int axis = 0; axis < 3; ++axis) {
      add_face(axis, 0);
      add_face(axis, panels_[axis]);
    }
    return std::move(mesh_);
  }

 private:
  int vertex(const std::array<int, 3>& at) {
    const auto [place, is_new] = index_.try_emplace(at, static_cast<int>(mesh_.vertices.size()));
    if (is_new) {
      Vector3 p = low_;
      for (int i = 0; i < 3; ++i) p[i] += size_[i] * at[i] / panels_[i];
      mesh_.vertices.push_back(p);
    }
    return place->second;
  }

  // The face normal to `axis` at lattice plane `level`: outward is -axis at level 0, +axis at the other end.
  void add_face(int axis, int level) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int i = 0; i < panels_[u]; ++i)
      for (int j = 0; j < panels_[v]; ++j) {
        std::array<int, 4> corner;
        for (int c = 0; c < 4; ++c) {
          std::array<int, 3> at{};
          at[axis] = level;
          at[u] = i + (c == 1 || c == 2);
          at[v] = j + (c >= 2);
          corner[c] = vertex(at);
        }
        if (level == 0) std::swap(corner[1], corner[3]);
        const int first = (i + j) % 2;  // which diagonal; mirrored because the numbers of panels are even
        const auto at = [&](int c) { return corner[(c + first) % 4]; };
        mesh_.triangles.push_back({at(0), at(1), at(2)});
        mesh_.triangles.push_back({at(0), at(2), at(3)});
      }
  }

  Vector3 low_, size_;
  std::array<int, 3> panels_;
  Mesh mesh_;
  std::map<std::array<int, 3>, int> index_;
};

// One pass of edge halving. Cuts are shared through `middle`, so neighbours agree.
class EdgeHalving {
 public:
  EdgeHalving(const Mesh& from, double longest) : longest_(longest) { mesh_.vertices = from.vertices; }

  Mesh run(const Mesh& from) {
    for (const auto& t : from.triangles) add(t);
    return std::move(mesh_);
  }

 private:
  int middle(int a, int b) {
    const Vector3 pa = mesh_.vertices[a], pb = mesh_.vertices[b];
    if ((pa - pb).norm() <= longest_) return -1;
    const auto key = (static_cast<std::uint64_t>(std::min(a, b)) << 32) | static_cast<std::uint32_t>(std::max(a, b));
    const auto [place, is_new] = middles_.try_emplace(key, static_cast<int>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(0.5 * (pa + pb));
    return place->second;
  }

  void add(const std::array<int, 3>& t) {
    std::array<int, 3> m;
    int cuts = 0, cut = 0, whole = 0;
    for (int e = 0; e < 3; ++e) {
      m[e] = middle(t[e], t[(e + 1) % 3]);
      if (m[e] >= 0)
        ++cuts, cut = e;
      else
        whole = e;
    }
    auto& out = mesh_.triangles;
    if (cuts == 0) {
      out.push_back(t);
    } else if (cuts == 1) {
      const int a = t[cut], b = t[(cut + 1) % 3], c = t[(cut + 2) % 3];
      out.insert(out.end(), {{a, m[cut], c}, {m[cut], b, c}});
    } else if (cuts == 2) {
      // Edge `whole` runs from a to b; c is opposite, with middles on b-c and c-a. The shorter diagonal is used.
      const int a = t[whole], b = t[(whole + 1) % 3], c = t[(whole + 2) % 3];
      const int bc = m[(whole + 1) % 3], ca = m[(whole + 2) % 3];
      const auto& v = mesh_.vertices;
      out.push_back({ca, bc, c});
      if ((v[a] - v[bc]).squaredNorm() <= (v[b] - v[ca]).squaredNorm())
        out.insert(out.end(), {{a, b, bc}, {a, bc, ca}});
      else
        out.insert(out.end(), {{a, b, ca}, {b, bc, ca}});
    } else {
      out.insert(out.end(), {{t[0], m[0], m[2]}, {m[0], t[1], m[1]}, {m[2], m[1], t[2]}, {m[0], m[1], m[2]}});
    }
  }

  double longest_;
  Mesh mesh_;
  std::unordered_map<std::uint64_t, int> middles_;
};

}  // namespace

Vector3 area_vector(const Mesh& mesh, const std::array<int, 3>& t) {
  const Vector3& a = mesh.vertices[t[0]];
  return 0.5 * (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
}

MeshProperties properties_of(const Mesh& mesh) {
  MeshProperties p;
  if (mesh.vertices.empty()) return p;
  p.low = p.high = mesh.vertices.front();
  for (const Vector3& v : mesh.vertices) p.low = p.low.cwiseMin(v), p.high = p.high.cwiseMax(v);
  // About the middle of the box, so that a hull far from the origin loses no digits.
  const Vector3 middle = 0.5 * (p.low + p.high);
  Vector3 moment = Vector3::Zero();
  for (const auto& t : mesh.triangles) {
    const Vector3 a = mesh.vertices[t[0]] - middle, b = mesh.vertices[t[1]] - middle, c = mesh.vertices[t[2]] - middle;
    const double tetrahedron = a.dot(b.cross(c)) / 6.0;
    p.area += area_vector(mesh, t).norm();
    p.volume += tetrahedron;
    moment += tetrahedron * 0.25 * (a + b + c);
    p.longest_edge = std::max({p.longest_edge, (a - b).norm(), (b - c).norm(), (c - a).norm()});
  }
  p.centroid = middle;
  if (p.volume != 0.0) p.centroid += moment / p.volume;
  return p;
}

Mesh box_mesh(const Vector3& size, const Vector3& centre, double panel_length) {
  if (!(size.minCoeff() > 0.0) || !size.allFinite() || !centre.allFinite())
    throw MeshError("a box needs three sizes > 0 m and a finite centre");
  if (!(panel_length > 0.0)) throw MeshError("the panel length must be > 0 m");
  std::array<int, 3> panels;
  double most = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double pairs = std::ceil(size[i] / (2.0 * panel_length) * (1.0 - 1e-12));
    most = std::max(most, pairs);
    panels[i] = most < 1e4 ? 2 * static_cast<int>(pairs) : 0;
  }
  const auto on_face = [&](int a, int b) { return 4.0 * panels[a] * panels[b]; };
  if (most >= 1e4 || on_face(0, 1) + on_face(1, 2) + on_face(2, 0) > static_cast<double>(kMostTriangles))
    throw MeshError("a panel length of " + number_text(panel_length) +
                    " m divides the box into more than a million triangles");
  return BoxSurface(centre - 0.5 * size, size, panels).build();
}

double automatic_panel_length(double area) { return std::max(std::sqrt(area / 350.0), 2.5); }

Mesh refined_mesh(const Mesh& mesh, double longest_edge) {
  if (!(longest_edge > 0.0)) throw MeshError("the longest edge of a refined mesh must be > 0 m");
  Mesh now = mesh;
  while (true) {
    Mesh next = EdgeHalving(now, longest_edge).run(now);
    if (next.triangles.size() == now.triangles.size()) return now;
    if (next.triangles.size() > kMostTriangles)
      throw MeshError("panels of " + number_text(longest_edge) +
                      " m divide the hull into more than a million triangles");
    now = std::move(next);
  }
}

Mesh welded_mesh(const Mesh& mesh, double tolerance) {
  // Cells of twice the tolerance: a vertex within the tolerance lies in the cell of one of the 8 shifted points.
  using Cell = std::array<std::int64_t, 3>;
  const double cell = std::max(2.0 * tolerance, 1e-300);
  Vector3 low = Vector3::Zero();
  if (!mesh.vertices.empty()) low = properties_of(mesh).low;
  const auto cell_of = [&](const Vector3& p) {
    Cell c;
    for (int i = 0; i < 3; ++i) c[i] = static_cast<std::int64_t>(std::floor(std::min((p[i] - low[i]) / cell, 9e18)));
    return c;
  };
  std::map<Cell, std::vector<int>> cells;
  Mesh out;
  std::vector<int> renumbered(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vector3& p = mesh.vertices[v];
    int found = -1;
    for (int corner = 0; corner < 8 && found < 0; ++corner) {
      const Vector3 shift(corner & 1 ? tolerance : -tolerance, corner & 2 ? tolerance : -tolerance,
                          corner & 4 ? tolerance : -tolerance);
      const auto near = cells.find(cell_of(p + shift));
      if (near == cells.end()) continue;
      for (const int candidate : near->second)
        if ((out.vertices[candidate] - p).norm() <= tolerance) found = candidate;
    }
    if (found < 0) {
      found = static_cast<int>(out.vertices.size());
      out.vertices.push_back(p);
      cells[cell_of(p)].push_back(found);
    }
    renumbered[v] = found;
  }
  for (const auto& t : mesh.triangles) {
    const std::array<int, 3> n{renumbered[t[0]], renumbered[t[1]], renumbered[t[2]]};
    if (n[0] != n[1] && n[1] != n[2] && n[2] != n[0]) out.triangles.push_back(n);
  }
  return out;
}

}  // namespace stillhook
