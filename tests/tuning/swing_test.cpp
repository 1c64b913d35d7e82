// The damping of a swing: linearised and simulated agree, and both with the closed form of a pendulum on a PD tagline.
#include "tuning/swing.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

namespace stillhook {
namespace {

constexpr double kMass = 2.0e4, kLength = 25.0, kGravity = 9.80665;  // kg, m, m/s2

/// A point-like load on one stiff wire under a fixed tip, with a horizontal tagline in x.
Specification pendulum(double kp, double kd) {
  Specification s;
  s.name = "pendulum";
  SeaStateSpec calm;
  calm.name = "calm";
  s.sea.states = {calm};
  s.sea.active = "calm";
  BodySpec load;
  load.name = "load";
  load.mass = kMass;
  load.inertia = 0.01 * kMass * Matrix3::Identity();
  load.position = {0.0, 0.0, 0.0};
  s.bodies = {load};
  WireSpec wire;
  wire.name = "fall";
  wire.role = WireSpec::Role::hoist;
  wire.from = "world";
  wire.to = "load";
  wire.point_from = {0.0, 0.0, kLength};
  wire.axial_stiffness = 5.0e8;
  wire.damping_ratio = 0.05;
  wire.damping_mass = kMass;
  wire.unstretched_length = kLength;
  s.wires = {wire};
  TaglineSpec line;
  line.name = "line";
  line.from = "world";
  line.to = "load";
  line.point_from = {-200.0, 0.0, 0.0};
  line.wire = "fall";
  line.kp = kp;
  line.kd = kd;
  line.pretension = 0.0;
  line.tension_max = 1.0e7;
  line.time_constant = 0.02;
  line.axial_stiffness = 2.0e8;
  s.taglines = {line};
  PhaseSpec hang;
  hang.name = "hang";
  hang.stage = PhaseSpec::Stage::hanging;
  hang.duration = 60.0;
  s.operation.load = "load";
  s.operation.phases = {hang};
  s.solver.time_step = 0.02;
  s.solver.output_interval = 0.02;
  s.solver.hht_alpha = -0.02;
  return s;
}

TEST_CASE("Damping of a pendulum on a tagline", "[swing]") {
  const double w = std::sqrt(kGravity / kLength);
  // A line that pushed and pulled would give kd theta' / l on m l^2 theta'' at the arm l: zeta = kd / (2 m l w) / 1; a
  // line that only pulls, half of it. kd for 2 % of critical by the half.
  const double zeta = 0.02, kd = 2.0 * 2.0 * zeta * w * kMass * kLength;
  const auto modes = swing_modes(pendulum(0.0, kd));
  REQUIRE(modes.size() == 2);
  const SwingMode& fore_aft = modes[0];
  CHECK(fore_aft.direction == "fore-aft");
  // Stretch of the wire (1 cm) and the load's own inertia (radius 0.1 m) are below 1e-3.
  CHECK(fore_aft.period == Approx(2.0 * std::numbers::pi / w).epsilon(2e-3));
  CHECK(std::abs(fore_aft.linear_free) < 1e-4);
  CHECK(fore_aft.linear_lines == Approx(zeta).epsilon(0.01));
  // The half-wave force is no harmonic one: the describing function is of first order in zeta. HHT with alpha = -0.02
  // at w h = 0.0125 adds 1e-8.
  CHECK(fore_aft.decay_lines == Approx(zeta).epsilon(0.03));
  CHECK(std::abs(fore_aft.decay_free) < 2e-4);
  // Athwart the line does nothing.
  CHECK(modes[1].direction == "athwart");
  CHECK(std::abs(modes[1].linear_lines) < 1e-4);
}

}  // namespace
}  // namespace stillhook
