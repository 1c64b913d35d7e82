// The reference lift at rest against the table of the reference data set: two independent calculations of the statics
// that agree to its last digit but one. Lengths are geometric (stretched), tensions per side in t.
#include "sim/body_spec.h"

#include <catch2/catch.hpp>

#include "sim/hull/hydrostatics.h"
#include "sim/hull/immersion.h"
#include "tests/validation/reference_lift.h"

using namespace stillhook;

namespace {

constexpr double kTonne = 9806.65;  // N

const ReferenceLift& lift() {
  static const ReferenceLift l;
  return l;
}

struct Row {
  const char* pose;
  double boom, backstay, x, z, trim, luffing, stay, luffing_t, stay_t;
};

// The angles are those of the table; what they lead to is calculated.
constexpr Row kTable[] = {
    {"before_the_lift", 75.10, 110.00, 74.00, 106.47, 0.0, 71.15, 92.59, 183, 113},
    {"even_keel_unloaded_a_hanging", 75.10, 110.00, 75.57, 105.17, 0.850, 71.15, 92.59, 545, 425},
    {"even_keel_unloaded_b_backstays", 80.28, 115.18, 66.00, 107.53, 0.674, 71.15, 88.29, 362, 255},
    {"even_keel_unloaded_c_booms", 73.61, 115.18, 78.25, 104.34, 0.885, 76.08, 88.29, 550, 453},
    {"level_when_loaded_a_hanging", 75.10, 110.00, 74.00, 106.28, 0.0, 71.15, 92.59, 516, 399},
    {"level_when_loaded_b_backstays", 79.42, 114.32, 66.00, 108.19, -0.147, 71.15, 89.00, 364, 256},
    {"level_when_loaded_c_booms", 72.75, 114.32, 78.25, 105.00, 0.064, 76.08, 89.00, 551, 455},
};

struct Stability {
  double transverse, longitudinal;
};

// The hanging load counts at the tips. Moorings carry some 60 t and are left out, as in the reference.
Stability metacentric(const StaticPose& p, bool loaded) {
  const MultibodySystem& system = lift().model.system();
  const BodySpec& crane = lift().model.specification().bodies[lift().model.body_index("crane")];
  double mass = 0.0;
  Vector3 moment = Vector3::Zero();
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const RigidBody& b = system.bodies[i];
    if (b.name == "barge" || (b.name == "load" && !loaded)) continue;
    mass += b.mass;
    moment += b.mass * (b.name == "load" ? Vector3(lift().tip(p).x(), 0.0, lift().tip(p).z()) : p.bodies[i] * b.cog);
  }
  const HydrostaticSummary hull = immersion_of(build_hull_mesh(crane.hull), lift().body(p, "crane"));
  const MetacentricHeights GM = metacentric_heights(hull, mass, moment / mass, 1025.0);
  return {GM.transverse, GM.longitudinal};
}

}  // namespace

TEST_CASE("reference lift: angles, tips, trim, wires and tensions of both ballast policies") {
  for (const Row& row : kTable) {
    const StaticPose& p = lift().pose(row.pose);
    CAPTURE(row.pose, lift().tip_x(p), lift().tip(p).z(), lift().trim_deg(p));
    const auto value = [&](const char* name) { return p.values.at(name); };
    // The case holds the table's angles, which are rounded to 0.01 deg.
    CHECK(lift().angle_deg(p, "boom_port") == Approx(row.boom).margin(0.02));
    CHECK(lift().angle_deg(p, "backstay_port") == Approx(row.backstay).margin(0.02));
    // 0.01 deg of boom is 0.018 m at the tip, and the moorings, which the table leaves out, sink the crane 2 mm.
    CHECK(lift().tip_x(p) == Approx(row.x).margin(0.05));
    CHECK(lift().tip(p).z() == Approx(row.z).margin(0.05));
    CHECK(lift().trim_deg(p) == Approx(row.trim).margin(0.02));
    for (const std::string side : {"port", "starboard"}) {
      CHECK(p.values.at("luffing_" + side + ".length") == Approx(row.luffing).margin(0.05));
      CHECK(p.values.at("stay_" + side + ".length") == Approx(row.stay).margin(0.05));
      // 1 %, or half the last digit printed where that is more.
      CHECK(p.values.at("luffing_" + side + ".tension") / kTonne ==
            Approx(row.luffing_t).margin(std::max(0.5, 0.01 * row.luffing_t)));
      CHECK(p.values.at("stay_" + side + ".tension") / kTonne ==
            Approx(row.stay_t).margin(std::max(0.51, 0.01 * row.stay_t)));
    }
    // Half of 1,000 t hangs on each side: exact.
    if (row.pose != std::string("before_the_lift"))
      CHECK(value("hoist_port.tension") == Approx(500.0 * kTonne).epsilon(1e-6));
  }
}

TEST_CASE(
    "reference lift: the tip closes over the hinge, x = 47 + 105 cos th, z = 5 + 105 sin th, turned by the trim") {
  for (const Row& row : kTable) {
    CAPTURE(row.pose);
    const StaticPose& p = lift().pose(row.pose);
    const double th = lift().angle_deg(p, "boom_port") * M_PI / 180.0;
    const Vector3 in_crane(47.0 + 105.0 * std::cos(th), 15.0, 5.0 + 105.0 * std::sin(th));
    // Joints hold to 1e-10 m.
    CHECK((lift().body(p, "crane") * in_crane - lift().tip(p)).norm() < 1e-8);
  }
}

TEST_CASE("reference lift: what 1,000 t does to crane and barge") {
  const StaticPose& before = lift().pose("before_the_lift");
  const StaticPose& hanging = lift().pose("even_keel_unloaded_a_hanging");
  const auto z = [&](const StaticPose& p, const char* body) { return lift().body(p, body).p.z(); };
  // 1000 / (1.025 * 110 * 46); the change of the mooring lines' weight is 1 % of it.
  CHECK(z(before, "crane") - z(hanging, "crane") == Approx(0.193).margin(0.002));
  CHECK(z(hanging, "barge") - z(before, "barge") == Approx(0.486).margin(0.002));
  CHECK(lift().tip_x(hanging) - lift().tip_x(before) == Approx(1.57).margin(0.02));
  CHECK(lift().tip(before).z() - lift().tip(hanging).z() == Approx(1.30).margin(0.02));

  const Stability unloaded = metacentric(before, false), loaded = metacentric(hanging, true);
  CHECK(unloaded.transverse == Approx(37.54).epsilon(0.005));
  CHECK(loaded.transverse == Approx(30.92).epsilon(0.005));
  CHECK(unloaded.longitudinal == Approx(245.5).epsilon(0.005));
  CHECK(loaded.longitudinal == Approx(229.4).epsilon(0.005));
}

TEST_CASE("reference lift: with the unstretched lengths of the pre-lift pose the hanging load stretches the wires") {
  const StaticPose& a = lift().pose("elastic_a_hanging");
  CHECK(lift().tip_x(a) == Approx(76.03).margin(0.05));
  CHECK(lift().tip_x(lift().pose("elastic_b_backstays")) == Approx(66.23).margin(0.05));
  CHECK(lift().tip_x(lift().pose("elastic_c_booms")) == Approx(78.73).margin(0.05));
  CHECK(lift().trim_deg(a) == Approx(0.858).margin(0.01));
  CHECK(a.values.at("luffing_port.tension") / kTonne == Approx(553).epsilon(0.01));
  CHECK(a.values.at("stay_port.tension") / kTonne == Approx(433).epsilon(0.01));

  // Take-up: wire hauled in from just taut until the load's bottom is level with the deck that has risen under it. The
  // reference counts barge, tip and stretch, 0.486 + 1.44 + 0.136 m; here the load also comes out of the grillage that
  // it had pressed in, W/k = 0.049 m.
  SystemState s = lift().state(a);
  StaticGoal goal;
  goal.drive = lift().drive("hoist");
  goal.coordinate.body = "load";
  goal.coordinate.point = Vector3(0.0, 0.0, -5.0);
  goal.value = lift().body(a, "barge").p.z() + 2.88;
  solve_static(lift().model, s, {goal}, "take-up");
  CHECK(s.drive[goal.drive].position == Approx(2.06 + 0.049).margin(0.02));
}

TEST_CASE("reference lift: the catenaries draw the trimmed crane aft, springs without height do not") {
  // The table has midship at x = 0. Lines that leave the fairlead downwards pull less where the fairlead sinks and more
  // where it rises: bow down, the two fore lines slacken, the two after lines tighten.
  const StaticPose& before = lift().pose("before_the_lift");
  const StaticPose& hanging = lift().pose("even_keel_unloaded_a_hanging");
  const auto x = [](const ReferenceLift& l, const StaticPose& p) { return l.body(p, "crane").p.x(); };
  const auto pull = [&](const StaticPose& p, const std::string& line) {
    return p.values.at("crane_" + line + ".horizontal_tension");
  };
  CHECK(x(lift(), before) == Approx(0.0).margin(0.005));
  CHECK(x(lift(), hanging) == Approx(-0.13).margin(0.02));
  // In balance the pulls are equal again: at x = 0 they would not be. Surge stiffness of four lines is some 200 kN/m.
  CHECK(pull(hanging, "bow_port") == Approx(pull(hanging, "stern_port")).epsilon(0.01));

  Specification linear = reference_case().specification;
  for (MooringSpec& line : linear.moorings) {
    if (line.body != "crane") continue;
    line.type = MooringSpec::Type::linear;
    line.stiffness = 1e5;  // N/m, about that of the catenary
    line.anchor_distance = 340.0;
  }
  const ReferenceLift springs(linear);
  const StaticPose& sprung = springs.pose("even_keel_unloaded_a_hanging");
  CAPTURE(x(springs, sprung), springs.tip(sprung).x());
  CHECK(std::abs(x(springs, sprung)) < 0.03);
  CHECK(springs.tip(sprung).x() == Approx(75.57).margin(0.05));  // the table's own number, in the world
}
