#include "sim/hull/mesh/mesh_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stillhook {
namespace {

constexpr double kTouching = 1e-5;  // of the mesh's size

/// Distance of p from a triangle: to its plane where p lies above it, else to the nearest edge.
double distance_to_triangle(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 n = (b - a).cross(c - a);
  bool above = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
    above = above && n.cross(to - from).dot(p - from) >= 0.0;
    const double t = std::clamp((p - from).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (p - from - t * (to - from)).norm());
  }
  return above ? std::abs(n.dot(p - a)) / n.norm() : nearest;
}

/// One closed surface, its triangles sorted into columns of a grid over x and y.
class PartSurface {
 public:
  PartSurface(const Mesh& mesh, std::vector<int> triangles, double touching)
      : mesh_(mesh), triangles_(std::move(triangles)), touching_(touching) {
    low_ = high_ = corner(triangles_[0], 0);
    for (const int t : triangles_)
      for (int i = 0; i < 3; ++i) {
        low_ = low_.cwiseMin(corner(t, i));
        high_ = high_.cwiseMax(corner(t, i));
      }
    low_.array() -= 2.0 * touching_;
    high_.array() += 2.0 * touching_;
    cells_ = std::clamp(static_cast<int>(std::sqrt(0.5 * static_cast<double>(triangles_.size()))), 1, 200);
    columns_.resize(static_cast<std::size_t>(cells_ * cells_));
    for (const int t : triangles_) {
      const Vector3 low = corner(t, 0).cwiseMin(corner(t, 1)).cwiseMin(corner(t, 2));
      const Vector3 high = corner(t, 0).cwiseMax(corner(t, 1)).cwiseMax(corner(t, 2));
      for_columns(low, high, [&](std::vector<int>& column) { column.push_back(t); });
    }
  }

  const std::vector<int>& triangles() const { return triangles_; }
  bool box_meets(const Vector3& low, const Vector3& high) const {
    return (low.array() < high_.array()).all() && (high.array() > low_.array()).all();
  }
  bool box_meets(const PartSurface& other) const { return box_meets(other.low_, other.high_); }

  /// +1 when p lies inside, deeper than touching; -1 when it lies as far outside; 0 between.
  int side(const Vector3& p) {
    if (!box_meets(p, p)) return -1;
    bool inside = false, near = false;
    // A little aside, so that the ray upwards from p meets no edge.
    const Vector3 from = p + touching_ * Vector3(0.0617, 0.0387, 0.0);
    for_columns(
        p, p,
        [&](const std::vector<int>& column) {
          for (const int t : column) {
            const Vector3 a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
            near = near || distance_to_triangle(p, a, b, c) <= touching_;
            inside ^= ray_meets(from, a, b, c);
          }
        },
        true);
    return near ? 0 : inside ? 1 : -1;
  }

  /// Where the way from a to b goes through this surface's planes of triangles, as shares of it, with 0 and 1, sorted.
  std::vector<double> crossings(const Vector3& a, const Vector3& b) {
    std::vector<double> shares{0.0, 1.0};
    for_columns(a.cwiseMin(b), a.cwiseMax(b), [&](const std::vector<int>& column) {
      for (const int t : column) {
        const Vector3 n = area_vector(mesh_, mesh_.triangles[t]);
        const double from = n.dot(a - corner(t, 0)), to = n.dot(b - corner(t, 0));
        if ((from < 0.0) != (to < 0.0)) shares.push_back(from / (from - to));
      }
    });
    std::ranges::sort(shares);
    return shares;
  }

 private:
  const Vector3& corner(int t, int i) const { return mesh_.vertices[mesh_.triangles[t][i]]; }

  /// With `one`, the column of the first point alone.
  template <class Visit>
  void for_columns(const Vector3& low, const Vector3& high, Visit visit, bool one = false) {
    std::array<int, 2> first, last;
    for (int i = 0; i < 2; ++i) {
      const double cell = (high_[i] - low_[i]) / cells_, margin = one ? 0.0 : 2.0 * touching_;
      const auto at = [&](double x) { return std::clamp(static_cast<int>((x - low_[i]) / cell), 0, cells_ - 1); };
      first[i] = at(low[i] - margin);
      last[i] = at(high[i] + margin);
    }
    for (int x = first[0]; x <= last[0]; ++x)
      for (int y = first[1]; y <= last[1]; ++y) visit(columns_[static_cast<std::size_t>(x * cells_ + y)]);
  }

  static bool ray_meets(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
    const auto turn = [&](const Vector3& u, const Vector3& v) {
      return (u.x() - p.x()) * (v.y() - p.y()) - (u.y() - p.y()) * (v.x() - p.x());
    };
    const double ab = turn(a, b), bc = turn(b, c), ca = turn(c, a);
    if (!((ab > 0.0 && bc > 0.0 && ca > 0.0) || (ab < 0.0 && bc < 0.0 && ca < 0.0))) return false;
    return (bc * a.z() + ca * b.z() + ab * c.z()) / (ab + bc + ca) > p.z();
  }

  const Mesh& mesh_;
  std::vector<int> triangles_;
  double touching_;
  Vector3 low_, high_;
  int cells_ = 1;
  std::vector<std::vector<int>> columns_;
};

/// Whether edges of `a` run inside `b`, and outside it.
struct Sides {
  bool inside = false, outside = false;
};

Sides sides_of(const Mesh& mesh, const PartSurface& a, PartSurface& b) {
  Sides found;
  for (const int t : a.triangles())
    for (int e = 0; e < 3; ++e) {
      const int from = mesh.triangles[t][e], to = mesh.triangles[t][(e + 1) % 3];
      if (from > to) continue;  // the other triangle at this edge has it
      const Vector3 &p = mesh.vertices[from], &q = mesh.vertices[to];
      if (!b.box_meets(p.cwiseMin(q), p.cwiseMax(q))) {
        found.outside = true;
        continue;
      }
      const std::vector<double> shares = b.crossings(p, q);
      for (std::size_t i = 1; i < shares.size(); ++i) {
        const int side = b.side(p + 0.5 * (shares[i - 1] + shares[i]) * (q - p));
        found.inside = found.inside || side > 0;
        found.outside = found.outside || side < 0;
      }
      if (found.inside && found.outside) return found;
    }
  return found;
}

}  // namespace

NestedParts nested_parts(const Mesh& mesh, const EdgeMap& edges) {
  NestedParts found;
  found.part = parts_of(mesh, edges);
  const int count = found.part.empty() ? 0 : *std::ranges::max_element(found.part) + 1;
  if (count < 2) return found;
  std::vector<std::vector<int>> triangles(static_cast<std::size_t>(count));
  for (std::size_t t = 0; t < found.part.size(); ++t)
    triangles[static_cast<std::size_t>(found.part[t])].push_back(static_cast<int>(t));
  const MeshProperties all = properties_of(mesh);
  std::vector<PartSurface> parts;
  for (std::vector<int>& own : triangles)
    parts.emplace_back(mesh, std::move(own), kTouching * (all.high - all.low).norm());
  std::vector<bool> inner(parts.size(), false);
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t k = i + 1; k < parts.size(); ++k) {
      if (!parts[i].box_meets(parts[k])) continue;
      const Sides i_in_k = sides_of(mesh, parts[i], parts[k]), k_in_i = sides_of(mesh, parts[k], parts[i]);
      if (i_in_k.inside && !i_in_k.outside && !k_in_i.inside)
        inner[i] = true;
      else if (k_in_i.inside && !k_in_i.outside && !i_in_k.inside)
        inner[k] = true;
      else if (i_in_k.inside || k_in_i.inside)
        ++found.overlapping;
    }
  for (std::size_t i = 0; i < inner.size(); ++i)
    if (inner[i]) found.inner.push_back(static_cast<int>(i));
  return found;
}

}  // namespace stillhook
