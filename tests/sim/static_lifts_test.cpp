// Static poses of whole lifts against calculations by hand: where they start, how they move, and that they are stable.
#include <catch2/catch.hpp>

#include "tests/sim/lift_parts.h"
#include "tests/truth/hinged_chain.h"

using namespace stillhook;

namespace {

constexpr double kG = 9.80665;  // m/s2, the default gravity of a case

double value(const StaticPose& pose, const std::string& channel) { return pose.values.at(channel); }

// A 60 t load under a fixed point, 28 m of wire.
LiftParts hanging(double slack) {
  LiftParts lift;
  lift.winch("hoist");
  lift.body("load", 6e4, Vector3(0, 0, 10));
  lift.wire("fall", "world", Vector3(0, 0, 40), "load", Vector3(0, 0, 2), 1e8, "hoist").slack = slack;
  return lift;
}

}  // namespace

TEST_CASE("statics: the wire that a load hangs on has the length of the given pose", "[statics]") {
  for (const double slack : {0.0, 0.1, -0.1, 3.0}) {
    CAPTURE(slack);
    const Model model = build_model(hanging(slack).spec);
    const double length = 28.0 + slack, stretched = length * (1.0 + 6e4 * kG / 1e8);
    CHECK(model.initial_lengths()[0] == Approx(length).margin(1e-12));
    // 1e-9 of the weight on 3.6 MN/m
    CHECK(model.initial_state().body[0].p_WC.z() == Approx(38.0 - stretched).margin(1e-8));
    CHECK(model.warnings().size() == (slack > 1.0 ? 1u : 0u));
  }
}

TEST_CASE("statics: a start pose away from the given one is told with the distance and the cause", "[statics]") {
  LiftParts lift = hanging(0.0);
  lift.spec.wires[0].unstretched_length = 31.0;
  const Model model = build_model(lift.spec);
  REQUIRE(model.warnings().size() == 1);
  // 31 m and 588.4 kN on 1e5 kN: 3.182 m below the given pose.
  CHECK_THAT(model.warnings()[0], Catch::Contains("bodies.load") && Catch::Contains("3.182 m") &&
                                      Catch::Contains("'fall'") && Catch::Contains("28 m apart"));
}

TEST_CASE("statics: a load near a deck hangs above it, a load on it stands", "[statics]") {
  for (const double above : {0.2, 5.0}) {
    LiftParts lift = hanging(0.0);
    lift.feet("load", 2.0, 2.0, "world", Vector3(0, 0, 8.0 - above), 1e8);
    const Model model = build_model(lift.spec);
    CAPTURE(above);
    CHECK(model.initial_state().body[0].p_WC.z() == Approx(38.0 - 28.0 * (1.0 + 6e4 * kG / 1e8)).margin(1e-8));
  }
  LiftParts lift = hanging(0.0);
  lift.feet("load", 2.0, 2.0, "world", Vector3(0, 0, 8.0), 1e8);
  const Model model = build_model(lift.spec);
  const double penetration = 6e4 * kG / 1e8;
  CHECK(model.initial_state().body[0].p_WC.z() == Approx(10.0 - penetration).margin(1e-8));
  CHECK(model.initial_lengths()[0] == Approx(28.0 + penetration).margin(1e-8));  // just taut over the load as it stands
}

TEST_CASE("statics: slings over a load that stands hang from a block that hangs", "[statics]") {
  LiftParts lift;
  lift.winch("hoist");
  lift.body("block", 5e3, Vector3(0, 0, 20), 0.5);
  lift.body("load", 6e4, Vector3(0, 0, 10), 2.0);
  lift.wire("fall", "world", Vector3(0, 0, 40), "block", Vector3(0, 0, 0.5), 1e8, "hoist");
  for (const double x : {-3.0, 3.0})
    for (const double y : {-2.0, 2.0})
      lift.wire(std::string("sling") + (x < 0 ? "_aft" : "_fore") + (y < 0 ? "_starboard" : "_port"), "block",
                Vector3(0, 0, -0.5), "load", Vector3(x, y, 2.0), 5e7)
          .slack = 0.02;
  lift.feet("load", 3.0, 2.0, "world", Vector3(0, 0, 8.0), 1e8);
  lift.travel("up", "hoist", 3.0);
  const Model model = build_model(lift.spec);
  const Operation operation = build_operation(model);
  const StaticPose &start = operation.static_poses[0], &up = operation.static_poses[1];
  CHECK(value(start, "fall.tension") == Approx(5e3 * kG).epsilon(1e-6));
  CHECK(value(start, "load.z") == Approx(10.0 - 6e4 * kG / 1e8).margin(1e-7));
  CHECK(value(start, "sling_fore_port.tension") == 0.0);
  // Hung up: each of the four carries a quarter of the weight over the cosine of its angle as it hangs.
  const double l = value(up, "sling_fore_port.length"), across = std::hypot(3.0, 2.0);
  const double cosine = std::sqrt(1.0 - across * across / (l * l));
  for (const char* sling : {"sling_fore_port", "sling_fore_starboard", "sling_aft_port", "sling_aft_starboard"})
    CHECK(value(up, std::string(sling) + ".tension") == Approx(6e4 * kG / (4.0 * cosine)).epsilon(1e-6));
  CHECK(value(up, "fall.tension") == Approx(6.5e4 * kG).epsilon(1e-6));
  CHECK(relaxation_confirms(model, operation.equilibria[1], 0.05, 1e-4));
}

TEST_CASE("statics: twelve slings carry a load together, also with one 3 cm too long", "[statics]") {
  for (const double longer : {0.0, 0.03}) {
    LiftParts lift;
    lift.winch("hoist");
    lift.body("block", 1e4, Vector3(0, 0, 30), 0.6);
    lift.body("load", 1.2e6, Vector3(0, 0, 12), 6.0);
    lift.wire("fall", "world", Vector3(0, 0, 60), "block", Vector3(0, 0, 0.5), 2e9, "hoist");
    for (int i = 0; i < 12; ++i) {
      const double a = i * M_PI / 6.0;
      lift.wire("sling_" + std::to_string(i), "block", Vector3(0, 0, -0.5), "load",
                Vector3(8.0 * std::cos(a), 8.0 * std::sin(a), 3.0), 4e8)
          .slack = i == 0 ? longer : 0.0;
    }
    const Model model = build_model(lift.spec);
    const StaticPose start = static_pose(model, model.initial_state(), "start");
    CAPTURE(longer);
    // The vertical parts of the tensions carry the load, the rest is in balance.
    Vector3 sum = Vector3::Zero();
    for (int i = 0; i < 12; ++i) {
      const std::string name = "sling_" + std::to_string(i);
      const Vector3 upper = start.bodies[0] * lift.spec.wires[i + 1].point_from;
      const Vector3 lower = start.bodies[1] * lift.spec.wires[i + 1].point_to;
      sum += value(start, name + ".tension") * (upper - lower).normalized();
    }
    CHECK(sum.z() == Approx(1.2e6 * kG).epsilon(1e-7));
    CHECK(sum.head<2>().norm() < 1e-7 * sum.z());
    if (longer == 0.0) {  // 14.5 m under the block's point, 8 m out; the stretch changes the angle by 1e-3 of it
      const double cosine = 14.5 / std::hypot(14.5, 8.0);
      CHECK(value(start, "sling_7.tension") == Approx(1.2e6 * kG / (12.0 * cosine)).epsilon(3e-3));
    } else {
      CHECK(value(start, "sling_0.tension") < value(start, "sling_6.tension"));
    }
    CHECK(relaxation_confirms(model, model.initial_state(), 0.05, 1e-3));
  }
}

TEST_CASE("statics: a load is lowered by 180 to 2,950 m on one wire, by travels and by goals", "[statics]") {
  for (const double depth : {180.0, 200.0, 400.0, 795.0, 2950.0}) {
    LiftParts lift = hanging(0.0);
    const double share = 6e4 * kG / 1e8;  // stretch of the wire per length
    lift.travel("lower", "hoist", -depth);
    lift.goal("raise", "hoist", height_of("load"), 5.0);
    lift.goal("lower_again", "hoist", height_of("load"), 10.0 - depth);
    const Model model = build_model(lift.spec);
    const Operation operation = build_operation(model);
    CAPTURE(depth);
    const auto z = [&](int i) { return value(operation.static_poses[i], "load.z"); };
    CHECK(z(1) == Approx(38.0 - (28.0 + depth) * (1.0 + share)).margin(1e-6));
    CHECK(z(2) == Approx(5.0).margin(1e-9));
    CHECK(z(3) == Approx(10.0 - depth).margin(1e-9));
    CHECK(operation.equilibria[3].drive[0].position == Approx(28.0 - (28.0 + depth) / (1.0 + share)).margin(1e-6));
    for (int i = 1; i < 4; ++i) CHECK(relaxation_confirms(model, operation.equilibria[i], 0.2, 1e-3));
  }
}

TEST_CASE("statics: goals of tension are met while a load lands on a moored barge", "[statics]") {
  LiftParts lift;
  lift.winch("hoist");
  lift.barge("barge", 2.0e6, Vector3(50, 20, 5), 1.0);
  lift.moor("barge", 1e5);
  lift.body("load", 2e5, Vector3(2, 1, 20), 3.0);
  lift.wire("fall", "world", Vector3(2, 1, 90), "load", Vector3(0, 0, 2), 4e9, "hoist");
  lift.feet("load", 4.0, 3.0, "barge", Vector3(0, 0, 2.5), 5e8);
  lift.goal("half", "hoist", tension_of("fall"), 1e6);
  lift.goal("more", "hoist", tension_of("fall"), 1.5e6);
  lift.goal("little", "hoist", tension_of("fall"), 1e4);
  lift.travel("off", "hoist", -2.0);
  const Model model = build_model(lift.spec);
  const Operation operation = build_operation(model);
  const double wanted[] = {2e5 * kG, 1e6, 1.5e6, 1e4, 0.0};
  for (int i = 0; i < 5; ++i) {
    CAPTURE(i);
    // What rounding may leave: 1 N, or 1e-6 of the goal.
    CHECK(value(operation.static_poses[i], "fall.tension") == Approx(wanted[i]).margin(1.0).epsilon(1e-6));
    // The water carries what the wire does not: barge and share of the load, 1.025 t/m3 on 50 x 20 m, lines aside.
    CHECK(relaxation_confirms(model, operation.equilibria[i], 0.02, 0.05));
  }
}

TEST_CASE("statics: a goal out of reach is refused in the units of a case", "[statics]") {
  LiftParts lift = hanging(0.0);
  lift.goal("too_much", "hoist", tension_of("fall"), 1e6);
  const Model model = build_model(lift.spec);
  CHECK_THROWS_WITH(build_operation(model), Catch::Contains("tension of wire 'fall' to 1000 kN") &&
                                                Catch::Contains("the nearest found is 588.399 kN"));
}

TEST_CASE("statics: what nothing holds is refused by its name and the way it goes", "[statics]") {
  LiftParts lift = hanging(0.0);
  lift.body("stone", 100.0, Vector3(5, 0, 0), 0.1);
  CHECK_THROWS_WITH(build_model(lift.spec), Catch::Contains("'stone' in -z goes on moving"));
}

TEST_CASE("statics: a load that stands beside its surface is refused with the points and the distance", "[statics]") {
  // Feet 2 m to either side on a deck of 3.5 m by 20 m: all four stand 0.25 m beside it.
  LiftParts lift;
  lift.body("load", 6e4, Vector3(0, 0, 10));
  lift.feet("load", 2.0, 2.0, "world", Vector3(0, 0, 8.0), 1e8);
  CHECK_NOTHROW(build_model(lift.spec));
  lift.spec.contacts[0].surface_length = 3.5;
  CHECK_THROWS_WITH(build_model(lift.spec), Catch::Contains("'load' in -z goes on moving") &&
                                                Catch::Contains("4 lie lower than its surface and beside its edges") &&
                                                Catch::Contains("by 0.25 m"));
}

TEST_CASE("statics: a chain of fifteen hinges from a straight start sags as a catenary of bars", "[statics]") {
  truth::HingedChain truth{15, 2.0, 500.0 * kG, 4.0, 1e9, 0.0};
  truth.span = 15 * 2.0 + 1.5;
  LiftParts lift;
  lift.winch("haul");
  for (int i = 0; i < 15; ++i) {
    BodySpec& b = lift.body("bar_" + std::to_string(i), 500.0, Vector3(2.0 * i, 0, 50));
    b.cog = Vector3(1, 0, 0);
    b.inertia = 500.0 * Vector3(0.01, 1.0 / 3.0, 1.0 / 3.0).asDiagonal();
    JointSpec j;
    j.name = "hinge_" + std::to_string(i);
    j.type = JointSpec::Type::revolute;
    j.parent = i == 0 ? "world" : "bar_" + std::to_string(i - 1);
    j.child = b.name;
    j.point_on_parent = i == 0 ? Vector3(0, 0, 50) : Vector3(2, 0, 0);
    lift.spec.joints.push_back(j);
  }
  lift.wire("line", "world", Vector3(truth.span, 0, 50), "bar_14", Vector3(2, 0, 0), 1e9, "haul").slack = 2.5;
  lift.travel("slacken", "haul", -1.0);
  lift.travel("haul_in", "haul", 1.5);
  const Model model = build_model(lift.spec);
  const Operation operation = build_operation(model);
  const double lengths[] = {4.0, 5.0, 3.5};
  for (int i = 0; i < 3; ++i) {
    truth.line_length = lengths[i];
    CAPTURE(i, truth.tension());
    CHECK(value(operation.static_poses[i], "line.tension") == Approx(truth.tension()).epsilon(1e-6));
  }
}

TEST_CASE("statics: a barge that is top-heavy lists to its angle of loll", "[statics]") {
  // A wall-sided hull upright with GM < 0 comes to rest where tan^2 phi = -2 GM / BM, exactly while deck and bilge keep
  // out of the water plane. (Barrass & Derrett, Ship Stability for Masters and Mates, ch. on angle of loll.)
  LiftParts lift;
  const double L = 60.0, B = 16.0, D = 10.0, draft = 4.0, mass = 1025.0 * L * B * draft;
  const double BM = B * B / (12.0 * draft), KB = 0.5 * draft, GM = -0.12, KG = KB + BM - GM;
  lift.barge("barge", mass, Vector3(L, B, D), KG - 0.5 * D);
  lift.moor("barge", 1e3);
  for (MooringSpec& m : lift.spec.moorings) m.pretension = 1.0;
  const Model model = build_model(lift.spec);
  const double tilt = std::abs(roll_pitch_yaw(model.initial_state().body[0].R_WB).roll);
  // The list draws the fairleads 7.07 (1 - cos phi) = 0.154 m in from the sides, so each pair of lines pulls outward with
  // 2 cos^2(45 deg) 1e3 N/m 0.154 m = 0.15 kN, 1.46 m above or below the middle: together 0.45 kN m against the list. The
  // hull's stiffness there is -2 GM W = 9.3 MN m/rad: 5e-5 rad, 2.3e-4 of the angle. The hull is integrated exactly.
  CHECK(std::tan(tilt) == Approx(std::sqrt(-2.0 * GM / BM)).epsilon(4e-4));
  REQUIRE(model.warnings().size() == 1);
  CHECK_THAT(model.warnings()[0], Catch::Contains("bodies.barge") && Catch::Contains("deg"));
}

TEST_CASE("statics: a run may start from its static pose with a velocity", "[statics]") {
  LiftParts lift = hanging(0.0);
  lift.spec.bodies[0].velocity = Vector3(0.5, 0, 0);
  lift.spec.bodies[0].angular_velocity = Vector3(0, 0, 0.1);
  const Model model = build_model(lift.spec);
  const BodyKinematics& b = model.initial_state().body[0];
  CHECK(b.p_WC.z() == Approx(38.0 - 28.0 * (1.0 + 6e4 * kG / 1e8)).margin(1e-8));
  CHECK(b.v_WC == Vector3(0.5, 0, 0));
  CHECK(b.w_B == Vector3(0, 0, 0.1));
}

TEST_CASE("statics: a body clamped to the world is in equilibrium", "[statics]") {
  LiftParts lift;
  lift.body("float", 1e3, Vector3(0, 0, 0));
  JointSpec clamp;
  clamp.name = "clamp";
  clamp.type = JointSpec::Type::fixed;
  clamp.parent = "world";
  clamp.child = "float";
  lift.spec.joints.push_back(clamp);
  const Model model = build_model(lift.spec);
  CHECK(model.initial_state().body[0].p_WC.norm() < 1e-10);  // joints are closed to that
  Vector3 force, moment;
  model.system().joint_reaction(model.initial_state(), 0, force, moment);
  CHECK((force - Vector3(0, 0, 1e3 * kG)).norm() < 1e-4);  // 1e-9 of the weight, tenfold
}
