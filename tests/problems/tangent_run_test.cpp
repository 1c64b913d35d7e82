// Derivatives of whole runs against Richardson-extrapolated central differences of whole runs: a truth that knows
// nothing of the tangent. The lift is taut, so both are smooth.
#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

#include "problems/case_reader.h"
#include "problems/evaluator.h"
#include "problems/tangent_run.h"
#include "results/changed_run.h"
#include "sim/multibody/hht_tangent.h"

namespace stillhook {
namespace {

const std::string kFolder = std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases";

Case small_lift(std::vector<Override> more = {}) {
  // Newton's method far below the differences that are taken; and no start or end of a ramp on a step, where a run has
  // a kink in whatever moves it.
  const std::vector<Override> always = {{"solver.newton_tolerance", "1e-13"},
                                        {"operation.phases.settle.duration_s", "20.013"},
                                        {"operation.phases.hoist_up.moves.hoist.ramp_s", "3.007"},
                                        {"operation.phases.hoist_up.moves.hoist.travel_m", "4.003"},
                                        {"operation.phases.hold.duration_s", "20.017"}};
  more.insert(more.begin(), always.begin(), always.end());
  return read_case(kFolder + "/small_lift.toml", more);
}

Trajectory run_of(const Case& c) {
  const Model model = build_model(c.specification);
  return simulate(model, build_operation(model));
}

/// (4 D(h/2) - D(h)) / 3 of one number a run, in the key's unit; the next order left out is h^4.
struct Differences {
  std::vector<double> value;
  double doubt = 0.0;  // largest difference of D(h/2) and D(h): a measure of what the extrapolation removes
};
Differences richardson(const Case& c, const std::string& key, double h,
                       const std::function<std::vector<double>(const Trajectory&)>& of) {
  const double x = key_value(c, key);
  const auto slope = [&](double step) {
    const auto plus = of(run_of(with_values(c, {{key, x + step}}))),
               minus = of(run_of(with_values(c, {{key, x - step}})));
    std::vector<double> d;
    for (std::size_t i = 0; i < std::min(plus.size(), minus.size()); ++i)
      d.push_back((plus[i] - minus[i]) / (2.0 * step));
    return d;
  };
  const auto coarse = slope(h), fine = slope(0.5 * h);
  Differences result;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    result.value.push_back((4.0 * fine[i] - coarse[i]) / 3.0);
    result.doubt = std::max(result.doubt, std::abs(fine[i] - coarse[i]));
  }
  return result;
}

double fall_stiffness(const Case& c) {
  const WireSpec& fall = c.specification.wires.front();
  return fall.axial_stiffness / fall.unstretched_length;  // N/m
}

void check_key(const Case& c, const std::string& key, double relative_step) {
  const std::vector<std::string> channels = {"load.x",       "load.y",      "load.z",
                                             "fall.tension", "barge.pitch", "tagline.tension"};
  TangentRequest request;
  request.keys = {key};
  request.channels = channels;
  const TangentRun run = run_with_tangents(c, request);
  REQUIRE(run.tangents.valid);
  // Where the key moves the lift at rest, either twin starts within rounding of its equilibrium, 1e-13 m on coordinates
  // of some ten metres; the wire's stiffness and the width of the twins make a tension of it that stays in the run.
  const auto& rest = run.static_poses[0];
  const bool moves = rest[0].front().bodies[0].p != rest[1].front().bodies[0].p;
  const double rounding = moves ? 1e-13 * fall_stiffness(c) / run.widths[0] : 0.0;
  for (std::size_t k = 0; k < channels.size(); ++k) {
    const auto series = [&](const Trajectory& t) { return t.values[static_cast<std::size_t>(t.find(channels[k]))]; };
    const Differences truth = richardson(c, key, relative_step * std::max(0.1, std::abs(key_value(c, key))), series);
    double size = 0.0, error = 0.0;
    for (std::size_t i = 0; i < truth.value.size(); ++i) {
      size = std::max(size, std::abs(truth.value[i]));
      error = std::max(error, std::abs(truth.value[i] - run.tangents.values[k](static_cast<Eigen::Index>(i), 0)));
    }
    CAPTURE(key, channels[k], size, error, truth.doubt);
    // What the twins' width leaves, (23 rad/s * 0.4 ms)^2 / 6 for the wire's own oscillation at the worst, beside what
    // the differences themselves are in doubt of: rounding of a run over the step, and kinks of the pull-only law that
    // fall between the two sides. The load's sway by the fall's damping, 4e-6 m, is the worst: 3.5e-3 and 3.8e-3 of that,
    // as the compiler arranges the same sums.
    CHECK(truth.doubt <= 5e-3 * size + 1e-12);
    // The tagline feels the fall's stiffness through the load's swing alone, 2e-5 N for a kN: 1e-9 N of rounding shows.
    const double seen = key == "wires.fall.axial_stiffness_kN" && channels[k] == "tagline.tension" ? 1e-9 : 1e-12;
    CHECK(error <= 1e-5 * size + 2.0 * truth.doubt + seen + (channels[k] == "fall.tension" ? rounding : 0.0));
    // The position of the load as a whole, where the differences are at their best.
    if (channels[k] == "load.z") CHECK(error <= 1e-6 * size + 2.0 * truth.doubt);
  }
}

TEST_CASE("Derivatives of a run by every kind of key", "[tangent]") {
  const Case c = small_lift();
  const auto [key, step] = GENERATE(table<std::string, double>({
      {"operation.phases.hoist_up.moves.hoist.speed_m_per_min", 2e-6},
      {"operation.phases.hoist_up.moves.hoist.ramp_s", 1e-5},
      {"operation.phases.hoist_up.moves.hoist.travel_m", 2e-6},
      {"operation.phases.settle.duration_s", 1e-6},
      {"taglines.tagline.kp_kN_per_deg", 1e-3},
      {"taglines.tagline.kd_kN_s_per_deg", 1e-3},
      {"taglines.tagline.pretension_kN", 1e-4},
      {"wires.fall.axial_stiffness_kN", 1e-3},
      {"wires.fall.damping_ratio", 1e-3},
      {"moorings.bow.stiffness_kN_per_m", 1e-3},
      {"moorings.bow.pretension_kN", 1e-3},
      {"bodies.load.mass_t", 1e-4},
      {"sea.states.swell.amplitude_m", 1e-4},
      {"sea.states.swell.phase_deg", 1e-3},
      {"sea.states.swell.heading_deg", 1e-5},
  }));
  check_key(c, key, step);
}

TEST_CASE("Derivatives by the factors of a gain schedule", "[tangent]") {
  // The falls shorten from 18 to 14 m in the run: through both points and the stretch between them.
  const Case c = small_lift({{"taglines.tagline.gain_schedule",
                              "[{ name = \"short\", fall_m = 15.0, kp_factor = 0.7, kd_factor = 1.4 }, { name = "
                              "\"long\", fall_m = 17.0 }]"}});
  check_key(c, "taglines.tagline.gain_schedule.short.kp_factor", 1e-3);
  check_key(c, "taglines.tagline.gain_schedule.long.kd_factor", 1e-3);
}

TEST_CASE("Derivatives by the initial state", "[tangent]") {
  const Case c = small_lift({{"taglines.tagline.active", "false"},
                             {"operation.phases.settle.duration_s", "5.013"},
                             {"operation.phases.hold.duration_s", "1.0"}});
  TangentRequest request;
  request.channels = {"load.x", "fall.tension"};
  request.by_initial_state = true;
  request.until = 8.0;
  const TangentRun run = run_with_tangents(c, request);
  REQUIRE(run.tangents.valid);
  const Model model = build_model(c.specification);
  const Operation operation = build_operation(model);
  const int n = model.system().coordinates(), load = model.body_index("load");
  const auto moved = [&](int direction, double by) {
    SystemState state = model.initial_state();
    BodyChange unit{MatrixX::Zero(n, 1), MatrixX::Zero(n, 1)};
    (direction < n ? unit.xi : unit.u)(direction % n, 0) = 1.0;
    displace_bodies(unit, 0, by, state.body);
    RunOptions options;
    options.from = &state;
    options.until = 8.0;
    return simulate(model, operation, options);
  };
  // The load's place, its turn, its speed, in x, y and z.
  for (const int direction : {6 * load, 6 * load + 1, 6 * load + 4, n + 6 * load, n + 6 * load + 2}) {
    for (std::size_t k = 0; k < 2; ++k) {
      const auto slope = [&](double h) {
        const Trajectory plus = moved(direction, h), minus = moved(direction, -h);
        const std::size_t channel = static_cast<std::size_t>(plus.find(request.channels[k]));
        std::vector<double> d;
        for (std::size_t i = 0; i < plus.time.size(); ++i)
          d.push_back((plus.values[channel][i] - minus.values[channel][i]) / (2.0 * h));
        return d;
      };
      const auto coarse = slope(1e-4), fine = slope(5e-5);
      double size = 0.0, error = 0.0, doubt = 0.0;
      for (std::size_t i = 0; i < coarse.size(); ++i) {
        const double truth = (4.0 * fine[i] - coarse[i]) / 3.0;
        size = std::max(size, std::abs(truth));
        doubt = std::max(doubt, std::abs(fine[i] - coarse[i]));
        error = std::max(error, std::abs(truth - run.tangents.values[k](static_cast<Eigen::Index>(i), direction)));
      }
      CAPTURE(direction, request.channels[k], size, error, doubt);
      // The start's own differences are of width 2e-6: rounding of the forces leaves 1e-5 in the wire.
      CHECK(doubt <= 1e-3 * size);
      CHECK(error <= 5e-5 * size + doubt);
    }
  }
}

// A load lifted off a deck fixed to the world: the next phase waits until it is clear.
Case lift_off_case() {
  return small_lift({
      {"contacts",
       "[{ name = \"deck\", role = \"pickup\", body = \"load\", points_m = [[0.5, 0.5, -1.0], [-0.5, 0.5, "
       "-1.0], [-0.5, -0.5, -1.0], [0.5, -0.5, -1.0]], surface_body = \"world\", surface_centre_m = [15.0, "
       "0.0, 5.0], surface_length_m = 10.0, surface_breadth_m = 10.0, stiffness_kN_per_m = 2.0e4, "
       "damping_kN_s_per_m = 60.0, friction = 0.3 }]"},
      {"wires.fall.unstretched_length_m", "18.2"},
      {"sea.states.swell.amplitude_m", "0.02"},
      {"taglines.tagline.active", "false"},
      {"operation.phases.hold.wait_for",
       "{ event = \"clear_of_contact\", contact = \"deck\", hold_s = 25.0, timeout_s = 300.0 }"},
  });
}

TEST_CASE("A phase that waits for a contact moves with the time of the parting", "[tangent]") {
  const Case c = lift_off_case();
  const std::string key = "operation.phases.hoist_up.moves.hoist.speed_m_per_min";
  TangentRequest request;
  request.keys = {key};
  request.channels = {"load.z", "fall.tension"};
  const TangentRun run = run_with_tangents(c, request);
  REQUIRE(run.trajectory.phases.size() == 3);
  REQUIRE_FALSE(run.trajectory.phases[2].event_timed_out);
  const auto start = [](const Trajectory& t) { return std::vector<double>{t.phases[2].start}; };
  const Differences truth = richardson(c, key, 1e-4 * key_value(c, key), start);
  CAPTURE(truth.value[0], run.tangents.phase_start[2][0], truth.doubt);
  // The parting is found by a straight line between two steps, in both; friction and the first instants of the contact
  // leave kinks of the size of the extrapolation.
  CHECK(std::abs(truth.value[0]) > 0.05);  // s per m/min: a faster hoist is clear earlier
  CHECK(run.tangents.phase_start[2][0] == Approx(truth.value[0]).epsilon(1e-4).margin(truth.doubt));
}

TEST_CASE("Gradients of objective and limits agree with differences of their smooth values", "[tangent]") {
  // The whole operation; for the gains also the hoisting alone, and the pose that it ends in.
  Case c = small_lift();
  c.plan.part = GENERATE(OperationPart{}, OperationPart{1, 0.0}, OperationPart{1, 20.0});
  if (!c.plan.part.whole())
    std::erase_if(c.plan.variables, [](const VariableSpec& v) { return v.key.starts_with("operation."); });
  const Evaluator evaluator(c);
  const Eigen::VectorXd x = evaluator.baseline();
  const Evaluation e = evaluator.evaluate_smooth(x, {}, true);
  REQUIRE(e.usable);
  REQUIRE(e.gradient_valid);
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const auto at = [&](double by) {
      Eigen::VectorXd y = x;
      y[j] += by;
      return evaluator.evaluate_smooth(y, {}, false);
    };
    const double h = 1e-4 * x[j];
    const auto slope = [&](double step) {
      const Evaluation plus = at(step), minus = at(-step);
      Eigen::VectorXd d(1 + plus.constraints.size());
      d << plus.objective - minus.objective, plus.constraints - minus.constraints;
      return Eigen::VectorXd(d / (2.0 * step));
    };
    const Eigen::VectorXd coarse = slope(h), fine = slope(0.5 * h), truth = (4.0 * fine - coarse) / 3.0;
    CAPTURE(evaluator.base().plan.variables[static_cast<std::size_t>(j)].key, truth[0], e.objective_gradient[j]);
    // The twins' width of 1e-4 squared; for the damping gain kinks of the pull-only law, in the differences, and what
    // Newton's method leaves over that width (1.2e-5 found).
    CHECK(std::abs(fine[0] - coarse[0]) <= 2e-5 * std::abs(truth[0]));
    CHECK(e.objective_gradient[j] == Approx(truth[0]).epsilon(2e-6).margin(1e-6));
    for (Eigen::Index i = 0; i < e.constraints.size(); ++i) {
      CAPTURE(evaluator.constraints()[static_cast<std::size_t>(i)].metric, truth[1 + i], e.constraint_jacobian(i, j));
      CHECK(e.constraint_jacobian(i, j) ==
            Approx(truth[1 + i]).epsilon(1e-4).margin(1e-9 + std::abs(fine[1 + i] - coarse[1 + i])));
    }
  }
}

TEST_CASE("The smooth objective has no jump where the end of a phase passes a step", "[tangent]") {
  // At 12 m/min, as the case has it, the hoisting and the operation end on steps of 0.02 s, at 12.03 m/min on samples.
  const Evaluator evaluator(read_case(kFolder + "/small_lift.toml", {{"solver.newton_tolerance", "1e-13"}}));
  Eigen::VectorXd x = evaluator.baseline();
  constexpr double kStep = 0.002;  // m/min
  const double from = GENERATE(11.996, 12.026);
  x[0] = from;
  Evaluation before = evaluator.evaluate_smooth(x, {}, true);
  for (int k = 1; k <= 4; ++k) {
    x[0] = from + k * kStep;
    Evaluation after = evaluator.evaluate_smooth(x, {}, true);
    REQUIRE(after.gradient_valid);
    const double by_gradients = 0.5 * (before.objective_gradient[0] + after.objective_gradient[0]);
    CAPTURE(x[0], before.objective_gradient[0], after.objective_gradient[0]);
    // The gradient itself changes by 5e-3 of its size a step of x where an end passes a sample.
    CHECK((after.objective - before.objective) / kStep == Approx(by_gradients).epsilon(1e-3));
    before = std::move(after);
  }
}

}  // namespace
}  // namespace stillhook
