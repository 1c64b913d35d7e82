#include "sim/hull/rankine/mesh_symmetry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stillhook::rankine {
namespace {

/// m2, from a point to a triangle (Ericson, Real-Time Collision Detection, 5.1.5).
double squared_distance(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return ap.squaredNorm();
  const Vector3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return bp.squaredNorm();
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return (ap - d1 / (d1 - d3) * ab).squaredNorm();
  const Vector3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return cp.squaredNorm();
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return (ap - d2 / (d2 - d6) * ac).squaredNorm();
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) return (bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b)).squaredNorm();
  const double sum = va + vb + vc;
  return (ap - vb / sum * ab - vc / sum * ac).squaredNorm();
}

/// Triangles by where they lie along x, so that those near a point are found without going through all.
class TriangleBins {
 public:
  /// `reach`: m, how far from a point its nearest triangle may be for it to be found.
  TriangleBins(const Mesh& mesh, double reach) : mesh_(mesh), reach_(reach) {
    const MeshProperties size = properties_of(mesh);
    low_ = size.low.x();
    width_ = std::max((size.high.x() - low_) / kBins, 1e-300);
    bins_.resize(kBins);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto x = [&](int corner) { return mesh.vertices[mesh.triangles[t][corner]].x(); };
      const int last = bin(std::max({x(0), x(1), x(2)}) + reach);
      for (int b = bin(std::min({x(0), x(1), x(2)}) - reach); b <= last; ++b) bins_[b].push_back(static_cast<int>(t));
    }
  }

  /// m, to the nearest triangle; infinite when none is within reach.
  double distance(const Vector3& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const int t : bins_[bin(p.x())]) {
      const Vector3 &a = mesh_.vertices[mesh_.triangles[t][0]], &b = mesh_.vertices[mesh_.triangles[t][1]],
                    &c = mesh_.vertices[mesh_.triangles[t][2]];
      if ((p - a.cwiseMax(b).cwiseMax(c)).maxCoeff() > reach_ || (a.cwiseMin(b).cwiseMin(c) - p).maxCoeff() > reach_)
        continue;
      least = std::min(least, squared_distance(p, a, b, c));
    }
    return std::sqrt(least);
  }

 private:
  static constexpr int kBins = 200;
  int bin(double x) const { return std::clamp(static_cast<int>((x - low_) / width_), 0, kBins - 1); }

  const Mesh& mesh_;
  double reach_, low_ = 0.0, width_ = 0.0;
  std::vector<std::vector<int>> bins_;
};

bool mirrored_on_itself(const Mesh& hull, const TriangleBins& bins, int axis, double rms, double most) {
  double squares = 0.0;
  for (Vector3 vertex : hull.vertices) {
    vertex(axis) *= -1.0;
    const double distance = bins.distance(vertex);
    if (!(distance <= most)) return false;
    squares += distance * distance;
  }
  return squares <= rms * rms * static_cast<double>(hull.vertices.size());
}

}  // namespace

Symmetry surface_symmetry(const Mesh& hull, double waterline) {
  const MeshProperties size = properties_of(hull);
  const Vector3 extent = size.high - size.low;
  const double shorter = std::min(extent.x(), extent.y());
  Symmetry symmetry = symmetry_of(hull, 1e-4 * extent.x());
  if (symmetry.x && symmetry.y) return symmetry;
  const TriangleBins bins(hull, kSurfaceMost * shorter);
  constexpr double kAny = std::numeric_limits<double>::max();
  for (const int axis : {0, 1}) {
    bool& found = axis == 0 ? symmetry.x : symmetry.y;
    if (found || !mirrored_on_itself(hull, bins, axis, kSurfaceRms * shorter, kSurfaceMost * shorter)) continue;
    const Symmetry half{axis == 0, axis == 1};
    const double whole = mesh_panels(hull, waterline, kAny, {}).volume(0);
    found = std::abs(mesh_panels(hull, waterline, kAny, half).volume(0) - whole) <= kHalfVolume * whole;
  }
  return symmetry;
}

}  // namespace stillhook::rankine
