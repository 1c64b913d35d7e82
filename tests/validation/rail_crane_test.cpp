// A crane on a rail with a pendulum: input shaping against its closed form, and what a search makes of the same move.
//
//   T = 2 pi sqrt(l / g),   unshaped move: travel / v + ramp,   ZV: T / 2 longer, no swing left
//
// Singer & Seering 1990 (profile.h); l 25 m, v 0.5 m/s, ramp 2 s, travel 12.5 m.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "problems/case.h"

#include "problems/search/solve.h"
#include "sim/simulate.h"

using namespace stillhook;

namespace {

const std::string kFile = STILLHOOK_SOURCE_DIR "/tests/validation/cases/rail_crane.toml";
const std::string kMove = "operation.phases.go.moves.travel.";
const double kPeriod = 2.0 * std::numbers::pi * std::sqrt(25.0 / 9.80665);
constexpr double kUnshaped = 12.5 / 0.5 + 2.0;  // s

Case rail_crane(const std::vector<Override>& overrides = {}) { return read_case(kFile, overrides); }

struct Outcome {
  double duration = 0.0;  // s, from rest to rest
  double residual = 0.0;  // m, largest horizontal distance of load and trolley afterwards
};

Outcome run(const Case& c) {
  const Model model = build_model(c.specification);
  const Operation operation = build_operation(model);
  const Trajectory run = simulate(model, operation, {});
  REQUIRE(run.status == RunStatus::completed);
  Outcome outcome;
  outcome.duration = operation.phases[0].duration;
  const auto &load = run.values[static_cast<std::size_t>(run.find("load.x"))],
             &trolley = run.values[static_cast<std::size_t>(run.find("trolley.x"))];
  for (std::size_t i = 0; i < run.time.size(); ++i)
    if (run.time[i] > outcome.duration) outcome.residual = std::max(outcome.residual, std::abs(load[i] - trolley[i]));
  return outcome;
}

/// The period is off by the swing's square over 16 (1.5 deg: 4e-5), by the trolley's give and the time step (HHT: a few
/// times 1e-5 at 200 steps a period); two impulses leave pi/2 times that. Corners of the speed fall between steps.
constexpr double kShapedResidual = 1e-3;  // of the unshaped one

}  // namespace

TEST_CASE("rail crane: a ZV-shaped move leaves no swing and takes half a period more") {
  const Outcome unshaped = run(rail_crane()), zv = run(rail_crane({{kMove + "shaper", "zv"}})),
                zvd = run(rail_crane({{kMove + "shaper", "zvd"}}));
  CHECK(unshaped.duration == Approx(kUnshaped).epsilon(1e-12));
  // Start and stop each leave a swing of v / w, less sin(x) / x of it at x = w ramp / 2 because of the ramp; 25 s apart
  // they add up to twice |sin(w 25 s / 2)| of that. A hundredth: the swing of 3.4 deg is not quite linear.
  const double w = 2.0 * std::numbers::pi / kPeriod, ramp = std::sin(w) / w;
  CHECK(unshaped.residual == Approx(2.0 * 0.5 / w * ramp * std::abs(std::sin(w * 25.0 / 2.0))).epsilon(1e-2));
  // The period is that of the lift's own mode: the drive's spring, 1e5 kN/m, gives by 2e-5 of the pendulum's stiffness.
  CHECK(zv.duration == Approx(kUnshaped + 0.5 * kPeriod).epsilon(1e-5));
  CHECK(zvd.duration == Approx(kUnshaped + kPeriod).epsilon(1e-5));
  CAPTURE(unshaped.residual, zv.residual, zvd.residual);
  CHECK(zv.residual <= kShapedResidual * unshaped.residual);
  CHECK(zvd.residual <= kShapedResidual * unshaped.residual);
}

TEST_CASE("rail crane: without hoist falls the shaper wants its period") {
  const Case c = rail_crane({{kMove + "shaper", "zv"}, {"wires.fall.role", "other"}});
  const Model model = build_model(c.specification);
  CHECK_THROWS_WITH(build_operation(model), Catch::Contains("operation.phases.go.moves.travel.shaper_period") &&
                                                Catch::Contains("there is no hoist wire"));
  const Case given =
      rail_crane({{kMove + "shaper", "zv"}, {kMove + "shaper_period_s", "8"}, {"wires.fall.role", "other"}});
  CHECK(build_operation(build_model(given.specification)).phases[0].duration == Approx(kUnshaped + 4.0));
}

TEST_CASE("rail crane: what a wrong period leaves is Singer and Seering's, ZVD bears twice as much") {
  const double unshaped = run(rail_crane()).residual;
  for (const double ratio : {0.85, 1.15}) {
    const std::string period = std::to_string(ratio * kPeriod);
    const auto shaped = [&](const char* shaper) {
      return run(rail_crane({{kMove + "shaper", shaper}, {kMove + "shaper_period_s", period}})).residual / unshaped;
    };
    // Two equal impulses half a wrong period apart leave |cos(pi / 2 ratio)| of the swing, three its square.
    const double left = std::abs(std::cos(0.5 * std::numbers::pi * ratio));
    CHECK(shaped("zv") == Approx(left).epsilon(1e-2));
    CHECK(shaped("zvd") == Approx(left * left).epsilon(2e-2));
  }
}

TEST_CASE("rail crane: a search finds the shaper's period") {
  const Case shaped = rail_crane({{kMove + "shaper", "zv"}, {kMove + "shaper_period_s", "7"}});
  SearchProblem problem;
  problem.variable_names = {"period"};
  problem.lower = Eigen::VectorXd::Constant(1, 5.0);
  problem.upper = Eigen::VectorXd::Constant(1, 15.0);
  problem.start = Eigen::VectorXd::Constant(1, 7.0);
  problem.evaluate = [&](const Eigen::VectorXd& x) {
    Evaluation e;
    e.usable = true;
    e.objective = run(with_values(shaped, {{kMove + "shaper_period_s", x[0]}})).residual;
    return e;
  };
  SolveOptions options;
  options.solver = "auto";
  options.evaluations = 60;
  const SearchReport report = solve(problem, options);
  CHECK(report.best_x[0] == Approx(kPeriod).epsilon(1e-3));
  CHECK(report.best.objective <= kShapedResidual * run(rail_crane()).residual);
}

TEST_CASE("rail crane: a search over free speeds needs no more time than the shaped move") {
  // Five speeds and their mirror image; least duration with a residual swing below a hundredth of the unshaped one.
  const Case free = rail_crane(
      {{kMove + "profile", "\"knots\""}, {kMove + "knots", "[0.5, 0.5, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.5, 0.5]"}});
  const double allowed = 0.01 * run(rail_crane()).residual;
  SearchProblem problem;
  for (int i = 0; i < 5; ++i) problem.variable_names.push_back("knot " + std::to_string(i));
  problem.constraint_names = {"residual"};
  problem.lower = Eigen::VectorXd::Constant(5, 0.05);
  problem.upper = Eigen::VectorXd::Ones(5);
  problem.start = (Eigen::VectorXd(5) << 0.5, 0.5, 1.0, 1.0, 1.0).finished();
  problem.evaluate = [&](const Eigen::VectorXd& x) {
    std::vector<std::pair<std::string, double>> values;
    for (int i = 0; i < 5; ++i)
      for (const int knot : {i, 9 - i}) values.push_back({kMove + "knots." + std::to_string(knot), x[i]});
    const Outcome outcome = run(with_values(free, values));
    Evaluation e;
    e.usable = true;
    e.objective = outcome.duration / kUnshaped;
    e.constraints = Eigen::VectorXd::Constant(1, outcome.residual / allowed - 1.0);
    return e;
  };
  SolveOptions options;
  options.solver = "cobyla";
  options.evaluations = 300;
  options.initial_step = 0.4;
  const SearchReport report = solve(problem, options);
  CHECK(report.feasible);
  CAPTURE(report.best_x.transpose(), report.evaluations);
  CHECK(report.best.objective * kUnshaped <= kUnshaped + 0.5 * kPeriod);
}
