// A run that cannot go on: it stops, says when, in which phase and which body, and keeps what came before.
#include <catch2/catch.hpp>
#include <cmath>

#include "sim/simulate.h"

using namespace stillhook;

namespace {

// A load in free fall through a bottomless scene: it leaves the scene, 1e5 m from the origin, when g t^2 / 2 = 1e5 m.
Specification bottomless() {
  Specification s;
  s.name = "bottomless";
  for (const char* name : {"anchor", "load"}) {
    BodySpec body;
    body.name = name;
    body.mass = 1e3;
    body.inertia = 200.0 * Matrix3::Identity();
    s.bodies.push_back(body);
  }
  JointSpec joint;
  joint.name = "fixed";
  joint.type = JointSpec::Type::fixed;
  joint.parent = "world";
  joint.child = "anchor";
  s.joints = {joint};
  PhaseSpec before, during;
  before.name = "before";
  before.duration = 10.0;
  during.name = "fall";
  during.duration = 1000.0;
  s.operation.phases = {before, during};
  s.solver.static_start = false;
  s.solver.output_interval = 1.0;
  return s;
}

}  // namespace

TEST_CASE("a run whose body leaves the scene ends as diverged, with its time, its phase and the body's name") {
  const Model model = build_model(bottomless());
  const Trajectory run = simulate(model, build_operation(model));
  CHECK(run.status == RunStatus::diverged);
  CHECK_THAT(run.message, Catch::Contains("in phase 'fall'"));
  CHECK_THAT(run.message, Catch::Contains("body 'load' has left the scene"));
  // sqrt(2e5 m / 9.80665 m/s2) = 142.8 s
  CHECK_THAT(run.message, Catch::Contains("diverged at t = 142.8"));
  CHECK_THAT(run.message, !Catch::Contains("anchor"));
  REQUIRE(run.phases.size() == 2);
  CHECK(run.phases[0].end == Approx(10.0));
  CHECK(run.phases[1].end == Approx(142.8).margin(0.1));
  REQUIRE_FALSE(run.time.empty());
  CHECK(run.time.back() == Approx(142.0));
  for (const std::vector<double>& channel : run.values)
    for (const double v : channel) REQUIRE(std::isfinite(v));
}
