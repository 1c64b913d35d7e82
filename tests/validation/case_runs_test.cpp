// From a case file to a motion, by way of attitudes, inertia, hulls and waves as they are written there, against exact
// answers: what the mechanics tests build by hand comes here out of the reader and build_model.
#include <catch2/catch.hpp>
#include <cmath>

#include "problems/case.h"
#include "sim/simulate.h"
#include "sim/spatial/constants.h"
#include "tests/truth/pendulums.h"

using namespace stillhook;

namespace {

struct CaseRun {
  explicit CaseRun(const std::string& name, const std::vector<Override>& changes = {})
      : c(read_case(std::string(STILLHOOK_SOURCE_DIR) + "/tests/problems/cases/" + name + ".toml", changes)),
        model(build_model(c.specification)),
        operation(build_operation(model)),
        run(simulate(model, operation)) {
    REQUIRE(run.status == RunStatus::completed);
  }
  const std::vector<double>& series(const std::string& channel) const {
    const int i = run.find(channel);
    REQUIRE(i >= 0);
    return run.values[static_cast<std::size_t>(i)];
  }
  Case c;
  Model model;
  Operation operation;
  Trajectory run;
};

}  // namespace

TEST_CASE("the double pendulum of a case file swings as in minimal coordinates") {
  const CaseRun run("double_pendulum");
  // Rods of 2 m hung at their ends: 0.5 and 0.3 t, released at 30 and 60 deg; inertia as the file has it.
  const truth::DoublePendulum truth{500.0, 1.0, 166.667, 2.0, 300.0, 1.0, 100.0, 9.80665};
  const truth::DoublePendulum::Vec start(30.0 * kDegree, 60.0 * kDegree, 0.0, 0.0);
  const auto &x1 = run.series("upper.x"), &z1 = run.series("upper.z"), &x2 = run.series("lower.x"),
             &z2 = run.series("lower.z");
  const auto &pitch1 = run.series("upper.pitch"), &pitch2 = run.series("lower.pitch");
  const std::vector<double>& force = run.series("shoulder.force_x");
  REQUIRE(run.run.time.size() == 501);
  double turned = 0.0;
  for (std::size_t i = 0; i < run.run.time.size(); i += 25) {
    CAPTURE(run.run.time[i]);
    const auto y = truth.at(run.run.time[i], start);
    // Second order: (w h)^2 / 10 of the 50 rad of phase that the faster mode goes through in 10 s is 5e-4 of a swing of
    // a radian, and the two angles pull at one another.
    CHECK(pitch1[i] == Approx(y[0]).margin(2e-3));
    CHECK(pitch2[i] == Approx(y[1]).margin(4e-3));
    // The frames stand at the upper ends: the first in its hinge, the second two metres below.
    CHECK(x1[i] == Approx(0.0).margin(1e-6));
    CHECK(z1[i] == Approx(10.0).margin(1e-6));
    CHECK(x2[i] == Approx(-2.0 * std::sin(y[0])).margin(4e-3));
    CHECK(z2[i] == Approx(10.0 - 2.0 * std::cos(y[0])).margin(4e-3));
    turned = std::max(turned, std::abs(force[i]));
  }
  CHECK(turned > 1000.0);  // it swings: the hinge pulls sideways
}

TEST_CASE("the sphere of a case file floats at half its depth and follows a long wave") {
  const CaseRun run("floating_sphere", {{"operation.phases.float.duration_s", "200"}});
  const auto& z = run.series("sphere.z");
  // 259.264 t displace half of the mesh, 252.94 m3.
  CHECK(z.front() == Approx(0.0).margin(2e-3));
  CHECK(run.series("sphere.submerged_volume").front() == Approx(252.94).epsilon(1e-4));
  // Heave in a wave of 171 m length, 17 diameters: the pressure of the wave alone lifts it, a (rho g A - rho w^2 V),
  // and a constant added mass goes along: w0 = 1.42 rad/s.
  const double area = std::acos(-1.0) * 25.0, g = 9.80665, w2 = 0.36;
  const double w0 = std::sqrt(1025.0 * g * area / (259264.0 + 134000.0));
  const double expected = 0.1 * (1.0 - w2 / g * 252.94 / area) / (1.0 - w2 / (w0 * w0));
  double most = 0.0;
  for (std::size_t i = 0; i < z.size(); ++i)
    if (run.run.time[i] > 150.0) most = std::max(most, std::abs(z[i]));
  // The next order of the pressure over the draft, (k R)^2/4 = 0.8 %, the mesh's water plane (3 % less volume than the
  // sphere) and what is left of the start.
  CHECK(most == Approx(expected).epsilon(0.04));
}

TEST_CASE("the three slings of a case file share the load and the winch raises it by what it hauls") {
  const CaseRun run("three_point_lift");
  const std::map<std::string, double> rest = channel_values(run.model, run.model.initial_state());
  const double g = 9.80665;
  CHECK(rest.at("main.tension") == Approx(31e3 * g).epsilon(1e-6));
  // Each sling carries a third of 30 t at the angle of its own 6.25 m and a little stretch over 3 m.
  for (const char* sling : {"sling_1", "sling_2", "sling_3"}) {
    CAPTURE(sling);
    const double length = rest.at(std::string(sling) + ".length"), down = std::sqrt(length * length - 9.0);
    // 2e7 N over 6.25 m: the sling is as much longer as its own pull says.
    CHECK(rest.at(std::string(sling) + ".tension") == Approx(10e3 * g * length / down).epsilon(1e-3));
    CHECK(length == Approx(6.25 * (1.0 + rest.at(std::string(sling) + ".tension") / 2e7)).epsilon(1e-6));
  }
  // Hauled 2 m from 11 s on, so smoothly that less than a millimetre of bounce is left.
  const auto& z = run.series("frame.z");
  CHECK(run.series("winch.position").back() == Approx(2.0).epsilon(1e-9));
  // The main wire is 2 m shorter of 20 and stretches a tenth less: 12 mm of 122.
  const double stretch = 31e3 * g * 20.0 / 5e7, less = stretch * 2.0 / 20.0;
  CHECK(z.back() - z.front() == Approx(2.0 + less).margin(5e-3));
}
