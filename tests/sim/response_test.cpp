#include "sim/response.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/modes.h"
#include "sim/operation.h"
#include "sim/sea/dispersion.h"
#include "sim/simulate.h"

namespace stillhook {
namespace {

constexpr double kDensity = 1025.0, kGravity = 9.80665;
constexpr double kYaw = 0.6;

/// A box of 40 x 20 m, draft 2 m, Bo in the middle of the water plane, with constant coefficients.
struct Box {
  double length = 40.0, breadth = 20.0, draft = 2.0;
  double added = 1.1e6, damping = 4.0e5;  // kg, kg/s in heave
  double surge_added = 2.0e5;             // kg
  double mass() const { return kDensity * length * breadth * draft; }
  double stiffness() const { return kDensity * kGravity * length * breadth; }

  Specification specification() const {
    Specification spec;
    spec.name = "box";
    BodySpec body;
    body.name = "box";
    body.mass = mass();
    body.cog = Vector3(0.0, 0.0, 0.3);
    body.inertia = mass() * Vector3(36.0, 130.0, 150.0).asDiagonal();
    body.position = Vector3(12.0, -7.0, 0.0);
    body.attitude.yaw = kYaw;
    body.hull.shape = HullSpec::Shape::box;
    body.hull.size = Vector3(length, breadth, 2.0 * draft);
    body.hydrodynamics.kind = HydrodynamicsSpec::Kind::constant;
    body.hydrodynamics.added_mass.diagonal() << surge_added, 3e5, added, 2e7, 1e8, 1e8;
    body.hydrodynamics.damping.diagonal() << 0.0, 0.0, damping, 2e7, 5e7, 1e7;
    spec.bodies.push_back(body);
    return spec;
  }
};

double sinc(double x) { return std::abs(x) < 1e-9 ? 1.0 : std::sin(x) / x; }

/// c + i s of value = a + b t + c cos(w t) + s sin(w t), so that the oscillation is Re[(c + i s) exp(-i w t)].
Complex oscillation(const std::vector<double>& time, const std::vector<double>& value, double from, double w) {
  MatrixX A(0, 4);
  VectorX y(0);
  std::size_t first = 0;
  while (time[first] < from) ++first;
  const std::size_t n = time.size() - first;
  A.resize(n, 4);
  y.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = time[first + i];
    A.row(i) << 1.0, t - from, std::cos(w * t), std::sin(w * t);
    y[i] = value[first + i];
  }
  const VectorX x = A.colPivHouseholderQr().solve(y);
  return {x[2], x[3]};
}

SeaStateSpec regular(double amplitude, double frequency, double heading) {
  SeaStateSpec state;
  state.name = "swell";
  state.type = SeaStateSpec::Type::regular;
  state.amplitude = amplitude;
  state.frequency = frequency;
  state.heading = heading;
  return state;
}

/// Response of a body's Bo per metre of wave, crest at its mean position, from a simulation.
/// The operation of `spec` first, then it waits in the waves; `from`: where it hangs by then.
ResponseAmplitude::Vector6c simulated(Specification spec, double frequency, double heading, double duration,
                                      const SystemState* from = nullptr) {
  constexpr double kAmplitude = 0.02;  // m: small enough for the linear theory
  spec.sea.states = {regular(kAmplitude, frequency, heading)};
  spec.sea.active = "swell";
  spec.sea.ramp = 20.0;
  PhaseSpec phase;
  phase.name = "waiting";
  phase.duration = duration;
  spec.operation.phases.push_back(phase);
  spec.solver.hht_alpha = 0.0;
  spec.solver.time_step = 0.05;
  const Model model = build_model(spec);
  const Trajectory run = simulate(model, build_operation(model));
  REQUIRE(run.status == RunStatus::completed);
  const double period = 2.0 * std::numbers::pi / frequency;
  const Pose X_WB = pose_of((from ? *from : model.initial_state()).body[0], model.system().bodies[0]);
  const double k = wave_number(frequency, kGravity, spec.sea.wave_depth());
  const double lead = k * (X_WB.p.x() * std::cos(heading) + X_WB.p.y() * std::sin(heading));
  ResponseAmplitude::Vector6c W;
  const char* channels[6] = {"x", "y", "z", "roll", "pitch", "yaw"};
  for (int i = 0; i < 6; ++i) {
    const int channel = run.find(spec.bodies[0].name + "." + channels[i]);
    REQUIRE(channel >= 0);
    W[i] = oscillation(run.time, run.values[channel], run.time.back() - 6.0 * period, frequency) / kAmplitude;
  }
  const double c = std::cos(kYaw), s = std::sin(kYaw);
  ResponseAmplitude::Vector6c result = W;
  result[0] = c * W[0] + s * W[1];
  result[1] = -s * W[0] + c * W[1];
  return result * std::polar(1.0, -lead);
}

ResponseAmplitude::Vector6c of_Bo(const LinearResponse& linear, double frequency, double heading) {
  return linear.motion(linear.at(frequency, heading), 0, Vector3::Zero());
}

/// The reference crane's hull with the coefficients of its draft of 4 m.
Specification crane_hull() {
  Specification spec;
  spec.name = "crane";
  BodySpec body;
  body.name = "crane";
  body.mass = kDensity * 110.0 * 46.0 * 4.0;
  body.cog = Vector3(0.0, 0.0, 2.0);
  body.inertia = body.mass * Vector3(200.0, 1000.0, 1100.0).asDiagonal();
  body.position = Vector3(30.0, 20.0, 0.0);
  body.attitude.yaw = kYaw;
  body.hull.shape = HullSpec::Shape::box;
  body.hull.size = Vector3(110.0, 46.0, 7.5);
  body.hull.centre = Vector3(0.0, 0.0, -0.25);
  body.hydrodynamics.kind = HydrodynamicsSpec::Kind::table;
  body.hydrodynamics.coefficient_file = STILLHOOK_SOURCE_DIR "/problems/hulls/crane_110x46x4.csv";
  body.hydrodynamics.critical_fraction << 0.0, 0.0, 0.0, 0.1, 0.0, 0.0;
  spec.bodies.push_back(body);
  return spec;
}

}  // namespace

TEST_CASE("heave of a box is that of one degree of freedom under the Froude-Krylov force", "[response]") {
  const Box box;
  for (const double depth : {0.0, 9.0}) {  // deep and shallow
    Specification spec = box.specification();
    spec.sea.depth = depth;
    const Model model = build_model(spec);
    const LinearResponse linear(model);
    CHECK(linear.highest_frequency() == std::numeric_limits<double>::infinity());
    for (const double w : {0.35, 0.8, 1.3, 1.9})
      for (const double heading : {-2.0, 0.3, kYaw + 1.1}) {
        const double k = depth > 0.0 ? wave_number(w, kGravity, depth) : w * w / kGravity, relative = heading - kYaw;
        const double under_bottom =
            depth > 0.0 ? std::cosh(k * (depth - box.draft)) / std::cosh(k * depth) : std::exp(-k * box.draft);
        const double X = box.stiffness() * under_bottom * sinc(0.5 * k * box.length * std::cos(relative)) *
                         sinc(0.5 * k * box.breadth * std::sin(relative));
        const Complex expected = X / Complex(box.stiffness() - w * w * (box.mass() + box.added), -w * box.damping);
        // The quadrature of the pressure leaves 2e-5, the clipped mesh of the hydrostatics is exact for a box.
        CHECK(std::abs(of_Bo(linear, w, heading)[2] - expected) < 2e-4 * std::abs(expected));
      }
  }
}

TEST_CASE("in long waves a box follows the water", "[response]") {
  const Box box;
  const Model model = build_model(box.specification());
  const LinearResponse linear(model);
  const double w = 0.08, heading = 2.3, relative = heading - kYaw;
  const ResponseAmplitude::Vector6c motion = of_Bo(linear, w, heading);
  // k L/2 = 0.013; the dynamics leave (w/wn)^2 = 0.3 % of the wave, pitch with its moment arm less.
  CHECK(std::abs(motion[2] - 1.0) < 0.01);
  // Water particles turn forward under the crest: horizontally sin(w t), a lag of a quarter period; without diffraction
  // the hull is slower by its added mass.
  const double slow = box.mass() / (box.mass() + box.surge_added);
  CHECK(std::abs(motion[0] - Complex(0.0, slow * std::cos(relative))) < 0.02);
  // Slope of the surface d zeta/dx = -k sin(kx - wt): where it rises ahead the bow rises, and pitch is bow down.
  const double k = w * w / kGravity;
  CHECK(std::abs(motion[4] - Complex(0.0, -k * std::cos(relative))) < 0.03 * k);
  CHECK(std::abs(motion[3] - Complex(0.0, k * std::sin(relative))) < 0.03 * k);
}

TEST_CASE("the resonance lies at the natural period", "[response]") {
  Box box;
  box.damping = 2e4;  // 0.25 % of critical: the peak is at the natural frequency
  const Model model = build_model(box.specification());
  const LinearResponse linear(model);
  const double period = period_of(natural_modes(model, model.initial_state()), 0, 2);
  const double natural = std::sqrt(box.stiffness() / (box.mass() + box.added));
  CHECK(period == Approx(2.0 * std::numbers::pi / natural).epsilon(1e-4));
  double best = 0.0, at = 0.0;
  for (double w = 0.97 * natural; w < 1.03 * natural; w += 2e-4 * natural)
    if (const double heave = std::abs(of_Bo(linear, w, 0.9)[2]); heave > best) best = heave, at = w;
  CHECK(at == Approx(natural).epsilon(1e-3));
}

TEST_CASE("another point of the body moves with it", "[response]") {
  const Model model = build_model(Box().specification());
  const LinearResponse linear(model);
  const ResponseAmplitude response = linear.at(0.9, 1.4);
  const Vector3 p(13.0, 4.0, 6.0);
  const ResponseAmplitude::Vector6c Bo = linear.motion(response, 0, Vector3::Zero()), P = linear.motion(response, 0, p);
  // The phase is that of the crest at the point.
  const double k = 0.81 / kGravity, relative = 1.4 - kYaw;
  const Complex shift = std::polar(1.0, -k * (p.x() * std::cos(relative) + p.y() * std::sin(relative)));
  const Eigen::Vector3cd turn = Bo.tail<3>();
  CHECK(std::abs(P[2] - shift * (Bo[2] + turn[0] * p.y() - turn[1] * p.x())) < 1e-9);
  CHECK(std::abs(P[0] - shift * (Bo[0] + turn[1] * p.z() - turn[2] * p.y())) < 1e-9);
}

TEST_CASE("linear response and simulation agree in a small regular wave", "[response]") {
  const double depth = GENERATE(0.0, 12.0);  // m: deep, and so shallow that the waves are 9 and 27 % shorter
  CAPTURE(depth);
  SECTION("constant coefficients") {
    Specification spec = Box().specification();
    spec.sea.depth = depth;
    const Model model = build_model(spec);
    const LinearResponse linear(model);
    const double w = 1.1, heading = 2.1;
    const ResponseAmplitude::Vector6c expected = of_Bo(linear, w, heading), run = simulated(spec, w, heading, 150.0);
    // 3 %: second order in the wave (k a = 0.2 %), the step of 0.05 s ((w dt)^2/12 = 0.03 %, more near resonance).
    for (int i = 0; i < 5; ++i) {
      INFO("mode " << i << ": " << expected[i] << " and " << run[i]);
      CHECK(std::abs(run[i] - expected[i]) < 0.03 * std::abs(expected[i]));
    }
  }
  SECTION("a coefficient set") {
    Specification spec = crane_hull();
    spec.sea.depth = depth;
    const Model model = build_model(spec);
    const LinearResponse linear(model);
    CHECK(linear.highest_frequency() < 10.0);
    CHECK_FALSE(linear.resolves(linear.highest_frequency() + 0.1, kYaw));
    CHECK_THROWS_AS(linear.at(linear.highest_frequency() + 0.1, kYaw), std::invalid_argument);
    const double w = 0.628, heading = kYaw + std::numbers::pi / 4.0;
    const ResponseAmplitude::Vector6c expected = of_Bo(linear, w, heading), run = simulated(spec, w, heading, 160.0);
    // As above, with 0.5 % for the kernels that are cut.
    for (int i = 0; i < 5; ++i) {
      INFO("mode " << i << ": " << expected[i] << " and " << run[i]);
      CHECK(std::abs(run[i] - expected[i]) < 0.03 * std::abs(expected[i]));
    }
  }
}

TEST_CASE("a hull that has been lifted out of its draft is excited as it floats now", "[response]") {
  // A sky hook takes a quarter of the hull's weight: its draft goes from 4 to 3 m, the coefficients stay those of 4 m, in
  // the run as here. With the wave pressure of the draft at the start surge and sway were 1.3 times those of the run.
  Specification spec = crane_hull();
  DriveSpec winch;
  winch.name = "winch";
  spec.drives.push_back(winch);
  WireSpec wire;
  wire.name = "sky_hook";
  wire.from = "world";
  wire.to = "crane";
  wire.point_from = Vector3(30.0, 20.0, 200.0);
  wire.axial_stiffness = 2.0e9;
  wire.slack = 0.0;
  wire.winch = "winch";
  spec.wires.push_back(wire);
  const double quarter = 0.25 * spec.bodies[0].mass * kGravity;
  const double hauled = 1.0 + quarter / (wire.axial_stiffness / 200.0);  // m: the new draft and the stretch
  PhaseSpec hoist;
  hoist.name = "hoist";
  MoveSpec move;
  move.drive = "winch";
  move.speed = 0.2;
  move.travel = hauled;
  hoist.moves = {move};
  spec.operation.phases = {hoist};
  const Model model = build_model(spec);
  const Operation operation = build_operation(model);
  const SystemState hung = operation.equilibria.back();
  const LinearResponse linear(model, hung);
  const double w = 0.628, heading = kYaw + std::numbers::pi / 4.0;
  const ResponseAmplitude::Vector6c expected = of_Bo(linear, w, heading), run = simulated(spec, w, heading, 200.0, &hung);
  for (int i = 0; i < 5; ++i) {
    INFO("mode " << i << ": " << expected[i] << " and " << run[i]);
    CHECK(std::abs(run[i] - expected[i]) < 0.03 * std::abs(expected[i]));
  }
}

}  // namespace stillhook
