// Slings between a hook and a load: closed forms of how they share the weight.
#include "sim/lifting/rigging.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

namespace stillhook {
namespace {

using Catch::Matchers::Contains;

constexpr double kDegree = std::numbers::pi / 180.0, kG = 9.80665;

Specification load_of(double mass, const Vector3& cog = Vector3::Zero()) {
  Specification spec;
  spec.name = "lift";
  BodySpec load;
  load.name = "load";
  load.mass = mass;
  load.cog = cog;
  load.position = Vector3(5.0, 3.0, 10.0);
  load.attitude.yaw = 0.4;
  load.inertia = mass * Vector3(20.0, 20.0, 30.0).asDiagonal();
  spec.bodies.push_back(load);
  return spec;
}

/// Four slings of 12 m to the corners of 8 m by 6 m, 2 m above the load's origin.
RiggingSpec four_slings(double EA) {
  RiggingSpec r;
  r.name = "hook";
  r.load = "load";
  r.mass = 20e3;
  r.hook = Vector3(0.0, 0.0, -0.7);
  const double x[4] = {4.0, -4.0, -4.0, 4.0}, y[4] = {3.0, 3.0, -3.0, -3.0};
  for (int i = 0; i < 4; ++i) {
    SlingSpec s;
    s.name = "s" + std::to_string(i + 1);
    s.to = Vector3(x[i], y[i], 2.0);
    s.length = 12.0;
    s.axial_stiffness = EA;
    r.slings.push_back(s);
  }
  return r;
}

double kilonewtons(const RiggingPose& pose, int i) { return pose.slings[static_cast<std::size_t>(i)].tension / 1e3; }

}  // namespace

TEST_CASE("four equal slings share the weight by their angle", "[rigging]") {
  const Specification spec = load_of(300e3);
  const RiggingPose pose = rigging_pose(four_slings(300e6), spec, 1.0, RiggingLoad::held);
  CHECK(pose.hook.x() == Approx(5.0).margin(1e-9));
  CHECK(pose.hook.y() == Approx(3.0).margin(1e-9));
  for (const auto& s : pose.slings) {
    CHECK(4.0 * s.tension * std::sin(s.angle) == Approx(300e3 * kG).epsilon(1e-9));
    CHECK(s.distance == Approx(12.0 * (1.0 + s.tension / 300e6)).epsilon(1e-9));
    CHECK(std::cos(s.angle) * s.distance == Approx(5.0).epsilon(1e-9));
  }
}

TEST_CASE("an error of length stresses four slings by EA e/(4 l)", "[rigging]") {
  // 20 mm of 12 m, EA 300 MN: 125 kN, two slings up and two down. 2 %: the stretch of 0.3 % and the load's turn by a
  // tenth of a degree.
  const Specification spec = load_of(300e3);
  RiggingSpec rigging = four_slings(300e6);
  const RiggingPose even = rigging_pose(rigging, spec, 1.0, RiggingLoad::turns);
  rigging.slings[0].length_error = -0.02;
  const RiggingPose uneven = rigging_pose(rigging, spec, 1.0, RiggingLoad::turns);
  const double sign[4] = {1.0, -1.0, 1.0, -1.0};
  for (int i = 0; i < 4; ++i)
    CHECK(kilonewtons(uneven, i) - kilonewtons(even, i) == Approx(125.0 * sign[i]).epsilon(0.02));
  // An error as long as the stretch under the weight: a quarter more in the pair.
  rigging.slings[0].length_error = -12.0 * even.slings[0].tension / 300e6;
  const RiggingPose skew = rigging_pose(rigging, spec, 1.0, RiggingLoad::turns);
  CHECK(kilonewtons(skew, 0) / kilonewtons(even, 0) == Approx(1.25).epsilon(0.01));
  CHECK(kilonewtons(skew, 2) / kilonewtons(even, 2) == Approx(1.25).epsilon(0.01));
  CHECK(kilonewtons(skew, 1) / kilonewtons(even, 1) == Approx(0.75).epsilon(0.01));
}

TEST_CASE("a load with its centre of gravity off the middle turns until the hook is above it", "[rigging]") {
  // Slings so stiff that the hook stays where they meet: H = 2 + sqrt(12^2 - 5^2) above the load's origin.
  const Specification spec = load_of(300e3, Vector3(0.8, 0.0, 0.0));
  const RiggingPose pose = rigging_pose(four_slings(3e11), spec, 1.0, RiggingLoad::turns);
  const double H = 2.0 + std::sqrt(144.0 - 25.0);
  const Vector3 centre = pose.load * Vector3(0.8, 0.0, 0.0);
  CHECK((pose.hook - centre).head<2>().norm() < 1e-4);
  CHECK(roll_pitch_yaw(pose.load.R).pitch == Approx(std::atan(0.8 / H)).epsilon(1e-3));
  CHECK(std::abs(roll_pitch_yaw(pose.load.R).roll) < 1e-5);
  // Held in its pose the hook goes to where the slings let it: forces balance, moments do not.
  const RiggingPose held = rigging_pose(four_slings(3e11), spec, 1.0, RiggingLoad::held);
  CHECK((held.hook - Vector3(5.0, 3.0, 10.0 + H)).norm() < 1e-3);
}

TEST_CASE("a spreader takes the slings' pull inwards, and its weight hangs in the upper ones alone", "[rigging]") {
  const Specification spec = load_of(300e3);
  RiggingSpec rigging = four_slings(300e6);
  rigging.spreader.name = "frame";
  rigging.spreader.mass = 10e3;
  rigging.spreader.size = Vector3(8.0, 6.0, 0.5);
  for (SlingSpec& s : rigging.slings) {
    s.from = Vector3(s.to.x(), s.to.y(), 0.0);
    s.length = 5.0;
    SlingSpec upper = s;
    upper.name = "upper_" + s.name;
    upper.to = s.from;
    upper.length = 9.0;
    rigging.spreader.slings.push_back(upper);
  }
  const RiggingPose pose = rigging_pose(rigging, spec, 1.0, RiggingLoad::turns);
  REQUIRE(pose.slings.size() == 8);
  for (int i = 0; i < 4; ++i) {
    const auto &upper = pose.slings[static_cast<std::size_t>(i)], &lower = pose.slings[static_cast<std::size_t>(i) + 4];
    CHECK(lower.tension == Approx(300e3 * kG / 4.0).epsilon(1e-6));
    CHECK(lower.angle == Approx(90.0 * kDegree).margin(1e-4));
    CHECK(4.0 * upper.tension * std::sin(upper.angle) == Approx(310e3 * kG).epsilon(1e-6));
  }
}

TEST_CASE("block and slings stand where they are straight over a load that stands, else where they carry it",
          "[rigging]") {
  Specification spec = load_of(300e3);
  const RiggingSpec rigging = four_slings(300e6);
  add_rigging(rigging, spec);
  REQUIRE(spec.bodies.size() == 2);
  REQUIRE(spec.wires.size() == 4);
  const double carrying = spec.bodies[1].position.z();
  CHECK(spec.bodies[1].mass == 20e3);
  CHECK(spec.wires[0].from == "hook");
  CHECK(spec.wires[0].point_from == rigging.hook);
  CHECK(spec.wires[0].to == "load");
  CHECK(spec.wires[0].unstretched_length == 12.0);
  // Box of 1 by 1 by 1.5 m.
  CHECK(spec.bodies[1].inertia(0, 0) == Approx(20e3 * (1.0 + 2.25) / 12.0));
  CHECK(spec.bodies[1].inertia(2, 2) == Approx(20e3 * 2.0 / 12.0));

  Specification standing = load_of(300e3);
  ContactSpec deck;
  deck.name = "deck";
  deck.body = "load";
  deck.role = ContactSpec::Role::pickup;
  standing.contacts.push_back(deck);
  CHECK(load_stands(rigging, standing));
  add_rigging(rigging, standing);
  const double straight = standing.bodies[1].position.z();
  CHECK(straight == Approx(10.0 + 2.0 + std::sqrt(144.0 - 25.0) + 0.7).margin(1e-3));
  CHECK(carrying - straight == Approx(0.035).margin(0.002));  // 12 m 0.27 % over the sine of the angle
}

TEST_CASE("a load that is not there is refused by the name of the rigging", "[rigging]") {
  RiggingSpec rigging = four_slings(300e6);
  rigging.load = "topside";
  CHECK_THROWS_WITH(rigging_pose(rigging, load_of(300e3), 1.0, RiggingLoad::held),
                    Contains("rigging.hook") && Contains("topside"));
}

}  // namespace stillhook
