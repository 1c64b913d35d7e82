#include "sim/hull/linear_froude_krylov.h"

#include <algorithm>
#include <array>
#include <cmath>

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

LinearFroudeKrylov::LinearFroudeKrylov(const Mesh& hull, double waterline, double density, double gravity)
    : waterline_(waterline), density_(density), gravity_(gravity) {
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

Eigen::Matrix<Complex, 6, 1> LinearFroudeKrylov::excitation(double frequency, double heading) const {
  const double k = frequency * frequency / gravity_;
  const double kx = k * std::cos(heading), ky = k * std::sin(heading);
  // On pieces with k * edge <= 0.5 the rule of degree 5 leaves (k edge)^6 / 6! ~ 2e-5 of the piece, with signs that
  // alternate along the wave.
  const double longest = 0.5 / std::max(k, 1e-12);
  Eigen::Matrix<Complex, 6, 1> X = Eigen::Matrix<Complex, 6, 1>::Zero();
  for (const Triangle& t : wetted_) {
    const Vector3 normal = 0.5 * (t.b - t.a).cross(t.c - t.a);
    const double edge = std::max({(t.b - t.a).norm(), (t.c - t.b).norm(), (t.a - t.c).norm()});
    const int cuts = std::max(1, static_cast<int>(std::ceil(edge / longest)));
    Complex sum = 0.0;
    Eigen::Vector3cd first_moment = Eigen::Vector3cd::Zero();
    const auto add_piece = [&](const Vector3& a, const Vector3& b, const Vector3& c) {
      for (const QuadraturePoint& q : quadrature()) {
        const Vector3 x = q.a * a + q.b * b + q.c * c;
        const Complex pressure = q.weight * std::exp(k * x.z()) * std::polar(1.0, kx * x.x() + ky * x.y());
        sum += pressure;
        first_moment += pressure * x.cast<Complex>();
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
    const Eigen::Vector3cd n = normal.cast<Complex>() / static_cast<double>(cuts * cuts);
    first_moment.z() += waterline_ * sum;  // z from Bo
    X.head<3>() -= sum * n;
    X.tail<3>() += cross_matrix(normal).cast<Complex>() * first_moment / static_cast<double>(cuts * cuts);
  }
  return density_ * gravity_ * X;
}

}  // namespace stillhook
