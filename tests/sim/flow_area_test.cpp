// Areas in wind and current: the generic suite, and truths in closed form.
#include <cmath>

#include "sim/environment/flow_area.h"
#include "sim/operation.h"
#include "sim/simulate.h"
#include "sim/spatial/constants.h"
#include "tests/sim/force_element_suite.h"

using namespace stillhook;

namespace {

WindSpec wind_of(double speed, WindSpec::Profile profile = WindSpec::Profile::iso) {
  WindSpec wind;
  wind.speed = speed;
  wind.profile = profile;
  wind.to = 0.3;
  return wind;
}

WindAreaSpec area_of(const Vector3& areas) {
  WindAreaSpec area;
  area.name = "sail";
  area.body = "load";
  area.areas = areas;
  return area;
}

/// A body alone in a wind along x that does not change with height, 20 m above the water and without weight.
Specification free_body(double mass, double area) {
  Specification s;
  s.sea.gravity = 1e-9;  // as good as none
  BodySpec load;
  load.name = "load";
  load.mass = mass;
  load.inertia = 1e6 * Matrix3::Identity();
  load.position = {0.0, 0.0, 20.0};
  s.bodies.push_back(load);
  s.wind = wind_of(10.0, WindSpec::Profile::constant);
  s.wind.to = 0.0;
  s.wind_areas.push_back(area_of({area, 0.0, 0.0}));
  s.solver.static_start = false;
  s.solver.max_duration = 200.0;
  s.solver.time_step = 0.1;
  return s;
}

}  // namespace

TEST_CASE("an area in the wind passes the suite of force elements", "[suite][wind]") {
  for (const WindSpec::Gusts gusts : {WindSpec::Gusts::none, WindSpec::Gusts::npd})
    for (const auto& [name, low, high] :
         {std::tuple{"in the wind", 30.0, 45.0}, {"half in the water", -1.5, 1.5}, {"under water", -60.0, -40.0}}) {
      suite::ElementCase c;
      c.name = name;
      c.bodies = 1;
      c.between_bodies = false;
      c.energy_account = false;  // the air gives and takes
      c.loaded = low > -10.0;
      c.scene = [low = low, high = high](std::mt19937& random) {
        suite::Scene s = suite::general_scene(random, 1, 0);
        s.body[0].p_WC.z() = std::uniform_real_distribution<double>(low, high)(random);
        return s;
      };
      c.make = [gusts](const Instant&) {
        WindSpec wind = wind_of(18.0);
        wind.gusts = gusts;
        return std::make_unique<FlowArea>("sail", "wind_areas.sail", area_of({30.0, 55.0, 20.0}),
                                          std::make_shared<WindStream>(wind, 3, 0.0), BodyPoint{0, {0.5, -0.2, 0.4}});
      };
      suite::check_force_element(c);
    }
}

TEST_CASE("an area in the current passes the suite of force elements", "[suite][current]") {
  using Profile = CurrentSpec::Profile;
  SeaStateSpec state;
  state.name = "sea";
  state.type = SeaStateSpec::Type::jonswap;
  state.significant_height = 2.0;
  state.peak_period = 7.0;
  const auto waves = std::make_shared<const WaveField>(build_wave_field(state, 9.80665, 0.0, 40.0));
  for (const Profile profile : {Profile::uniform, Profile::power, Profile::table})
    for (const auto& [name, low, high] :
         {std::tuple{"in the water", -38.0, -8.0}, {"half in the water", -1.5, 1.5}, {"in the air", 30.0, 45.0}}) {
      suite::ElementCase c;
      c.name = name;
      c.bodies = 1;
      c.between_bodies = false;
      c.energy_account = false;  // the water gives and takes
      c.loaded = low < 10.0;
      c.scene = [low = low, high = high](std::mt19937& random) {
        suite::Scene s = suite::general_scene(random, 1, 0);
        s.body[0].p_WC.z() = std::uniform_real_distribution<double>(low, high)(random);
        return s;
      };
      c.make = [&](const Instant&) {
        CurrentSpec current;
        current.profile = profile;
        current.speed = 1.3;
        current.towards = 0.4;
        if (profile == Profile::table) current.table = {{2.0, 1.3, 0.4}, {17.0, 0.7, 1.1}, {35.0, 0.2, -0.3}};
        return std::make_unique<FlowArea>("sail", "current_areas.sail", area_of({30.0, 55.0, 20.0}),
                                          std::make_shared<CurrentStream>(current, waves, 40.0, 1025.0),
                                          BodyPoint{0, {0.5, -0.2, 0.4}});
      };
      suite::check_force_element(c);
    }
}

TEST_CASE("a free body comes up to the wind's speed", "[wind]") {
  // m dv/dt = k (U - v)^2 from rest: v = U x / (1 + x), x = k U t / m. The step's error is of second order: 1e-5.
  const double mass = 5e4, area = 120.0, U = 10.0;
  const Model model = build_model(free_body(mass, area));
  const Trajectory run = simulate(model, build_operation(model));
  REQUIRE(run.status == RunStatus::completed);
  const double k = 0.5 * 1.226 * 1.2 * area, t = run.time.back(), x = k * U * t / mass;
  CHECK(run.values[static_cast<std::size_t>(run.find("load.vx"))].back() == Approx(U * x / (1.0 + x)).epsilon(1e-4));
  CHECK(run.values[static_cast<std::size_t>(run.find("sail.speed"))].front() == Approx(U));
  CHECK(run.values[static_cast<std::size_t>(run.find("sail.force_x"))].front() == Approx(k * U * U));
}

TEST_CASE("a load on a fall hangs in the direction of its weight and the wind", "[wind]") {
  // F = 1/2 rho C A U^2 on the centre of gravity, which hangs the stretched fall and 4 m below the upper end. The load
  // turns by the angle as well, so that along its own axes the wind is weaker by the square of the cosine: 2e-4 of F.
  Specification s = free_body(1e5, 80.0);
  s.sea.gravity = 9.80665;
  s.wind.speed = 15.0;
  s.bodies[0].position = {0.0, 0.0, 10.0};
  WireSpec fall;
  fall.name = "fall";
  fall.role = WireSpec::Role::hoist;
  fall.from = "world";
  fall.to = "load";
  fall.point_from = {0.0, 0.0, 40.0};
  fall.point_to = {0.0, 0.0, 4.0};
  fall.axial_stiffness = 2e8;
  fall.unstretched_length = 26.0;
  s.wires.push_back(fall);
  s.solver.static_start = true;
  const Model model = build_model(s);
  const double F = 0.5 * 1.226 * 1.2 * 80.0 * 15.0 * 15.0, W = 1e5 * 9.80665, T = std::hypot(F, W);
  const double off = (26.0 * (1.0 + T / 2e8) + 4.0) * F / T;
  CHECK(model.initial_state().body[0].p_WC.x() == Approx(off).epsilon(4e-4));
}

TEST_CASE("a free body drifts with the current", "[current]") {
  // Truth C_drift: M dv/dt = 1/2 rho Cd A (U - v)^2 from rest, v = U x/(1 + x), x = rho Cd A U t/(2 M): 1.78261 m/s
  // after 200 s in 2 m/s with M = 20000 t and Cd A = 800 m2. Six digits of the truth, and 1e-5 of the step.
  Specification s = free_body(2e7, 800.0);
  s.bodies[0].position.z() = -20.0;
  s.wind = {};
  s.wind_areas.clear();
  s.sea.current.speed = 2.0;
  s.sea.current.towards = 0.0;
  CurrentAreaSpec area;
  area.name = "sail";
  area.body = "load";
  area.areas = {800.0, 0.0, 0.0};
  area.drag = Vector3::Ones();
  s.current_areas.push_back(area);
  const Model model = build_model(s);
  const Trajectory run = simulate(model, build_operation(model));
  REQUIRE(run.status == RunStatus::completed);
  REQUIRE(run.time.back() == Approx(200.0));
  CHECK(run.values[static_cast<std::size_t>(run.find("load.vx"))].back() == Approx(1.78261).epsilon(2e-5));
}

TEST_CASE("the current's profiles are what they say", "[current]") {
  const auto calm = std::make_shared<const WaveField>();
  const auto speed = [&](const CurrentSpec& current, double depth, double z) {
    return CurrentStream(current, calm, depth, 1025.0).at({0.0, 0.0, z}, Instant(), {}).velocity;
  };
  CurrentSpec current;
  current.speed = 1.4;
  current.towards = 0.5;
  // (1 - d/h)^(1/7) at three quarters of the depth; nothing to fall towards in deep water.
  CHECK(speed(current, 40.0, -30.0).norm() == Approx(1.4 * std::pow(0.25, 1.0 / 7.0)).epsilon(1e-12));
  CHECK(speed(current, 0.0, -30.0).norm() == Approx(1.4).epsilon(1e-12));
  CHECK(speed(current, 40.0, -39.99).norm() == Approx(1.4 * std::pow(0.01, 1.0 / 7.0)).epsilon(1e-12));
  current.profile = CurrentSpec::Profile::table;
  current.table = {{0.0, 1.0, 0.0}, {10.0, 1.0, 0.5 * kTwoPi / 2.0}};
  const Vector3 between = speed(current, 40.0, -5.0);  // half of each velocity, which stand square to each other
  CHECK(between.x() == Approx(0.5));
  CHECK(between.y() == Approx(0.5));
  CHECK(speed(current, 40.0, -25.0).y() == Approx(1.0));
  current.profile = CurrentSpec::Profile::power;
  CHECK_THROWS_AS(CurrentStream(current, calm, 0.0, 1025.0), SpecificationError);
}

TEST_CASE("the current is told from the surface of the moment", "[current]") {
  // Under a crest of 1 m a point 1 m below the mean surface is 2 m deep.
  const std::vector<WaveComponent> wave = {{1.0, 0.5, 0.5 * 0.5 / 9.80665, 1.0, 0.0, 0.0}};
  const auto waves = std::make_shared<const WaveField>(wave, 0.0);
  CurrentSpec current;
  current.profile = CurrentSpec::Profile::table;
  current.table = {{0.0, 0.0, 0.0}, {10.0, 1.0, 0.0}};
  const StreamPoint s = CurrentStream(current, waves, 0.0, 1025.0).at({0.0, 0.0, -1.0}, Instant(), {});
  CHECK(s.velocity.x() == Approx(0.2).epsilon(1e-9));
  CHECK(s.inside == Approx(2.0).epsilon(1e-9));
}

TEST_CASE("in a fluid at rest areas only brake", "[wind][current]") {
  std::mt19937 random(3);
  const auto air = std::make_shared<WindStream>(wind_of(0.0), 1, 0.0);
  const auto water = std::make_shared<CurrentStream>(CurrentSpec{}, std::make_shared<const WaveField>(), 0.0, 1025.0);
  const BodyPoint at{0, {0.5, -0.2, 0.4}};
  const FlowArea in_air("sail", "", area_of({30.0, 55.0, 20.0}), air, at),
      in_water("sail", "", area_of({30.0, 55.0, 20.0}), water, at);
  for (int i = 0; i < 50; ++i) {
    suite::Scene s = suite::general_scene(random, 1, 0);
    s.body[0].p_WC.z() += 20.0;
    suite::Store store(in_air), wet_store(in_water);
    CHECK(suite::forces(in_air, s, 0.0, store.memory()).dot(s.velocity()) < 0.0);
    s.body[0].p_WC.z() -= 40.0;
    CHECK(suite::forces(in_water, s, 0.0, wet_store.memory()).dot(s.velocity()) < 0.0);
  }
}
