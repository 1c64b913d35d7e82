#include "sim/lifting/wire.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "sim/specification.h"
#include "tests/sim/force_element_suite.h"
#include "tests/sim/vertical_mass.h"

using namespace stillhook;

namespace {

WireOptions hoist_options() {
  WireOptions o;
  o.name = "hoist";
  o.from = {kWorld, {0.0, 0.0, 100.0}};
  o.to = {0, Vector3::Zero()};
  o.axial_stiffness = 3.31e9;
  o.unstretched_length = 93.43;
  return o;
}

constexpr double kMass = 5e5, kGravity = 9.80665;

}  // namespace

TEST_CASE("the tension of a wire is EA times strain plus damping, along the line of its ends") {
  std::mt19937 random(7);
  suite::Scene s = suite::general_scene(random, 2, 1);
  const Instant now = s.instant();
  WireOptions o = hoist_options();
  o.from = {0, {1.0, 2.0, -0.5}};
  o.to = {1, {-0.3, 0.8, 1.4}};
  o.drive = 0;
  o.damping = 4e4;
  const Vector3 p = s.body[1].R_WB * o.to.c_B + s.body[1].p_WC - s.body[0].R_WB * o.from.c_B - s.body[0].p_WC;
  const Vector3 v = s.body[1].v_WC + (s.body[1].R_WB * s.body[1].w_B).cross(s.body[1].R_WB * o.to.c_B) -
                    s.body[0].v_WC - (s.body[0].R_WB * s.body[0].w_B).cross(s.body[0].R_WB * o.from.c_B);
  const double L = 0.97 * p.norm();
  o.unstretched_length = L + s.drive[0].position;
  const Wire wire(o);
  const double expected = o.axial_stiffness / L * (p.norm() - L) + o.damping * (v.dot(p) / p.norm() + s.drive[0].rate);
  CHECK(wire.tension(now) == Approx(expected).epsilon(1e-12));
  ForceSum sum(2);
  wire.add_forces(now, 0.0, {}, sum);
  const Vector3 on_lower = sum.value().segment<3>(6);
  CHECK((on_lower + expected * p.normalized()).norm() < 1e-10 * expected);  // lower end pulled to the upper one
}

TEST_CASE("a wire never pushes, and its tension starts without a jump") {
  WireOptions o = hoist_options();
  o.damping = 5e5;
  const double L = o.unstretched_length, k = o.axial_stiffness / L;
  for (double rate = -20.0; rate <= 20.0; rate += 0.5) {
    CHECK(wire_tension(L - 1e-12, rate, L, 0.0, o) == 0.0);
    CHECK(wire_tension(0.2 * L, rate, L, 0.0, o) == 0.0);
    // Over the first 1e-9 of the damping strain the tension may only rise by 2e-9 of the full damping force.
    const double first = 1e-9 * o.damping_strain * L;
    CHECK(wire_tension(L + first, rate, L, 0.0, o) <= k * first + 2.1e-9 * o.damping * std::abs(rate));
    bool taut = false;
    for (double d = 0.0; d < 0.5; d += 1e-4) {
      const double T = wire_tension(L + d, rate, L, 0.0, o);
      CHECK(T >= 0.0);
      if (taut) CHECK(T > 0.0);  // going slack, the force ends once
      taut = taut || T > 0.0;
      const double heat = unilateral_dissipation(T, d, rate, k);
      CHECK(heat >= 0.0);
      CHECK(heat <= o.damping * rate * rate * (1.0 + 1e-9));
    }
  }
}

TEST_CASE("a mass on a wire has the period of EA/L and decays at the damping ratio it was given") {
  WireOptions o = hoist_options();
  const double k = o.axial_stiffness / o.unstretched_length, omega = std::sqrt(k / kMass);
  const double rest = 100.0 - o.unstretched_length - kMass * kGravity / k;
  for (const double ratio : {0.1, 0.02}) {
    o.damping = wire_damping(ratio, kMass, o.axial_stiffness, o.unstretched_length);
    const Wire wire(o);
    VerticalMass m{wire, kMass, kGravity, rest + 0.05};
    // Runge-Kutta at omega h = 0.008 damps by 1e-12 a step; maxima are read off to (omega h)^2/8.
    CHECK(decay_ratio(m, rest, 1e-3, 4) == Approx(ratio).margin(1e-4));
  }
  o.damping = 0.0;
  const Wire wire(o);
  VerticalMass m{wire, kMass, kGravity, rest + 0.05};
  const double period = 2.0 * M_PI / omega;
  const int n = 2000;
  for (int i = 0; i < n; ++i) m.step(5.0 * period / n);
  CHECK(m.z - rest == Approx(0.05).epsilon(1e-6));  // phase error of Runge-Kutta over five periods
  CHECK(std::abs(m.v) < 1e-5 * 0.05 * omega);
}

TEST_CASE("a load dropped through slack and snap keeps its energy account") {
  for (const double ratio : {0.0, 0.02}) {
    WireOptions o = hoist_options();
    o.damping = wire_damping(ratio, kMass, o.axial_stiffness, o.unstretched_length);
    const Wire wire(o);
    const double k = o.axial_stiffness / o.unstretched_length, drop = 0.4;
    VerticalMass m{wire, kMass, kGravity, 100.0 - o.unstretched_length + drop};
    const double start = m.energy();
    double peak = 0.0;
    bool slack_again = false;
    for (int i = 0; i < 60000; ++i) {
      m.step(1e-4);
      const double T = wire.tension(m.at(m.z, m.v));
      peak = std::max(peak, T);
      slack_again = slack_again || (peak > 0.0 && T == 0.0);
      // Each of the few dozen crossings of the slack boundary costs one step of order h^2 k v^2.
      REQUIRE(m.energy() + m.heat == Approx(start).margin(1e-5 * kMass * kGravity * drop));
    }
    CHECK(slack_again);
    if (ratio == 0.0) {
      // Energy: 1/2 d^2 k = m g (drop + d).
      const double weight = kMass * kGravity;
      CHECK(peak == Approx(weight * (1.0 + std::sqrt(1.0 + 2.0 * k * drop / weight))).epsilon(1e-5));
      CHECK(m.heat == 0.0);
    } else {
      CHECK(m.heat > 0.01 * kMass * kGravity * drop);
    }
  }
}

TEST_CASE("the channels of a wire are in the crane's heading") {
  std::vector<BodyKinematics> body(2);
  body[0].R_WB = rotation_from({0.05, -0.08, 2.1});
  const double c = std::cos(2.1), s = std::sin(2.1);
  // Lower end 4 m ahead, 3 m to starboard, 50 m below.
  body[1].p_WC = Vector3(10.0, 20.0, 100.0) + Vector3(4.0 * c + 3.0 * s, 4.0 * s - 3.0 * c, -50.0);
  std::vector<DriveState> drive{{1.5, 0.02}};
  WireOptions o = hoist_options();
  o.from = {kWorld, {10.0, 20.0, 100.0}};
  o.to = {1, Vector3::Zero()};
  o.unstretched_length = 52.0;
  o.drive = 0;
  o.crane = 0;
  const Wire wire(o);
  std::vector<double> out(wire.channels().size());
  wire.measure({0.0, body, drive}, {}, out);
  CHECK(out[1] == Approx(std::sqrt(16.0 + 9.0 + 2500.0)));
  CHECK(out[2] == Approx(50.5));
  CHECK(out[3] == Approx(-0.02));  // hauling in
  CHECK(out[4] == Approx(4.0));
  CHECK(out[5] == Approx(-3.0));
  CHECK(out[6] == Approx(std::atan(4.0 / 50.0)));
  CHECK(out[7] == Approx(-std::atan(3.0 / 50.0)));
}

TEST_CASE("a wire within one body only strains it") {
  std::mt19937 random(3);
  const suite::Scene s = suite::general_scene(random, 1, 0);
  WireOptions o = hoist_options();
  o.from = {0, {1.0, 0.2, 3.0}};
  o.to = {0, {-2.0, 1.2, -3.0}};
  o.unstretched_length = 6.0;
  const Wire wire(o);
  ForceSum sum(1);
  wire.add_forces(s.instant(), 0.0, {}, sum);
  REQUIRE(wire.tension(s.instant()) > 1e6);
  CHECK(sum.value().norm() < 1e-12 * wire.tension(s.instant()));
}

TEST_CASE("a winch stops with its block on the sheave") {
  WireOptions o = hoist_options();
  o.drive = 0;
  const Wire wire(o);
  std::vector<BodyKinematics> body(1);
  std::vector<DriveState> drive{{93.0, 0.1}};
  CHECK(wire.unstretched_length({0.0, body, drive}) == Approx(0.01 * 93.43));
}

TEST_CASE("a wire that cannot be is refused, and the sentence names it") {
  const auto broken = [](auto change) {
    WireOptions o = hoist_options();
    change(o);
    return o;
  };
  CHECK_THROWS_AS(Wire(broken([](auto& o) { o.axial_stiffness = -1.0; })), SpecificationError);
  CHECK_THROWS_AS(Wire(broken([](auto& o) { o.unstretched_length = 0.0; })), SpecificationError);
  CHECK_THROWS_AS(Wire(broken([](auto& o) { o.damping = std::nan(""); })), SpecificationError);
  CHECK_THROWS_WITH(Wire(broken([](auto& o) { o.axial_stiffness = 0.0; })),
                    Catch::Contains("wires.hoist.axial_stiffness"));
}
