// What a run records of a contact, against a body dropped on a deck: closed forms for the bounce on a spring, and the
// momentum for any damping.
//
//   v = sqrt(2 g h)      penetration  z'' = g - w^2 z, z(0) = 0, z'(0) = v,  w^2 = k/m
//   in contact for  (2/w)(pi - atan(v w / g)),     largest force  m g + sqrt((m g)^2 + k m v^2)
//   impulse of the deck = m (v+ - v-) + m g t
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sim/simulate.h"

using namespace stillhook;

namespace {

constexpr double kMass = 2e3, kGravity = 9.80665, kHeight = 0.2, kStiffness = 2e5;  // kg, m/s2, m, N/m
constexpr double kDeck = 3.0, kHalf = 0.75;  // m: the deck's height, the body's half height

Specification drop(double damping, double step) {
  Specification s;
  s.name = "drop";
  BodySpec body;
  body.name = "load";
  body.mass = kMass;
  body.inertia = 500.0 * Matrix3::Identity();
  body.position = Vector3(1.0, -2.0, kDeck + kHalf + kHeight);
  s.bodies = {body};
  ContactSpec deck;
  deck.name = "deck";
  deck.role = ContactSpec::Role::pickup;
  deck.body = "load";
  deck.points = {{0.5, 0.5, -kHalf}, {0.5, -0.5, -kHalf}, {-0.5, -0.5, -kHalf}, {-0.5, 0.5, -kHalf}};
  deck.surface_body = "world";
  deck.surface_centre = Vector3(0.0, 0.0, kDeck);
  deck.surface_length = deck.surface_breadth = 20.0;
  deck.stiffness = kStiffness;
  deck.damping = damping;
  deck.damping_depth = 0.01;
  s.contacts = {deck};
  s.operation.load = "load";
  s.solver.static_start = false;
  s.solver.time_step = s.solver.output_interval = step;
  s.solver.max_duration = 5.0;
  return s;
}

struct Fall {
  explicit Fall(double damping, double step) : step_(step), model(build_model(drop(damping, step))) {
    run = simulate(model, build_operation(model));
    REQUIRE(run.status == RunStatus::completed);
  }
  double at(const char* channel, double t) const {
    return run.values[static_cast<std::size_t>(run.find(channel))][static_cast<std::size_t>(std::lround(t / step_))];
  }
  double step_;
  Model model;
  Trajectory run;
};

const double kFrequency = std::sqrt(kStiffness / kMass), kFallTime = std::sqrt(2.0 * kHeight / kGravity),
             kSpeed = std::sqrt(2.0 * kGravity * kHeight),
             kTouchTime = 2.0 / kFrequency * (std::numbers::pi - std::atan(kSpeed * kFrequency / kGravity)),
             kPeak = kMass * kGravity + std::sqrt(std::pow(kMass * kGravity, 2) + kStiffness * kMass * kSpeed * kSpeed);

}  // namespace

TEST_CASE("a body dropped on an elastic deck bounces as often, as long, as fast and as hard as the closed form says") {
  for (const double step : {2e-3, 1e-3}) {
    CAPTURE(step);
    const Fall fall(0.0, step);
    const std::vector<ContactEvent>& bounces = fall.run.contacts;
    // Touches begin at t1 + i (2 t1 + t_c): 0.202, 1.013, ... within 5 s; the last ends before.
    const double t1 = kFallTime, again = 2.0 * t1 + kTouchTime;
    const auto expected = static_cast<std::size_t>(std::floor((5.0 - t1) / again)) + 1;
    REQUIRE(expected == 6);
    REQUIRE(bounces.size() == expected);
    for (std::size_t i = 0; i < bounces.size(); ++i) {
      CAPTURE(i);
      const ContactEvent& b = bounces[i];
      // An event begins and ends with a step; the integrator's damping takes a few times (w h)^2 of each bounce.
      const double start = t1 + static_cast<double>(i) * again, drift = static_cast<double>(i) * 2e-3;
      CHECK(b.start == Approx(start).margin(step + drift));
      if (i + 1 < bounces.size()) CHECK(b.end == Approx(start + kTouchTime).margin(step + drift));
      // The touch lies within a step: g h of the speed.
      CHECK(b.approach_speed == Approx(kSpeed).margin(kGravity * step + drift));
      CHECK(b.peak_force == Approx(kPeak).epsilon(1e-3 + drift));
      CHECK(b.place.isApprox(Vector3(1.0, -2.0, kDeck), 0.2));
      CHECK(b.contact == "deck");
      CHECK(b.role == ContactSpec::Role::pickup);
      CHECK(b.phase == "run");
    }
  }
}

TEST_CASE("the speed at touch and the largest force are nearer with half the step") {
  const auto worst = [](double step) {
    const Fall fall(0.0, step);
    return std::abs(fall.run.contacts[0].approach_speed - kSpeed);
  };
  CHECK(worst(0.01) < kGravity * 0.01);
  CHECK(worst(1e-3) < kGravity * 1e-3);
  CHECK(worst(1e-4) < kGravity * 1e-4);
}

TEST_CASE("the impulse of a bounce is the change of momentum and the weight's own, whatever the damping and the step") {
  // Up to an eighth of critical damping (4e4 N s/m): above about 0.16 of it the upward stroke takes so much that the force
  // m (g - z'') of the rebound never falls to zero, and the body stays on the deck.
  for (const double damping : {0.0, 3e3, 5e3})
    for (const double step : {5e-3, 1e-3}) {
      CAPTURE(damping, step);
      const Fall fall(damping, step);
      const ContactEvent& b = fall.run.contacts.front();
      REQUIRE(b.end < 4.0);
      // From the step before the first force to the step after the last, where the integrator's mean of two steps has
      // let go of it: to rounding, and to Newton's tolerance of 1e-7 g a step.
      const double from = b.start - step, to = b.end + step;
      const double momentum =
          kMass * (fall.at("load.vz", to) - fall.at("load.vz", from)) + kMass * kGravity * (to - from);
      CHECK(b.impulse == Approx(momentum).epsilon(1e-5));
    }
}

TEST_CASE("a damped bounce is slower each time, and ends at rest on the deck") {
  // An eighth of critical: z'' of the first rebound reaches w sqrt((w v)^2 + g^2)/w exp(-0.48 s zeta w) = 12 m/s2 > g, so
  // the body leaves the deck once; the second touch is slower and reaches 6 m/s2, so it stays. The law integrated by
  // itself (midpoint rule, steps of 20 us) leaves at 0.634 s and touches again at 0.781 s with 0.574 m/s.
  const Fall fall(5e3, 1e-3);
  const std::vector<ContactEvent>& bounces = fall.run.contacts;
  REQUIRE(bounces.size() == 2);
  // An event begins and ends with a step; the speed is that of a step at the touch, g h away from it.
  CHECK(bounces[0].end == Approx(0.634).margin(2e-3));
  CHECK(bounces[1].start == Approx(0.781).margin(2e-3));
  CHECK(bounces[1].approach_speed == Approx(0.574).margin(2.0 * kGravity * 1e-3));
  for (std::size_t i = 1; i < bounces.size(); ++i) {
    CHECK(bounces[i].approach_speed < bounces[i - 1].approach_speed);
    CHECK(bounces[i].peak_force < bounces[i - 1].peak_force);
  }
  CHECK(fall.run.contacts.back().end == Approx(5.0));  // it lies there
  // What is left of 0.1 m after 4.2 s of the decay exp(-zeta w t): 0.5 mm at most.
  CHECK(fall.at("load.z", 5.0) == Approx(kDeck + kHalf - kMass * kGravity / kStiffness).margin(1e-3));
}

TEST_CASE("extremes are of every step, not of the samples alone") {
  Specification s = drop(0.0, 1e-3);
  s.solver.output_interval = 0.5;
  const Model model = build_model(s);
  const Trajectory run = simulate(model, build_operation(model));
  REQUIRE(run.time.size() == 11);
  const auto force = static_cast<std::size_t>(run.find("deck.force")), z = static_cast<std::size_t>(run.find("load.z"));
  // The deepest point is a maximum: within half a step of it the force is off by (w h / 2)^2 / 2 = 1e-5.
  CHECK(run.extremes[0][force].max == Approx(kPeak).epsilon(1e-3));
  // In the middle of one of the bounces, which are alike.
  const double again = 2.0 * kFallTime + kTouchTime,
               since = run.extremes[0][force].t_max - kFallTime - 0.5 * kTouchTime;
  CHECK(std::remainder(since, again) == Approx(0.0).margin(0.02));
  CHECK(run.extremes[0][z].min == Approx(kDeck + kHalf - kPeak / kStiffness).margin(1e-3));
  CHECK(run.extremes[0][z].max == Approx(kDeck + kHalf + kHeight).margin(1e-3));
}
