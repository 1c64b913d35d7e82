#include "sim/hull/rankine/boundary_problem.h"

#include <cmath>
#include <optional>

#include "sim/spatial/constants.h"

namespace stillhook::rankine {
namespace {


Vector3 reflected(const Vector3& x, int image) {
  return {image & 1 ? -x.x() : x.x(), image & 2 ? -x.y() : x.y(), image & 4 ? -x.z() : x.z()};
}

/// Images about x and y (bits 1 and 2) that a symmetry has.
std::vector<int> images_of(const Symmetry& symmetry) {
  std::vector<int> images;
  for (int image = 0; image < 4; ++image)
    if (((image & 1) == 0 || symmetry.x) && ((image & 2) == 0 || symmetry.y)) images.push_back(image);
  return images;
}

double sign_of(const Parity& parity, int image) { return (image & 1 ? parity.x : 1) * (image & 2 ? parity.y : 1); }

/// S and D of hull panels at field points, class by class; `images_z` adds the image about z = 0 with that sign.
struct Kernels {
  std::vector<MatrixX> S, D;  // one a class
};

Influence over_bed(const BedImages& bed, const FlatPanel& panel, const Vector3& x, int image_z) {
  return image_z == 0 ? bed.half(panel, x) : image_z > 0 ? bed.even(panel, x) : bed.odd(panel, x);
}

std::optional<BedImages> images_in(const Bed& bed) {
  if (bed.deep()) return std::nullopt;
  return std::make_optional<BedImages>(bed);
}

Kernels hull_kernels(const std::vector<Vector3>& points, const HullPanels& hulls, int image_z,
                     const std::optional<BedImages>& bed) {
  const std::vector<int> images = images_of(hulls.symmetry);
  const std::vector<Parity> classes = parities(hulls.symmetry);
  const int rows = static_cast<int>(points.size()), columns = static_cast<int>(hulls.panels.size());
  Kernels k;
  k.S.assign(classes.size(), MatrixX(rows, columns));
  k.D = k.S;
#pragma omp parallel for schedule(dynamic, 8)
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) {
      std::array<Influence, 4> at{};
      for (std::size_t m = 0; m < images.size(); ++m) {
        if (bed) {
          at[m] = over_bed(*bed, hulls.panels[j], reflected(points[i], images[m]), image_z);
          continue;
        }
        at[m] = influence(hulls.panels[j], reflected(points[i], images[m]));
        if (image_z != 0) {
          const Influence below = influence(hulls.panels[j], reflected(points[i], images[m] | 4));
          at[m].S += image_z * below.S;
          at[m].D += image_z * below.D;
        }
      }
      for (std::size_t c = 0; c < classes.size(); ++c) {
        Influence sum;
        for (std::size_t m = 0; m < images.size(); ++m) {
          const double sign = sign_of(classes[c], images[m]);
          sum.S += sign * at[m].S;
          sum.D += sign * at[m].D;
        }
        k.S[c](i, j) = sum.S;
        k.D[c](i, j) = sum.D;
      }
    }
  return k;
}

std::vector<MatrixX> surface_kernels(const std::vector<Vector3>& points, const SurfacePanels& surface,
                                     const Symmetry& symmetry, const std::optional<BedImages>& bed) {
  const std::vector<int> images = images_of(symmetry);
  const std::vector<Parity> classes = parities(symmetry);
  const int rows = static_cast<int>(points.size()), columns = surface.size();
  std::vector<MatrixX> S(classes.size(), MatrixX(rows, columns));
#pragma omp parallel for schedule(dynamic, 8)
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) {
      std::array<double, 4> at{};
      for (std::size_t m = 0; m < images.size(); ++m) {
        const Vector3 x = reflected(points[i], images[m]);
        for (int p = surface.first[j]; p < surface.first[j + 1]; ++p)
          at[m] += bed ? bed->half(surface.pieces[p], x).S : influence(surface.pieces[p], x).S;
      }
      for (std::size_t c = 0; c < classes.size(); ++c) {
        double sum = 0.0;
        for (std::size_t m = 0; m < images.size(); ++m) sum += sign_of(classes[c], images[m]) * at[m];
        S[c](i, j) = sum;
      }
    }
  return S;
}

std::vector<Vector3> centroids(const HullPanels& hulls) {
  std::vector<Vector3> points;
  for (const FlatPanel& panel : hulls.panels) points.push_back(panel.centroid);
  return points;
}

/// -(2 pi - D)^-1 S
MatrixX solved(const MatrixX& D, const MatrixX& S, Eigen::PartialPivLU<MatrixX>* keep = nullptr) {
  MatrixX H = -D;
  H.diagonal().array() += kTwoPi;
  const Eigen::PartialPivLU<MatrixX> lu(H);
  if (keep) *keep = lu;
  return -lu.solve(S);
}

}  // namespace

std::vector<Parity> parities(const Symmetry& symmetry) {
  std::vector<Parity> all;
  for (const int x : {1, -1})
    for (const int y : {1, -1})
      if ((x == 1 || symmetry.x) && (y == 1 || symmetry.y)) all.push_back({x, y});
  return all;
}

VectorX mode_normal(const HullPanels& hulls, int hull, int mode, const ReferencePoint& reference) {
  VectorX normal = VectorX::Zero(hulls.panels.size());
  const Matrix3 to_heading = rotation_from({0.0, 0.0, reference.yaw}).transpose();
  const Vector3 origin(reference.x, reference.y, reference.z);
  for (std::size_t i = 0; i < hulls.panels.size(); ++i) {
    if (hulls.hull[i] != hull) continue;
    const Vector3 n = to_heading * hulls.panels[i].normal, r = to_heading * (hulls.panels[i].centroid - origin);
    normal(i) = mode < 3 ? n(mode) : r.cross(n)(mode - 3);
  }
  return normal;
}

Parity mode_parity(const Symmetry& symmetry, int mode) {
  const bool odd_x = mode == 0 || mode == 4 || mode == 5, odd_y = mode == 1 || mode == 3 || mode == 5;
  return {odd_x && symmetry.x ? -1 : 1, odd_y && symmetry.y ? -1 : 1};
}

BoundarySizes sizes_of(const HullPanels& hulls, const SurfacePanels& surface) {
  BoundarySizes sizes;
  sizes.hull = static_cast<int>(hulls.panels.size());
  sizes.surface = surface.size();
  sizes.classes = static_cast<int>(parities(hulls.symmetry).size());
  const double h = sizes.hull, f = sizes.surface;
  // N; C, what it comes from, R and the kernel D of the hull at the surface; responses and kernels of the hull.
  sizes.bytes = 8.0 * sizes.classes * (f * f + 4.0 * f * h + 6.0 * h * h);
  return sizes;
}

std::vector<BoundaryClass> limit_problem(const HullPanels& hulls, const Bed& bed) {
  const std::vector<Vector3> on_hull = centroids(hulls);
  const std::optional<BedImages> images = images_in(bed);
  const Kernels even = hull_kernels(on_hull, hulls, 1, images), odd = hull_kernels(on_hull, hulls, -1, images);
  std::vector<BoundaryClass> classes;
  for (const Parity& parity : parities(hulls.symmetry)) {
    const std::size_t c = classes.size();
    BoundaryClass result;
    result.parity = parity;
    result.hull_response = solved(even.D[c], even.S[c]);
    result.local = solved(odd.D[c], odd.S[c]);
    classes.push_back(std::move(result));
  }
  return classes;
}

std::vector<BoundaryClass> boundary_problem(const HullPanels& hulls, const SurfacePanels& surface, const Bed& bed) {
  const std::vector<Vector3> on_hull = centroids(hulls);
  std::vector<BoundaryClass> classes(parities(hulls.symmetry).size());
  const std::optional<BedImages> images = images_in(bed);
  Kernels even = hull_kernels(on_hull, hulls, 1, images), odd = hull_kernels(on_hull, hulls, -1, images);
  Kernels at_surface = hull_kernels(surface.point, hulls, 0, images);
  std::vector<MatrixX> S_HF = surface_kernels(on_hull, surface, hulls.symmetry, images);
  std::vector<MatrixX> S_FF = surface_kernels(surface.point, surface, hulls.symmetry, images);
  const std::vector<Parity> parity = parities(hulls.symmetry);
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t c = 0; c < classes.size(); ++c) {
    BoundaryClass& result = classes[c];
    result.parity = parity[c];
    Eigen::PartialPivLU<MatrixX> lu;
    result.hull_response = solved(even.D[c], even.S[c], &lu);
    result.local = solved(odd.D[c], odd.S[c]);
    // Memory is what limits the number of panels: matrices are made in the place of those they come from.
    for (MatrixX* kernel : {&even.S[c], &even.D[c], &odd.S[c], &odd.D[c]}) *kernel = MatrixX();
    result.C = 2.0 * lu.solve(S_HF[c]);
    S_HF[c] = MatrixX();
    result.N = std::move(S_FF[c]);
    result.N.noalias() += at_surface.D[c] * result.C;
    result.N /= kTwoPi;
    result.R = std::move(at_surface.S[c]);
    result.R *= -1.0;
    result.R.noalias() += at_surface.D[c] * result.hull_response;
    result.R /= kTwoPi;
    at_surface.D[c] = MatrixX();
  }
  return classes;
}

}  // namespace stillhook::rankine
