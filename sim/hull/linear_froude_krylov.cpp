#include "sim/hull/linear_froude_krylov.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/hull/froude_krylov_kernel.h"
#include "sim/sea/dispersion.h"

namespace stillhook {
namespace {

using Complex = std::complex<double>;

/// A point of Dunavant's rule of degree 5 with 7 points (Int. J. Numer. Meth. Eng. 21, 1985), barycentric.
struct QuadraturePoint {
  double a, b, c, weight;
};

const std::array<QuadraturePoint, 7>& quadrature() {
  constexpr double p = 0.470142064105115, q = 0.059715871789770, u = 0.132394152788506;
  constexpr double r = 0.101286507323456, s = 0.797426985353087, v = 0.125939180544827;
  static const std::array<QuadraturePoint, 7> points = {{{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 0.225},
                                                         {p, p, q, u},
                                                         {p, q, p, u},
                                                         {q, p, p, u},
                                                         {r, r, s, v},
                                                         {r, s, r, v},
                                                         {s, r, r, v}}};
  return points;
}

/// Hands the part of the triangle below z = 0 to sink(a, b, c), at most two triangles.
template <class Sink>
void clip(const std::array<Vector3, 3>& corner, Sink sink) {
  std::array<Vector3, 4> kept;
  int count = 0;
  for (int n = 0; n < 3; ++n) {
    const Vector3 &from = corner[n], &to = corner[(n + 1) % 3];
    if (from.z() <= 0.0) kept[count++] = from;
    if ((from.z() < 0.0 && to.z() > 0.0) || (from.z() > 0.0 && to.z() < 0.0))
      kept[count++] = from + (to - from) * (from.z() / (from.z() - to.z()));
  }
  if (count >= 3) sink(kept[0], kept[1], kept[2]);
  if (count == 4) sink(kept[0], kept[2], kept[3]);
}

}  // namespace

LinearFroudeKrylov::LinearFroudeKrylov(const Mesh& hull, double waterline, double density, double gravity, double depth)
    : waterline_(waterline), density_(density), gravity_(gravity), depth_(depth) {
  const Vector3 shift(0.0, 0.0, -waterline);
  for (const std::array<int, 3>& t : hull.triangles) {
    const std::array<Vector3, 3> corner = {hull.vertices[t[0]] + shift, hull.vertices[t[1]] + shift,
                                           hull.vertices[t[2]] + shift};
    clip(corner, [&](const Vector3& a, const Vector3& b, const Vector3& c) {
      const Vector3 normal = (b - a).cross(c - a);
      // A deck that lies in the water plane is dry.
      if (normal.norm() == 0.0 || std::min({a.z(), b.z(), c.z()}) >= 0.0) return;
      wetted_.push_back({a, b, c});
      // int z n_z dS; the water plane adds nothing at z = 0.
      volume_ += 0.5 * normal.z() * (a.z() + b.z() + c.z()) / 3.0;
    });
  }
  if (!(volume_ > 0.0)) throw MeshError("the hull has no volume below its mean water plane");
}

WaterplaneIntegrals LinearFroudeKrylov::waterplane() const {
  // The wetted surface and the water plane close: int f(x, y) n_z dS over both is zero. Degree 2, so the rule is exact.
  WaterplaneIntegrals I;
  I.volume = volume_;
  for (const Triangle& t : wetted_) {
    const double nz = 0.5 * (t.b - t.a).cross(t.c - t.a).z();
    for (const QuadraturePoint& q : quadrature()) {
      const Vector3 p = q.a * t.a + q.b * t.b + q.c * t.c;
      const double dS = q.weight * nz;
      I.area -= dS;
      I.x -= p.x() * dS;
      I.y -= p.y() * dS;
      I.xx -= p.x() * p.x() * dS;
      I.xy -= p.x() * p.y() * dS;
      I.yy -= p.y() * p.y() * dS;
      I.depth += 0.5 * p.z() * p.z() * dS;
    }
  }
  return I;
}

Eigen::Matrix<Complex, 6, 1> LinearFroudeKrylov::excitation(double frequency, double heading) const {
  return excitations(frequency, {heading}).col(0);
}

Eigen::Matrix<Complex, 6, Eigen::Dynamic> LinearFroudeKrylov::excitations(double frequency,
                                                                          const std::vector<double>& headings) const {
  return integral(frequency, headings, [](const Vector3&) { return 1.0; });
}

Eigen::Matrix<Complex, 6, 1> LinearFroudeKrylov::short_wave_diffraction(double frequency, double heading) const {
  // Sides within asin(1/4) = 14 deg of the waves' direction are partly lit: the boundary of the shadow is as wide.
  constexpr double kGrazing = 0.25;
  const Vector3 along(std::cos(heading), std::sin(heading), 0.0);
  return integral(frequency, {heading}, [&](const Vector3& normal) {
    return std::clamp(-normal.dot(along) / kGrazing, -1.0, 1.0);
  });
}

template <class Factor>
Eigen::Matrix<Complex, 6, Eigen::Dynamic> LinearFroudeKrylov::integral(double frequency,
                                                                       const std::vector<double>& headings,
                                                                       Factor factor) const {
  const double k = wave_number(frequency, gravity_, depth_), bed = bed_reflection(k, depth_);
  // On pieces with k * edge <= 0.8 the rule of degree 5 leaves (k edge)^6 / 6! ~ 4e-4 of the piece, with signs that
  // alternate along the wave.
  const double longest = 0.8 / std::max(k, 1e-12);
  std::vector<double> x, y;
  std::array<std::vector<double>, 6> weight;  // -rho g C(z) (n, x_B x n) dS of each point
  for (const Triangle& t : wetted_) {
    const Vector3 outwards = (t.b - t.a).cross(t.c - t.a);
    const double share = factor(outwards.normalized());
    if (share == 0.0) continue;
    const double edge = std::max({(t.b - t.a).norm(), (t.c - t.b).norm(), (t.a - t.c).norm()});
    const int cuts = std::max(1, static_cast<int>(std::ceil(edge / longest)));
    const Vector3 normal = -share * density_ * gravity_ / (2.0 * cuts * cuts) * outwards;
    const auto add_piece = [&](const Vector3& a, const Vector3& b, const Vector3& c) {
      for (const QuadraturePoint& q : quadrature()) {
        const Vector3 at = q.a * a + q.b * b + q.c * c;
        const double fall = std::exp(k * at.z()), profile = (fall + bed / fall) / (1.0 + bed);
        const Vector3 force = q.weight * profile * normal;
        const Vector3 moment = Vector3(at.x(), at.y(), at.z() + waterline_).cross(force);  // z from Bo
        x.push_back(at.x());
        y.push_back(at.y());
        for (int i = 0; i < 3; ++i) {
          weight[i].push_back(force[i]);
          weight[3 + i].push_back(moment[i]);
        }
      }
    };
    // cuts^2 congruent pieces: an upright one at (i, j) and, except along the last edge, a turned one beside it.
    const Vector3 u = (t.b - t.a) / cuts, v = (t.c - t.a) / cuts;
    for (int i = 0; i < cuts; ++i)
      for (int j = 0; i + j < cuts; ++j) {
        const Vector3 corner = t.a + i * u + j * v;
        add_piece(corner, corner + u, corner + v);
        if (i + j + 1 < cuts) add_piece(corner + u, corner + u + v, corner + v);
      }
  }
  const double* const weights[6] = {weight[0].data(), weight[1].data(), weight[2].data(),
                                    weight[3].data(), weight[4].data(), weight[5].data()};
  Eigen::Matrix<Complex, 6, Eigen::Dynamic> X(6, headings.size());
  for (std::size_t h = 0; h < headings.size(); ++h) {
    double real[6], imag[6];
    sum_phases(x.data(), y.data(), weights, static_cast<int>(x.size()), k * std::cos(headings[h]),
               k * std::sin(headings[h]), real, imag);
    for (int i = 0; i < 6; ++i) X(i, static_cast<int>(h)) = Complex(real[i], imag[i]);
  }
  return X;
}

}  // namespace stillhook
