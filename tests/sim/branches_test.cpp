// Differences of force laws on either side of a kink: along the branches that an element takes in between they are the
// derivative of these branches, the one that differences on the near side of the kink alone have too.
#include "sim/multibody/branches.h"

#include <catch2/catch.hpp>

#include "sim/lifting/contact.h"
#include "sim/lifting/mooring.h"
#include "sim/lifting/tagline.h"
#include "sim/lifting/wire.h"
#include "tests/sim/force_element_suite.h"

using namespace stillhook;
using suite::Scene;

namespace {

/// An element that depends on a parameter, and a step that it takes.
struct Kinked {
  std::string kink;
  std::function<std::unique_ptr<const ForceElement>(double)> make;
  double at = 0.0;             // the parameter, so little on one side of the kink
  double wide = 0.0;           // reaches well beyond it,
  double narrow = 0.0;         // and this does not
  Scene before, now;           // the beginning and the end of the step
  std::vector<Scene> earlier;  // where the element started, if not at the beginning
  double h = 0.05;             // s
};

/// The force over the step, and the state it leaves, one under the other.
VectorX outcome(const ForceElement& element, const Kinked& k, std::vector<double> state, Branches* branches) {
  std::vector<double> scratch(static_cast<std::size_t>(element.scratch_size()), 0.0);
  const Memory m{state, scratch};
  Instant from = k.before.instant(), to = k.now.instant();
  from.branches = to.branches = branches;
  element.begin_step(from, k.h, m);
  ForceSum sum(static_cast<int>(k.now.body.size()));
  element.add_forces(to, k.h, m, sum);
  element.end_step(to, k.h, m);
  VectorX all(sum.value().size() + static_cast<Eigen::Index>(state.size()));
  all << sum.value(), Eigen::Map<const VectorX>(state.data(), static_cast<Eigen::Index>(state.size()));
  return all;
}

VectorX slope(const Kinked& k, double width, bool along) {
  const auto base = k.make(k.at);
  std::vector<double> state(static_cast<std::size_t>(base->state_size()), 0.0);
  std::vector<double> scratch(static_cast<std::size_t>(base->scratch_size()), 0.0);
  base->start((k.earlier.empty() ? k.before : k.earlier.front()).instant(), {state, scratch});
  Branches branches;
  branches.record();
  outcome(*base, k, state, &branches);
  const auto side = [&](double by) {
    branches.replay();
    return outcome(*k.make(k.at + by), k, state, along ? &branches : nullptr);
  };
  return (side(0.5 * width) - side(-0.5 * width)) / width;
}

Scene hanging_body(double z, double vz = 0.0) {
  Scene s;
  s.body.resize(2);
  s.body[0].p_WC = Vector3(0.0, 0.0, z);
  s.body[0].v_WC = Vector3(0.0, 0.0, vz);
  return s;
}

Kinked slack_wire(double taut_by, double speed_down) {
  Kinked k;
  k.kink = "a wire at its limit of slack";
  k.make = [](double length) {
    WireOptions o;
    o.name = "fall";
    o.from = {kWorld, {0.0, 0.0, 30.0}};
    o.to = {0, Vector3::Zero()};
    o.axial_stiffness = 6e8;
    o.damping = 5e4;
    o.unstretched_length = length;
    return std::make_unique<const Wire>(o);
  };
  k.at = 18.0;
  k.wide = 1e-4;
  k.narrow = 0.2 * std::abs(taut_by);
  k.before = k.now = hanging_body(30.0 - 18.0 - taut_by, -speed_down);
  return k;
}

ContactOptions deck_at(double height) {
  ContactOptions o;
  o.name = "deck";
  o.body = 0;
  o.points = {Vector3::Zero()};
  o.surface = {1, {0.0, 0.0, height}};
  o.length = o.breadth = 10.0;
  o.stiffness = 2e8;
  o.damping = 1e6;
  o.friction = 0.3;
  return o;
}

Kinked touching_point(double pressed_by) {
  Kinked k;
  k.kink = "a point that begins to touch";
  k.make = [](double height) { return std::make_unique<const Contact>(deck_at(height)); };
  k.at = 0.0;
  k.wide = 1e-4;
  k.narrow = 0.2 * std::abs(pressed_by);
  k.before = k.now = hanging_body(-pressed_by, -0.1);
  return k;
}

// Pressed in by 1 cm: N = 2 MN, the cone 0.6 MN wide and reached after 3 mm.
Kinked sticking_point(double short_of) {
  Kinked k;
  k.kink = "a point that begins to slip";
  k.make = [](double friction) {
    ContactOptions o = deck_at(0.0);
    o.friction = friction;
    return std::make_unique<const Contact>(o);
  };
  k.at = 0.3;
  k.wide = 1e-2;
  k.narrow = 0.2 * std::abs(short_of);
  k.earlier = {hanging_body(-0.01)};
  k.before = k.earlier.front();
  k.now = k.before;
  k.now.body[0].p_WC.x() = 0.01 * (0.3 - short_of);
  return k;
}

TaglineOptions line_to_load() {
  TaglineOptions o;
  o.name = "tagline";
  o.from = {1, {0.0, 0.0, 10.0}};
  o.to = {0, Vector3::Zero()};
  o.hoist_upper = {1, {20.0, 0.0, 100.0}};
  o.hoist_lower = {0, Vector3::Zero()};
  o.kp = 1.2e6;
  o.kd = 6.0e6;
  o.pretension = 20e3;
  o.tension_max = 1e9;
  return o;
}

Scene load_out(double out, double speed) {
  Scene s = hanging_body(10.0);
  s.body[0].p_WC.x() = 20.0 + out;
  s.body[0].v_WC.x() = speed;
  return s;
}

// The load plumb under its hoist wire and going out: the angle of the wire is the error over a set point of zero.
Kinked tagline_at_set_point(double beyond) {
  Kinked k;
  k.kink = "a tagline at its set point";
  k.make = [](double set_point) {
    TaglineOptions o = line_to_load();
    o.set_point = set_point;
    return std::make_unique<const Tagline>(o, load_out(0.0, 0.0).instant());
  };
  k.at = -beyond;
  k.wide = 1e-3;
  k.narrow = 0.2 * std::abs(beyond);
  k.before = k.now = load_out(0.0, 0.05);
  return k;
}

// From rest to a pull of 20 kN + ... within the step: the line is paid out at less or more than the winch can.
Kinked tagline_at_speed_limit(double within) {
  Kinked k;
  k.kink = "a tagline winch at its speed limit";
  k.before = load_out(0.0, 0.0);
  k.now = load_out(0.01, 0.2);
  // At its commanded tension the winch pays out as far as the line gets longer less what stretches it.
  const auto with_limit = [](double speed) {
    TaglineOptions o = line_to_load();
    o.kp = 0.0;
    o.speed_max = speed;
    return std::make_unique<const Tagline>(o, load_out(0.0, 0.0).instant());
  };
  k.make = with_limit;
  const auto unlimited = with_limit(0.0);
  std::vector<double> state(static_cast<std::size_t>(unlimited->state_size()), 0.0);
  std::vector<double> scratch(static_cast<std::size_t>(unlimited->scratch_size()), 0.0);
  unlimited->start(k.before.instant(), {state, scratch});
  const VectorX free = outcome(*unlimited, k, state, nullptr);
  k.at = std::abs(free[12 + 1]) + within;  // after 12 forces and the length paid out: the speed of the line
  k.wide = 1e-2;
  k.narrow = 0.2 * std::abs(within);
  return k;
}

Kinked slack_mooring(double taut_by) {
  Kinked k;
  k.kink = "a linear mooring line that begins to pull";
  k.before = k.now = hanging_body(0.0);
  k.now.body[0].p_WC.x() = 1.5 - taut_by / 1e5;  // its pretension of 150 kN is gone
  k.make = [](double pretension) {
    MooringOptions o;
    o.name = "bow";
    o.type = MooringOptions::Type::linear;
    o.fairlead = {0, Vector3::Zero()};
    o.pretension = pretension;
    o.stiffness = 1e5;
    o.anchor_distance = 200.0;
    return std::make_unique<const Mooring>(o, hanging_body(0.0).instant());
  };
  k.at = 150e3;
  k.wide = 100.0;
  k.narrow = 0.2 * std::abs(taut_by);
  return k;
}

}  // namespace

TEST_CASE("along its branches a law has one derivative on either side of a kink", "[kink]") {
  const Kinked k = GENERATE(slack_wire(1e-7, 0.0), slack_wire(-1e-7, 0.3), slack_wire(1e-7, 0.3), touching_point(1e-7),
                            touching_point(-1e-7), sticking_point(1e-6), sticking_point(-1e-6),
                            tagline_at_set_point(1e-7), tagline_at_set_point(-1e-7), tagline_at_speed_limit(1e-6),
                            tagline_at_speed_limit(-1e-6), slack_mooring(0.1), slack_mooring(-0.1));
  CAPTURE(k.kink, k.at, k.wide, k.narrow);
  const VectorX truth = slope(k, k.narrow, false), along = slope(k, k.wide, true), plain = slope(k, k.wide, false);
  // The wide pair leaves terms of second order in its width, the narrow one rounding: 1e-16 of forces up to 1 MN, or of
  // places of 20 m, over its width.
  const double rounding = 1e-9 / k.narrow;
  CHECK((along - truth).cwiseAbs().maxCoeff() <= 1e-3 * truth.cwiseAbs().maxCoeff() + rounding);
  // Without, half of the difference is of the other side.
  const double change = (plain - truth).cwiseAbs().maxCoeff();
  CHECK(change > 0.2 * std::max(truth.cwiseAbs().maxCoeff(), plain.cwiseAbs().maxCoeff()));
  CHECK(change > 10.0 * rounding);
}

TEST_CASE("branches are replayed from the first on, and conditions beyond them are as they are", "[kink]") {
  Branches branches;
  branches.record();
  CHECK(branches.take(true));
  CHECK_FALSE(branches.take(false));
  for (int times = 0; times < 2; ++times) {
    branches.replay();
    CHECK(branches.take(false));
    CHECK_FALSE(branches.take(true));
    CHECK(branches.take(true));
  }
  branches.record();
  CHECK_FALSE(branches.take(false));
  CHECK(on_branch(nullptr, true));
  CHECK_FALSE(on_branch(nullptr, false));
}
