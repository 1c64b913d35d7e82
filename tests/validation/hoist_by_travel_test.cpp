// The reference lift with its hoist given as a travel, against the still-water solution of another engine of its own.
#include <catch2/catch.hpp>

#include "problems/case.h"
#include "sim/multibody/stability.h"
#include "sim/operation.h"

using namespace stillhook;

TEST_CASE("reference lift: a hoist of 14.6 m given as a travel ends in the stable pose", "[validation][statics]") {
  constexpr double kTonne = 9806.65;  // N
  const Case c = read_case(std::string(STILLHOOK_SOURCE_DIR) + "/tests/validation/cases/hoist_by_travel.toml");
  const Model model = build_model(c.specification);
  const Operation operation = build_operation(model);
  const auto angle = [&](const StaticPose& p, const char* body) {
    const Vector3 x = p.bodies[model.body_index("platform")].R.transpose() * p.bodies[model.body_index(body)].R.col(0);
    return std::atan2(x.z(), x.x()) * 180.0 / M_PI;
  };
  const StaticPose &hoisted = operation.static_poses[2], &hauled = operation.static_poses[4];
  REQUIRE(hoisted.name == "hoist_up");
  REQUIRE(hauled.name == "stay_haul");
  // Half of the last digit that the other solution gives.
  CHECK(hoisted.values.at("stay_port.tension") / kTonne == Approx(433.0).margin(0.06));
  CHECK(hoisted.values.at("luffing_port.tension") / kTonne == Approx(552.7).margin(0.06));
  CHECK(angle(hoisted, "backstay_port") == Approx(109.876).margin(6e-4));
  CHECK(angle(hoisted, "boom_port") == Approx(74.846).margin(6e-4));
  CHECK(hoisted.values.at("load.x") == Approx(76.03).margin(6e-3));
  CHECK(hauled.values.at("stay_port.tension") / kTonne == Approx(258.7).margin(0.06));
  CHECK(angle(hauled, "backstay_port") == Approx(115.123).margin(6e-4));
  for (const SystemState& equilibrium : operation.equilibria) {
    SystemState state = equilibrium;
    state.t = -1.0;
    CHECK(weakest_motion(model.system(), state).stable());
  }
}
