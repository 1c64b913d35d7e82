#include "sim/hull/damping.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

namespace stillhook {
namespace {

ViscousDamping some_damping() {
  ViscousDamping d;
  d.linear << 1e5, 2e5, 3e5, 4e7, 5e7, 6e7;
  d.quadratic << 2e5, 0.0, 1e6, 3e9, 1e9, 0.0;
  return d;
}

}  // namespace

TEST_CASE("viscous damping opposes every motion", "[damping]") {
  const ViscousDamping d = some_damping();
  for (int i = 0; i < 6; ++i)
    for (double v : {-0.7, 0.3}) {
      Vector6 V = Vector6::Zero();
      V(i) = v;
      const Vector6 F = d.force(V);
      CHECK(F(i) * v < 0.0);
      CHECK(F(i) == Approx(-d.linear(i) * v - d.quadratic(i) * std::abs(v) * v));
      CHECK((F.array() != 0.0).count() == 1);
      CHECK(d.power(V) == Approx(-F(i) * v));
      CHECK(d.power(V) > 0.0);
    }
  CHECK(d.power(Vector6::Zero()) == 0.0);
  CHECK(ViscousDamping{}.none());
  CHECK_FALSE(d.none());
}

TEST_CASE("the derivative of viscous damping is exact, through rest too", "[damping]") {
  const ViscousDamping d = some_damping();
  Vector6 V;
  V << 0.4, -0.2, 0.0, 0.05, -0.03, 0.01;
  const Vector6 slope = d.derivative(V);
  for (int i = 0; i < 6; ++i) {
    const double h = 1e-6;
    Vector6 up = V, down = V;
    up(i) += h;
    down(i) -= h;
    // |v| v is quadratic on each side of rest: central differences are exact but for rounding, and off by q h at rest.
    CHECK(slope(i) == Approx((d.force(up)(i) - d.force(down)(i)) / (2.0 * h)).epsilon(1e-5));
  }
}

TEST_CASE("a fraction of critical damping gives that damping ratio", "[damping]") {
  Vector6 fraction = Vector6::Zero(), stiffness = Vector6::Zero(), inertia = Vector6::Zero();
  fraction(2) = 1.0;
  fraction(3) = 0.04;
  stiffness(2) = 5.1e7;
  inertia(2) = 1.1e8;
  stiffness(3) = 7.6e9;
  inertia(3) = 1.7e10;
  const Vector6 b = critical_damping(fraction, stiffness, inertia);
  // m s^2 + b s + c = 0: a double root for 1, and roots with |Re| / |s| = 0.04 for 0.04.
  CHECK(b(2) * b(2) - 4.0 * inertia(2) * stiffness(2) == Approx(0.0).margin(1e-9 * b(2) * b(2)));
  CHECK(b(3) / (2.0 * inertia(3)) / std::sqrt(stiffness(3) / inertia(3)) == Approx(0.04).epsilon(1e-12));
  CHECK(b(0) == 0.0);
  CHECK(b(4) == 0.0);

  fraction(0) = 0.1;  // surge has no stiffness
  CHECK_THROWS_AS(critical_damping(fraction, stiffness, inertia), std::invalid_argument);
}

TEST_CASE("natural frequency with added mass that depends on frequency", "[damping]") {
  CHECK(natural_frequency(8.0, 2.0, [](double) { return 0.0; }) == Approx(2.0).epsilon(1e-9));
  // A(w) = 6 / w^2 + 1: w^2 (2 + 1) + 6 = 8.
  CHECK(natural_frequency(8.0, 2.0, [](double w) { return 6.0 / (w * w) + 1.0; }) ==
        Approx(std::sqrt(2.0 / 3.0)).epsilon(1e-9));
  CHECK_THROWS_AS(natural_frequency(0.0, 2.0, [](double) { return 0.0; }), std::invalid_argument);
}

}  // namespace stillhook
