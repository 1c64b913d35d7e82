// Hook load, radius and boom angle of cranes whose poses are written down.
#include "results/crane_readings.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "results/scene.h"
#include "sim/spatial/constants.h"

using namespace stillhook;

namespace {

/// A vessel with a slewing house and a luffing boom 50 m long, its hinge 3 m ahead of the axis, and a second such
/// vessel 200 m ahead if `tandem`. The house turns from 0 to 90 deg, the boom from 60 to 30 deg above the deck.
struct Cranes {
  Specification s;
  Trajectory run;

  explicit Cranes(bool tandem = false) {
    run.time = {0.0, 1.0, 2.0};
    add("a", 0.0, {1.0e6, 2.0e6, 3.0e6});
    if (tandem) add("b", 200.0, {5.0e5, 5.0e5, 5.0e5});
    s.operation.crane = "a";
    s.operation.load = "load";
    s.bodies.push_back({});
    s.bodies.back().name = "load";
  }

  void channel(const std::string& name, std::vector<double> values) {
    run.channels.push_back({name, "", ""});
    run.values.push_back(std::move(values));
  }

  void body(const std::string& name, double x, double z, std::vector<double> pitch, std::vector<double> yaw) {
    s.bodies.push_back({});
    s.bodies.back().name = name;
    const std::vector<double> none(3, 0.0);
    channel(name + ".x", std::vector<double>(3, x));
    channel(name + ".y", none);
    channel(name + ".z", std::vector<double>(3, z));
    channel(name + ".roll", none);
    channel(name + ".pitch", std::move(pitch));
    channel(name + ".yaw", std::move(yaw));
  }

  void add(const std::string& name, double x, std::vector<double> tension) {
    const std::vector<double> none(3, 0.0);
    body(name, x, 0.0, none, none);
    s.bodies.back().hull.shape = HullSpec::Shape::box;
    s.bodies.back().hull.size = {100.0, 30.0, 8.0};
    const std::vector<double> slew = {0.0, 45.0 * kDegree, 90.0 * kDegree};
    body(name + "_house", x, 10.0, none, slew);
    // Pitch is bow down positive: a boom that points 60 deg up has a pitch of -60 deg. Its hinge goes round with the
    // house.
    body(name + "_boom", x, 10.0, {-60.0 * kDegree, -45.0 * kDegree, -30.0 * kDegree}, slew);
    for (int i = 0; i < 3; ++i) {
      run.values[static_cast<std::size_t>(run.find(name + "_boom.x"))][i] = x + 3.0 * std::cos(slew[i]);
      run.values[static_cast<std::size_t>(run.find(name + "_boom.y"))][i] = 3.0 * std::sin(slew[i]);
    }
    JointSpec ring;
    ring.name = name + "_ring";
    ring.parent = name;
    ring.child = name + "_house";
    ring.point_on_parent = {0.0, 0.0, 10.0};
    ring.axis = Vector3::UnitZ();
    JointSpec hinge;
    hinge.name = name + "_hinge";
    hinge.parent = name + "_house";
    hinge.child = name + "_boom";
    hinge.point_on_parent = {3.0, 0.0, 0.0};
    s.joints.insert(s.joints.end(), {ring, hinge});
    WireSpec fall;
    fall.name = name + "_fall";
    fall.role = WireSpec::Role::hoist;
    fall.from = name + "_boom";
    fall.to = "load";
    fall.point_from = {50.0, 0.0, 0.0};
    s.wires.push_back(fall);
    channel(name + "_fall.tension", std::move(tension));
  }

  std::vector<double> reading(const std::string& label) const {
    const RunView view(s, run);
    for (const CraneReading& reading : crane_readings(view))
      if (reading.label == label) return reading.values;
    return {};
  }
};

}  // namespace

TEST_CASE("radius is measured from the slewing axis, the boom angle from the hinge, whatever the house's heading") {
  const Cranes cranes;
  const std::vector<double> radius = cranes.reading("radius"), angle = cranes.reading("boom angle"),
                            load = cranes.reading("hook load");
  REQUIRE(radius.size() == 3);
  REQUIRE(angle.size() == 3);
  const double elevation[] = {60.0, 45.0, 30.0};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(radius[i] == Approx(3.0 + 50.0 * std::cos(elevation[i] * kDegree)));
    CHECK(angle[i] == Approx(elevation[i]));
    CHECK(load[i] == Approx((1.0 + static_cast<double>(i)) * 1e6 / 9806.65));
  }
}

TEST_CASE("two vessels are two cranes, each with its own hook load, and both are painted as cranes") {
  const Cranes cranes(true);
  CHECK(cranes.reading("hook load")[2] == Approx(3.5e6 / 9806.65));
  CHECK(cranes.reading("hook load a")[2] == Approx(3.0e6 / 9806.65));
  CHECK(cranes.reading("hook load b")[2] == Approx(0.5e6 / 9806.65));
  CHECK(cranes.reading("radius b")[0] == Approx(28.0));  // 3 m and 50 m cos 60 deg: its place does not matter
  const Scene scene = build_scene(cranes.s, cranes.run);
  for (const SceneBody& body : scene.bodies)
    if (body.name == "a" || body.name == "b") CHECK(body.kind == SceneBody::Kind::crane);
}

TEST_CASE("a slewing ring above the deck stands on a pedestal that reaches down to it") {
  const Scene scene = build_scene(Cranes().s, Cranes().run);
  REQUIRE(scene.bodies[0].pedestals.size() == 1);
  const SceneBody::Member& pedestal = scene.bodies[0].pedestals[0];
  CHECK(pedestal.from.z() == Approx(4.0));  // the box of 8 m about the origin
  CHECK(pedestal.to == Vector3(0.0, 0.0, 10.0));
  CHECK(scene.bodies[1].pedestals.empty());  // the house has no deck to stand on
}

TEST_CASE("a ring outside the hull, or on its deck, has no pedestal") {
  Cranes cranes;
  cranes.s.joints[0].point_on_parent = {60.0, 0.0, 10.0};
  CHECK(build_scene(cranes.s, cranes.run).bodies[0].pedestals.empty());
  cranes.s.joints[0].point_on_parent = {0.0, 0.0, 4.2};
  CHECK(build_scene(cranes.s, cranes.run).bodies[0].pedestals.empty());
}
