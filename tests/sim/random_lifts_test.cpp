// Lifts drawn at random, as an engineer might write them: on land or on a moored barge, straight from the hook or on a
// block with slings, hanging or standing at the start, with some drafts and lengths that are a little wrong. Every pose
// of each is a stable equilibrium that dynamic relaxation confirms, or the lift is refused for a true reason.
#include <catch2/catch.hpp>
#include <random>

#include "tests/sim/lift_parts.h"

using namespace stillhook;

namespace {

struct Draw {
  std::mt19937 engine;
  double between(double low, double high) { return low + (high - low) * (engine() / 4294967296.0); }
  int below(int n) { return static_cast<int>(between(0.0, n)); }
  bool chance(double share) { return between(0.0, 1.0) < share; }
};

struct RandomLift {
  LiftParts lift;
  double weight = 0.0;    // N, of the load
  std::string load_wire;  // one that carries the load
  bool stands = false;
};

RandomLift draw_lift(int seed) {
  Draw draw{std::mt19937(static_cast<unsigned>(seed))};
  RandomLift r;
  LiftParts& lift = r.lift;
  lift.winch("hoist");
  const bool afloat = draw.chance(0.6);
  const double tip = draw.between(30.0, 90.0), out = afloat ? draw.between(-5.0, 12.0) : 0.0;
  const double mass = std::exp(draw.between(std::log(2e4), std::log(4e5)));
  r.weight = mass * lift.spec.sea.gravity;
  std::string from = "world";
  double deck = 0.0;
  if (afloat) {
    const Vector3 size(60.0, 30.0, 8.0);
    BodySpec& barge = lift.barge("barge", 6e6, size, 0.0);
    deck = barge.position.z() + 4.0;
    barge.position.z() += draw.between(-0.1, 0.1);
    from = "barge";
    lift.moor("barge", draw.between(2e4, 3e5));
  }
  const Vector3 hook(out, draw.between(-2.0, 2.0), tip);  // of the sheave, from the barge's origin or the world's
  const double half = draw.between(1.0, 3.0);
  r.stands = draw.chance(0.5);
  const double bottom = r.stands ? deck : deck + draw.between(1.0, 8.0);
  const double lift_up = afloat ? lift.spec.bodies[0].position.z() : 0.0;
  BodySpec& load = lift.body("load", mass, Vector3(hook.x(), hook.y(), bottom + half), half);
  load.cog = Vector3(draw.between(-0.2, 0.2), draw.between(-0.2, 0.2), draw.between(-0.3, 0.0)) * half;
  if (r.stands || draw.chance(0.5))
    lift.feet("load", half, half, from, Vector3(hook.x(), hook.y(), deck - lift_up), 50.0 * r.weight);
  const double EA = r.weight * draw.between(100.0, 1000.0);
  const int slings = draw.chance(0.6) ? 3 + draw.below(10) : 0;
  if (slings == 0) {
    lift.wire("fall", from, hook, "load", Vector3(0, 0, half), EA, "hoist");
  } else {
    const double block = bottom + 2.0 * half + draw.between(2.0, 6.0) * half;
    if (block + 2.0 > tip) return draw_lift(seed + 100000);
    lift.body("block", 0.02 * mass + 500.0, Vector3(hook.x(), hook.y(), block), 0.4);
    lift.wire("fall", from, hook, "block", Vector3(0, 0, 0.3), EA, "hoist");
    for (int i = 0; i < slings; ++i) {
      const double a = 2.0 * M_PI * i / slings;
      lift.wire("sling_" + std::to_string(i), "block", Vector3(0, 0, -0.3), "load",
                half * Vector3(std::cos(a), std::sin(a), 1.0), EA * draw.between(0.3, 1.0))
          .slack = draw.chance(0.3) ? draw.between(0.0, 0.03) : 0.0;
    }
  }
  lift.travel("up", "hoist", draw.between(0.5, 2.0));
  const double depth = draw.chance(0.3) ? -draw.between(50.0, 2500.0) : bottom + half + 0.5;
  if (depth > 0.0 || lift.spec.contacts.empty()) lift.goal("to_a_height", "hoist", height_of("load"), depth);
  if (r.stands) {
    lift.goal("half_set_down", "hoist", tension_of("fall"), 0.5 * r.weight);
    lift.travel("set_down", "hoist", -1.0);
  }
  return r;
}

void check_lift(int seed) {
  CAPTURE(seed);
  const RandomLift r = draw_lift(seed);
  const Model model = build_model(r.lift.spec);
  const Operation operation = build_operation(model);
  REQUIRE(operation.static_poses.size() == r.lift.spec.operation.phases.size() + 1);
  const double g = r.lift.spec.sea.gravity;
  double hung = 0.0;
  for (const BodySpec& b : r.lift.spec.bodies)
    if (b.name != "barge") hung += b.mass * g;
  for (std::size_t i = 0; i < operation.equilibria.size(); ++i) {
    const StaticPose& pose = operation.static_poses[i];
    CAPTURE(pose.name, pose.values.at("fall.tension"), hung);
    // Nothing but wire and deck carries load and block.
    const double contact = pose.values.count("load_feet.force") ? pose.values.at("load_feet.force") : 0.0;
    const bool plumb = r.lift.spec.bodies[0].name != "barge";
    CHECK(pose.values.at("fall.tension") + contact == Approx(hung).epsilon(plumb ? 1e-3 : 0.02));
    // Soft coordinates, a load on one wire and a moored barge, are confirmed to what 1e-9 of the weight leaves of them.
    CHECK(relaxation_confirms(model, operation.equilibria[i], 0.02, 0.1));
  }
  if (r.stands) CHECK(operation.static_poses.back().values.at("fall.tension") < 0.5 * hung);
}

}  // namespace

TEST_CASE("statics: thirty lifts drawn at random reach stable poses", "[statics][random]") {
  for (int seed = 1; seed <= 30; ++seed) check_lift(seed);
}

TEST_CASE("statics: five hundred lifts drawn at random reach stable poses", "[statics][random][slow]") {
  for (int seed = 1001; seed <= 1500; ++seed) check_lift(seed);
}
