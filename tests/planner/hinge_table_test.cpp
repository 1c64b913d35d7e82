// The table of hinged bodies against hand calculation.
#include "planner/verbs/check/hinge_table.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "sim/model.h"
#include "sim/spatial/constants.h"

using namespace stillhook;

namespace {

BodySpec heavy(const std::string& name, const RollPitchYaw& attitude) {
  BodySpec b;
  b.name = name;
  b.mass = 1e5;
  b.inertia = 1e6 * Matrix3::Identity();
  b.attitude = attitude;
  return b;
}

JointSpec pin(const std::string& parent, const std::string& child, const Vector3& axis) {
  JointSpec j;
  j.name = child + "_pin";
  j.parent = parent;
  j.child = child;
  j.axis = axis;
  return j;
}

}  // namespace

TEST_CASE("hinged bodies: slewing is a heading, luffing an elevation, on any vessel heading", "[tables]") {
  for (const double heading : {0.0, 2.0}) {
    Specification s;
    s.sea.active = "calm";
    s.sea.states = {SeaStateSpec{}};
    s.sea.states[0].name = "calm";
    s.solver.static_start = false;
    // A house that points aft, a boom raised by 60 deg on it, a backstay on the vessel that leans 20 deg aft.
    s.bodies = {heavy("vessel", {0.0, 0.0, heading}), heavy("house", {0.0, 0.0, heading + kTwoPi / 2.0}),
                heavy("boom", {0.0, -60.0 * kDegree, heading + kTwoPi / 2.0}),
                heavy("backstay", {0.0, -110.0 * kDegree, heading})};
    s.joints = {pin("vessel", "house", Vector3::UnitZ()), pin("house", "boom", {0.0, -1.0, 0.0}),
                pin("vessel", "backstay", {0.0, -1.0, 0.0})};
    const Model model = build_model(s);
    StaticPose start;
    start.name = "start";
    for (const BodySpec& body : s.bodies) start.bodies.push_back({rotation_from(body.attitude), body.position});
    StaticPose slewed = start;  // by -90 deg, boom and all
    slewed.name = "slewed";
    for (const std::size_t i : {1u, 2u}) slewed.bodies[i].R = rotation_from({0.0, 0.0, -90.0 * kDegree}) * start.bodies[i].R;
    const ReportTable table = hinge_table(model, {start, slewed});
    CHECK(table.header == std::vector<std::string>{"pose", "house, heading", "boom", "backstay"});
    CHECK(std::abs(std::stod(table.rows[0][1])) == Approx(180.0));
    CHECK(std::stod(table.rows[1][1]) == Approx(90.0));
    for (const auto& row : table.rows) {
      CHECK(std::stod(row[2]) == Approx(60.0));
      CHECK(std::stod(row[3]) == Approx(110.0));
    }
  }
}
