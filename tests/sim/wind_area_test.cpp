// Wind on bodies: the generic suite, and truths in closed form.
#include <cmath>

#include "sim/environment/wind_area.h"
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

TEST_CASE("wind on an area passes the suite of force elements", "[suite][wind]") {
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
    c.make = [](const Instant&) {
      return std::make_unique<WindArea>(area_of({30.0, 55.0, 20.0}), wind_of(18.0), BodyPoint{0, {0.5, -0.2, 0.4}});
    };
    suite::check_force_element(c);
  }
}

TEST_CASE("the wind's profile is that of ISO 19901-1", "[wind]") {
  // NPD/ISO 19901-1 formulae: hourly means at a height. Six digits of the truth.
  const Instant now;
  CHECK(wind_speed(wind_of(10.0), 10.0, now).value == Approx(10.0).epsilon(1e-6));
  CHECK(wind_speed(wind_of(15.0), 50.0, now).value == Approx(17.4823).epsilon(4e-6));
  CHECK(wind_speed(wind_of(20.0), 100.0, now).value == Approx(25.2511).epsilon(4e-6));
  WindSpec power = wind_of(10.0, WindSpec::Profile::power);
  power.exponent = 0.12;
  CHECK(wind_speed(power, 80.0, now).value == Approx(10.0 * std::pow(8.0, 0.12)).epsilon(1e-12));
  CHECK(wind_speed(wind_of(10.0), 0.2, now).value ==
        Approx(wind_speed(wind_of(10.0), 1.0 + 1e-9, now).value).epsilon(1e-9));
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

TEST_CASE("in air at rest wind areas only brake", "[wind]") {
  std::mt19937 random(3);
  WindArea still(area_of({30.0, 55.0, 20.0}), wind_of(0.0), BodyPoint{0, {0.5, -0.2, 0.4}});
  for (int i = 0; i < 50; ++i) {
    suite::Scene s = suite::general_scene(random, 1, 0);
    s.body[0].p_WC.z() += 20.0;
    suite::Store store(still);
    CHECK(suite::forces(still, s, 0.0, store.memory()).dot(s.velocity()) < 0.0);
  }
}
