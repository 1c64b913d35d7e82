#include "sim/hull/rankine/flat_panel.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

namespace stillhook::rankine {
namespace {

/// S and D by the midpoint rule on n x n pieces of the parallelogram a + s u + t v: second order, for points off it.
Influence by_quadrature(const Vector3& a, const Vector3& u, const Vector3& v, const Vector3& x, int n) {
  Influence sum;
  const Vector3 area = u.cross(v) / (n * n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vector3 r = x - (a + (i + 0.5) / n * u + (j + 0.5) / n * v);
      sum.S += area.norm() / r.norm();
      sum.D += area.dot(r) / std::pow(r.norm(), 3);
    }
  return sum;
}

FlatPanel parallelogram(const Vector3& a, const Vector3& u, const Vector3& v) {
  const std::array<Vector3, 4> corners{a, a + u, a + u + v, a + v};
  return flat_panel(corners);
}

const Vector3 kA(0.3, -1.2, 0.7), kU(1.1, 0.4, -0.3), kV(-0.2, 0.9, 0.5);

}  // namespace

TEST_CASE("area, centroid and moments of a panel", "[rankine]") {
  const std::array<Vector3, 4> trapezoid{Vector3(0, 0, 1), Vector3(4, 0, 1), Vector3(3, 2, 1), Vector3(1, 2, 1)};
  const FlatPanel panel = flat_panel(trapezoid);
  CHECK(panel.area == Approx(6.0));
  CHECK((panel.normal - Vector3::UnitZ()).norm() < 1e-15);
  // Trapezoid with parallel sides b = 4, a = 2, height 2: h/3 (b + 2a)/(a + b) above b.
  CHECK(panel.centroid.isApprox(Vector3(2.0, 8.0 / 9.0, 1.0), 1e-14));
  const FlatPanel square = parallelogram(Vector3(1, 1, 0), Vector3(2, 0, 0), Vector3(0, 2, 0));
  CHECK(square.moment(0, 0) == Approx(16.0 / 12.0));  // a^4 / 12
  CHECK(std::abs(square.moment(0, 1)) < 1e-14);
}

TEST_CASE("a mirrored panel faces the mirrored way", "[rankine]") {
  const FlatPanel panel = parallelogram(kA, kU, kV), m = mirrored(panel, 1);
  CHECK(m.area == Approx(panel.area));
  CHECK((m.normal - Vector3(panel.normal.x(), -panel.normal.y(), panel.normal.z())).norm() < 1e-14);
  const Vector3 x(0.4, 2.0, -1.0), mx(0.4, -2.0, -1.0);
  CHECK(exact_influence(m, x).S == Approx(exact_influence(panel, mx).S));
  CHECK(exact_influence(m, x).D == Approx(exact_influence(panel, mx).D));
}

TEST_CASE("a unit square at its own centre", "[rankine]") {
  // int int 1/r over a square of side 1 about its centre: 4 ln(1 + sqrt 2).
  const FlatPanel square = parallelogram(Vector3(2, 3, -1), Vector3::UnitX(), Vector3::UnitY());
  const Influence self = exact_influence(square, square.centroid);
  CHECK(self.S == Approx(4.0 * std::log(1.0 + std::sqrt(2.0))).epsilon(1e-13));
  CHECK(self.D == 0.0);
  // From half a side above it is one side of a cube seen from the middle: a sixth of the sphere, and positive.
  CHECK(exact_influence(square, square.centroid + Vector3(0, 0, 0.5)).D ==
        Approx(4.0 * std::numbers::pi / 6.0).epsilon(1e-13));
  CHECK(exact_influence(square, square.centroid - Vector3(0, 0, 0.5)).D ==
        Approx(-4.0 * std::numbers::pi / 6.0).epsilon(1e-13));
}

TEST_CASE("influence of a panel in a general position against quadrature", "[rankine]") {
  const FlatPanel panel = parallelogram(kA, kU, kV);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-2.0, 2.0);
  for (int i = 0; i < 20; ++i) {
    Vector3 x(number(random), number(random), number(random));
    if (std::abs(panel.normal.dot(x - panel.centroid)) < 0.4) x += 0.8 * panel.normal;
    const Influence exact = exact_influence(panel, x), sum = by_quadrature(kA, kU, kV, x, 200);
    // The midpoint rule's error: (1/200)^2 of the second derivative over the distance, 0.4 at least.
    CHECK(exact.S == Approx(sum.S).epsilon(1e-4));
    CHECK(exact.D == Approx(sum.D).epsilon(1e-4).margin(1e-5));
  }
}

TEST_CASE("in the panel's plane and on the line of an edge", "[rankine]") {
  const FlatPanel panel = parallelogram(kA, kU, kV);
  for (const Vector3& x : {Vector3(kA + 2.5 * kU), Vector3(kA - 1.5 * kU + 0.3 * kV), Vector3(kA + 3.0 * kV + 2.0 * kU)}) {
    const Influence exact = exact_influence(panel, x);
    CHECK(exact.S == Approx(by_quadrature(kA, kU, kV, x, 400).S).epsilon(1e-4));
    CHECK(exact.D == 0.0);
  }
}

TEST_CASE("expansion far from a panel", "[rankine]") {
  const FlatPanel panel = parallelogram(kA, kU, kV);
  std::mt19937 random(3);
  std::normal_distribution<double> number;
  for (int i = 0; i < 50; ++i) {
    const Vector3 R = kFar * panel.reach * Vector3(number(random), number(random), number(random)).normalized();
    const Influence exact = exact_influence(panel, panel.centroid + R);
    const Influence far = far_influence(panel, R, R.squaredNorm());
    CHECK(std::abs(far.S / exact.S - 1.0) < 2e-4);
    CHECK(std::abs(far.D - exact.D) < 2e-4 * panel.area / R.squaredNorm() * 5.0);
  }
}

TEST_CASE("the solid angle of a closed surface", "[rankine]") {
  // Six sides of a cube with normals outwards: -4 pi from inside (the side of the normals is the other), 0 from outside.
  std::vector<FlatPanel> cube;
  const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ(), o = Vector3::Zero();
  cube.push_back(parallelogram(o, y, x));
  cube.push_back(parallelogram(z, x, y));
  cube.push_back(parallelogram(o, x, z));
  cube.push_back(parallelogram(y, z, x));
  cube.push_back(parallelogram(o, z, y));
  cube.push_back(parallelogram(x, y, z));
  const auto angle = [&](const Vector3& from) {
    double sum = 0.0;
    for (const FlatPanel& panel : cube) sum += exact_influence(panel, from).D;
    return sum;
  };
  CHECK(angle(Vector3(0.3, 0.6, 0.8)) == Approx(-4.0 * std::numbers::pi).epsilon(1e-12));
  CHECK(std::abs(angle(Vector3(1.3, -0.6, 0.8))) < 1e-12);
  CHECK(angle(Vector3(1.0, 0.3, 0.4)) == Approx(-2.0 * std::numbers::pi).epsilon(1e-12));
}

}  // namespace stillhook::rankine
