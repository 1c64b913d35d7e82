// Hulls in wind and current: the generic suite, Blendermann's values, closed forms.
#include "sim/environment/flow_hull.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "sim/operation.h"
#include "sim/simulate.h"
#include "sim/spatial/constants.h"
#include "tests/sim/force_element_suite.h"

using namespace stillhook;

namespace {

WindHullSpec support_ship() {
  WindHullSpec hull;
  hull.name = "topsides";
  hull.body = "ship";
  hull.ship = WindHullSpec::Ship::diving_support;
  hull.area_front = 300.0;
  hull.area_side = 1200.0;
  hull.length = 120.0;
  hull.centroid_ahead = 2.0;
  hull.centroid_height = 9.0;
  return hull;
}

CurrentSpec current_of(double speed, double towards) {
  CurrentSpec current;
  current.speed = speed;
  current.towards = towards;
  return current;
}

FlowHullOptions barge_options() {
  FlowHullOptions o{.name = "barge", .body = 0, .coefficients = blendermann(support_ship())};
  o.along = {0, {1.0, 0.2, 3.0}};
  o.across = {0, {1.0, 0.2, 5.0}};
  o.area_along = 240.0;
  o.area_across = 400.0;
  o.moment_size = 400.0 * 80.0;
  o.length = 80.0;
  return o;
}

std::unique_ptr<FlowHull> barge_in(const CurrentSpec& current) {
  return std::make_unique<FlowHull>(
      barge_options(), "current_hulls.barge",
      std::make_shared<CurrentStream>(current, std::make_shared<const WaveField>(), 0.0, 1025.0));
}

/// A vessel as a body without weight, so that it needs no hull to float on.
Specification free_vessel(double mass) {
  Specification s;
  s.sea.gravity = 1e-9;  // as good as none
  BodySpec ship;
  ship.name = "ship";
  ship.mass = mass;
  ship.inertia = 1e15 * Matrix3::Identity();  // the current pushes under its centre, and nothing rights it
  s.bodies.push_back(ship);
  s.solver.static_start = false;
  s.solver.max_duration = 600.0;
  s.solver.time_step = 0.1;
  return s;
}

}  // namespace

TEST_CASE("a hull in a flow passes the suite of force elements", "[suite][current]") {
  for (const double h : {0.0, 0.4}) {
    suite::ElementCase c;
    c.name = h > 0.0 ? "in a step" : "at rest";
    c.bodies = 1;
    c.time_step = h;
    c.between_bodies = false;
    c.energy_account = false;  // the water gives and takes
    c.scene = [](std::mt19937& random) {
      suite::Scene s = suite::general_scene(random, 1, 0);
      // Not on its end, where a hull has no heading.
      s.body[0].R_WB = exp_rotation(Vector3(0.0, 0.0, suite::random_vector(random, 3.0).z())) *
                       exp_rotation(suite::random_vector(random, 0.4));
      return s;
    };
    c.make = [](const Instant&) { return barge_in(current_of(1.7, 0.6)); };
    suite::check_force_element(c);
  }
}

TEST_CASE("a hull in gusts passes the suite of force elements", "[suite][wind]") {
  suite::ElementCase c;
  c.name = "in gusts";
  c.bodies = 1;
  c.time_step = 0.4;
  c.between_bodies = false;
  c.energy_account = false;
  c.scene = [](std::mt19937& random) {
    suite::Scene s = suite::general_scene(random, 1, 0);
    s.body[0].R_WB = exp_rotation(suite::random_vector(random, 0.4));
    return s;
  };
  c.make = [](const Instant&) {
    WindSpec wind;
    wind.speed = 14.0;
    wind.from = 2.0;
    wind.gusts = WindSpec::Gusts::npd;
    FlowHullOptions o = barge_options();
    o.distance = 12.0;
    return std::make_unique<FlowHull>(o, "wind_hulls.barge", std::make_shared<WindStream>(wind, 2, 0.0));
  };
  suite::check_force_element(c);
}

TEST_CASE("Blendermann's coefficients are those of his formulae", "[wind]") {
  // Evaluated from the published formulae with the parameters of the MSS toolbox: diving support vessel, A_F 300 and
  // A_L 1200 m2, L 120 m, s_L 2 m. Five decimals are given.
  const FlowCoefficients C = blendermann(support_ship());
  const std::vector<std::array<double, 4>> truth = {
      {0, -0.60000, 0.00000, 0.00000},   {30, -0.62746, -0.54340, -0.11148}, {60, -0.36226, -0.94119, -0.10439},
      {90, 0.00000, -0.90000, -0.01500}, {120, 0.47643, -0.92834, 0.07202},  {150, 0.82520, -0.53598, 0.09210},
      {180, 0.80000, 0.00000, 0.00000}};
  for (const auto& [angle, Cx, Cy, Cn] : truth) {
    CAPTURE(angle);
    const Vector3 port = C.at(angle * kDegree).value, starboard = C.at(-angle * kDegree).value;
    CHECK(port[0] == Approx(Cx).margin(1e-5));
    CHECK(port[1] == Approx(Cy).margin(1e-5));
    CHECK(port[2] == Approx(Cn).margin(1e-5));
    CHECK(starboard[0] == Approx(Cx).margin(1e-5));
    CHECK(starboard[1] == Approx(-Cy).margin(1e-5));
    CHECK(starboard[2] == Approx(-Cn).margin(1e-5));
  }
}

TEST_CASE("coefficients between the angles are smooth and near the rule", "[current]") {
  // A cubic over 5 degrees of a sine squared; at bow and stern, where its curvature jumps, the parabola's slope leaves
  // 0.15 % of the largest value.
  const FlowCoefficients C = cross_flow(0.08, 0.8);
  for (double a = -3.0; a < 3.0; a += 0.0371) {
    CHECK(C.at(a).value[1] == Approx(-0.8 * std::sin(a) * std::abs(std::sin(a))).margin(2e-3 * 0.8));
    const double d = 1e-6;
    CHECK(C.at(a).slope[1] == Approx((C.at(a + d).value[1] - C.at(a - d).value[1]) / (2.0 * d)).margin(1e-6));
  }
  CHECK(C.at(0.25 * kTwoPi).value[1] == Approx(-0.8).epsilon(1e-12));
  CHECK(C.broadside() == Approx(0.8).epsilon(1e-12));
}

TEST_CASE("the flow's forces are coefficients times pressure and area", "[current]") {
  const auto hull = barge_in(current_of(2.0, 0.0));
  // From port, 30 degrees off the bow: the flow goes aft and to starboard.
  const Eigen::Vector2d u = 2.0 * Eigen::Vector2d(-std::cos(kTwoPi / 12.0), -std::sin(kTwoPi / 12.0));
  const double q = 0.5 * 1025.0 * 4.0;
  const FlowHull::Load load = hull->load(u, 0.0);
  CHECK(load.value[0] == Approx(q * 240.0 * -0.62746).epsilon(2e-5));
  CHECK(load.value[1] == Approx(q * 400.0 * -0.54340).epsilon(2e-5));
  CHECK(load.value[2] == Approx(q * 32000.0 * -0.11148).epsilon(1e-4));
  // Turning in water at rest: strips of C = the largest C_y brake with 1/2 rho C T L^4/32 r
  // |r|.
  const double r = 0.02, C = blendermann(support_ship()).broadside();
  CHECK(hull->load({0.0, 0.0}, r).value[2] ==
        Approx(-0.5 * 1025.0 * C * (400.0 / 80.0) * std::pow(80.0, 4) / 32.0 * r * r));
}

TEST_CASE("a vessel drifts with the current, its own velocity delayed by the filter", "[current]") {
  // M dv/dt = k (U - vs)^2, Tf dvs/dt = v - vs from rest, by a fourth-order rule with a thousandth of a second. The
  // element's trapezoidal rule with 0.1 s against 20 s: 1e-5.
  Specification s = free_vessel(2e7);
  s.sea.current = current_of(2.0, 0.0);
  CurrentHullSpec hull;
  hull.name = "hull_in_current";
  hull.body = "ship";
  hull.drag = {0.5, 0.9};
  hull.length = 100.0;
  hull.draft = 8.0;
  s.current_hulls.push_back(hull);
  const Model model = build_model(s);
  const Trajectory run = simulate(model, build_operation(model));
  REQUIRE(run.status == RunStatus::completed);
  const double k = 0.5 * 1025.0 * 0.5 * 800.0;
  double v = 0.0, slow = 0.0;
  const double dt = 1e-3;
  const auto rate = [&](double a, double b) {
    return std::pair(k * (2.0 - b) * std::abs(2.0 - b) / 2e7, (a - b) / 20.0);
  };
  for (int i = 0; i < 600000; ++i) {
    const auto [v1, s1] = rate(v, slow);
    const auto [v2, s2] = rate(v + 0.5 * dt * v1, slow + 0.5 * dt * s1);
    const auto [v3, s3] = rate(v + 0.5 * dt * v2, slow + 0.5 * dt * s2);
    const auto [v4, s4] = rate(v + dt * v3, slow + dt * s3);
    v += dt / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
    slow += dt / 6.0 * (s1 + 2.0 * s2 + 2.0 * s3 + s4);
  }
  CHECK(run.values[static_cast<std::size_t>(run.find("ship.vx"))].back() == Approx(v).epsilon(1e-4));
  CHECK(run.values[static_cast<std::size_t>(run.find("hull_in_current.speed"))].back() ==
        Approx(2.0 - slow).epsilon(1e-3));
}

TEST_CASE("tables of coefficients that do not go round are refused", "[current]") {
  const auto refused = [](const std::vector<FlowCoefficients::Row>& rows, const std::string& part) {
    try {
      FlowCoefficients C(rows);
      FAIL("taken, although: " << part);
    } catch (const Error& error) {
      CHECK(std::string(error.what()).find(part) != std::string::npos);
    }
  };
  const auto rows = [](double last, double step) {
    std::vector<FlowCoefficients::Row> all;
    for (double a = 0.0; a <= last + 1e-9; a += step)
      all.push_back({a * kDegree, -std::cos(a * kDegree), a == 180.0 ? 0.0 : -std::sin(a * kDegree), 0.0});
    return all;
  };
  FlowCoefficients good(rows(180.0, 15.0)), whole(rows(360.0, 15.0));
  CHECK(good.at(5.0).value[1] == Approx(whole.at(5.0).value[1]).epsilon(1e-9));
  refused(rows(150.0, 15.0), "must go from 0 to 180 or from 0 to 360 deg, it goes from 0 to 150 deg");
  refused(rows(180.0, 60.0), "has no row between 0 and 60 deg");
  refused({rows(180.0, 15.0).front()}, "needs rows");
  auto askew = rows(180.0, 15.0);
  askew.front()[2] = 0.3;
  refused(askew, "must have Cy and Cn of 0 at 0 and 180 deg");
  auto open = rows(360.0, 15.0);
  open.back()[1] = 0.7;
  refused(open, "the same coefficients at 0 and 360 deg");
  auto falling = rows(180.0, 15.0);
  std::swap(falling[2], falling[3]);
  refused(falling, "rising angles");
}

TEST_CASE("a file of coefficients is read by the names of its columns", "[current]") {
  const auto file = std::filesystem::temp_directory_path() / "stillhook_flow_coefficients.csv";
  const auto write = [&](const std::string& text) { std::ofstream(file) << text; };
  write(
      "# by "
      "somebody\nCn,angle_deg,Cy,Cx\n0,0,0,-0.1\n0.01,45,-0.5,-0.08\n0,90,-0.8,0\n-0.01,135,-0.5,0.08\n0,180,0,0.1\n");
  const FlowCoefficients C = read_flow_coefficients(file.string());
  CHECK(C.at(45.0 * kDegree).value.isApprox(Vector3(-0.08, -0.5, 0.01), 1e-12));
  CHECK(C.at(-45.0 * kDegree).value.isApprox(Vector3(-0.08, 0.5, -0.01), 1e-12));
  write("angle_deg,Cx,Cy\n0,1,2\n");
  CHECK_THROWS_WITH(read_flow_coefficients(file.string()), Catch::Matchers::Contains("has no column \"cn\""));
  write("angle_deg,Cx,Cy,Cn\n0,1,x,0\n");
  CHECK_THROWS_WITH(read_flow_coefficients(file.string()), Catch::Matchers::Contains("line 2 has no number in \"cy\""));
  std::filesystem::remove(file);
}
