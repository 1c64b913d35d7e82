// Booms, vessels and the planes of booms: leads against hand calculations on small lifts, whatever the heading and slew.
#include "sim/crane_parts.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "sim/model.h"
#include "sim/drive_unit.h"
#include "sim/recorder.h"

using namespace stillhook;

namespace {

BodySpec body(const std::string& name, const Vector3& position, double heading) {
  BodySpec b;
  b.name = name;
  b.mass = 1e5;
  b.inertia = 1e6 * Matrix3::Identity();
  b.position = position;
  b.attitude.yaw = heading;
  return b;
}

Vector3 turned(const Vector3& p, double heading) {
  return rotation_from({0.0, 0.0, heading}) * p;
}

JointSpec hinge(const std::string& name, const std::string& parent, const std::string& child, const Vector3& on_parent,
                const Vector3& axis) {
  JointSpec j;
  j.name = name;
  j.parent = parent;
  j.child = child;
  j.point_on_parent = on_parent;
  j.axis = axis;
  return j;
}

/// A vessel with a slewing house and a luffing boom on it; the load's eye 2 m further out than the sheave, 1 m to port
/// of the boom's plane and 30 m below it. `raised`: of the boom, rad; its body's x axis lies along it.
void add_crane(Specification& s, const std::string& prefix, const Vector3& at, double heading, double slew,
               double raised) {
  const double boom_heading = heading + slew;
  const Vector3 foot = at + turned({20.0, 5.0, 8.0}, heading);
  const Vector3 tip = foot + turned({40.0 * std::cos(raised), 0.0, 40.0 * std::sin(raised)}, boom_heading);
  s.bodies.push_back(body(prefix + "vessel", at, heading));
  s.bodies.push_back(body(prefix + "house", foot, boom_heading));
  s.bodies.push_back(body(prefix + "boom", foot, boom_heading));
  s.bodies.back().attitude.pitch = -raised;
  s.joints.push_back(
      hinge(prefix + "ring", prefix + "vessel", prefix + "house", {20.0, 5.0, 8.0}, Vector3::UnitZ()));
  s.joints.push_back(hinge(prefix + "heel_pin", prefix + "house", prefix + "boom", Vector3::Zero(), {0.0, -1.0, 0.0}));
  s.bodies.push_back(body(prefix + "load", tip + turned({2.0, 1.0, -30.0}, boom_heading), 0.3));
  WireSpec wire;
  wire.name = prefix + "fall";
  wire.role = WireSpec::Role::hoist;
  wire.from = prefix + "boom";
  wire.to = prefix + "load";
  wire.point_from = {40.0, 0.0, 0.0};
  wire.axial_stiffness = 1e8;
  wire.unstretched_length = 29.0;
  s.wires.push_back(wire);
}

Specification bare() {
  Specification s;
  s.sea.active = "calm";
  s.sea.states = {SeaStateSpec{}};
  s.sea.states[0].name = "calm";
  s.solver.static_start = false;
  return s;
}

std::map<std::string, double> values_of(const Specification& s) {
  const Model model = build_model(s);
  return channel_values(model, model.initial_state());
}

}  // namespace

TEST_CASE("off-lead and side-lead are in and out of the boom's plane, whatever the heading and slew", "[crane]") {
  for (const double heading : {0.0, 0.7, -2.9})
    for (const double slew : {0.0, -1.5707963267948966, 2.2, 3.141592653589793})
      for (const double raised : {0.3, 1.2, 1.5707963267948966, 1.7})  // the last two: upright, and leant back
        for (const char* crane : {"", "vessel", "house"}) {
          CAPTURE(heading, slew, raised, crane);
          Specification s = bare();
          add_crane(s, "", {100.0, -40.0, 0.0}, heading, slew, raised);
          s.operation.load = "load";
          s.operation.crane = crane;
          const auto values = values_of(s);
          // Behind the vertical the tip is aft of the hinge, so outwards is the other way.
          const double out = raised > 1.6 ? -1.0 : 1.0;
          CHECK(values.at("fall.off_lead") == Approx(out * std::atan(2.0 / 30.0)).epsilon(1e-9));
          CHECK(values.at("fall.side_lead") == Approx(out * std::atan(1.0 / 30.0)).epsilon(1e-9));
          // The offsets stay in the vessel's heading: the load lies at (2, 1) turned by the slew.
          const Vector3 offset = turned({2.0, 1.0, 0.0}, slew);
          CHECK(values.at("fall.offset_x") == Approx(offset.x()).margin(1e-9));
          CHECK(values.at("fall.offset_y") == Approx(offset.y()).margin(1e-9));
        }
}

TEST_CASE("a boom that only slews has the plane of its sheave, whichever way its body's axes lie", "[crane]") {
  for (const double turn : {0.0, 0.5, 2.0}) {  // of the body's axes against the boom
    Specification s = bare();
    s.bodies = {body("vessel", Vector3::Zero(), 0.4), body("crane", Vector3::Zero(), 1.0 + turn),
                body("load", turned({22.0, 1.0, -30.0}, 1.0), 0.0)};
    s.joints = {hinge("ring", "vessel", "crane", Vector3::Zero(), Vector3::UnitZ())};
    WireSpec wire;
    wire.name = "fall";
    wire.role = WireSpec::Role::hoist;
    wire.from = "crane";
    wire.to = "load";
    wire.point_from = turned({20.0, 0.0, 0.0}, -turn);
    wire.axial_stiffness = 1e8;
    wire.unstretched_length = 29.0;
    s.wires = {wire};
    const auto values = values_of(s);
    CHECK(values.at("fall.off_lead") == Approx(std::atan(2.0 / 30.0)).epsilon(1e-9));
    CHECK(values.at("fall.side_lead") == Approx(std::atan(1.0 / 30.0)).epsilon(1e-9));
  }
}

TEST_CASE("two cranes on two vessels each have their own plane and vessel", "[crane]") {
  Specification s = bare();
  add_crane(s, "a_", {0.0, 0.0, 0.0}, 0.2, 1.1, 1.0);
  add_crane(s, "b_", {0.0, 200.0, 0.0}, -1.4, -0.6, 0.8);
  s.operation.load = "a_load";
  CHECK(boom_bodies(s) == std::vector<std::string>{"a_boom", "b_boom"});
  CHECK(crane_vessels(s) == std::vector<std::string>{"a_vessel", "b_vessel"});
  s.operation.crane = "b_house";  // a body that stands on a vessel names that vessel
  CHECK(crane_vessels(s) == std::vector<std::string>{"b_vessel", "a_vessel"});
  CHECK(hoist_wires_of(s, "b_vessel") == std::vector<std::string>{"b_fall"});
  CHECK(hoist_wires_of(s, "a_boom") == std::vector<std::string>{"a_fall"});
  const auto values = values_of(s);
  for (const char* wire : {"a_fall", "b_fall"}) {
    CHECK(values.at(std::string(wire) + ".off_lead") == Approx(std::atan(2.0 / 30.0)).epsilon(1e-9));
    CHECK(values.at(std::string(wire) + ".side_lead") == Approx(std::atan(1.0 / 30.0)).epsilon(1e-9));
  }
}

TEST_CASE("the channels of a joint's drive are in rad or m, and their rates", "[crane][unit]") {
  Specification s = bare();
  add_crane(s, "", Vector3::Zero(), 0.0, 0.0, 1.0);
  s.operation.load = "load";
  s.drives = {{"slew", DriveSpec::Kind::joint, 0.0, 0.0}, {"trolley", DriveSpec::Kind::joint, 0.0, 0.0}};
  s.joints[0].drive = "slew";
  s.joints[0].stiffness = 1e9;
  s.bodies.push_back(body("cart", Vector3::Zero(), 0.0));
  s.joints.push_back(hinge("rail", "vessel", "cart", Vector3::Zero(), Vector3::UnitX()));
  s.joints.back().type = JointSpec::Type::prismatic;
  s.joints.back().drive = "trolley";
  s.joints.back().stiffness = 1e9;
  const Model model = build_model(s);
  const ChannelBoard board(model);
  const auto unit_of = [&](const char* channel) {
    return board.channels()[static_cast<std::size_t>(board.find(channel))].unit;
  };
  CHECK(unit_of("slew.position") == "rad");
  CHECK(unit_of("slew.rate") == "rad/s");
  CHECK(unit_of("trolley.position") == "m");
  CHECK(unit_of("trolley.rate") == "m/s");
  CHECK(drive_motion(s, {"b", DriveSpec::Kind::ballast, 0.0, 0.0}) == DriveMotion::share);
}
