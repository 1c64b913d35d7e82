// From outcomes of scenarios to objective, constraints and grades; and the whole way from x to an evaluation on a small
// lift in waves.
#include "problems/evaluator.h"

#include <omp.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <thread>

#include "problems/scenarios.h"
#include "sim/simulate.h"
#include "sim/spatial/constants.h"

using namespace stillhook;

namespace {

const std::string kCase = std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml";

Case small_lift(const std::vector<Override>& overrides = {}) { return read_case(kCase, overrides); }

/// An outcome with the metrics given and the others absent.
ScenarioOutcome outcome(const Evaluator& evaluator, std::vector<std::pair<std::string, double>> values) {
  ScenarioOutcome o;
  o.status = RunStatus::completed;
  o.reached = 1.0;
  o.metrics.assign(evaluator.metric_names().size(), kNaN);
  for (const auto& [name, value] : values)
    for (std::size_t i = 0; i < o.metrics.size(); ++i)
      if (evaluator.metric_names()[i] == name) o.metrics[i] = value;
  return o;
}

ScenarioOutcome usual(const Evaluator& e, double sway, double offlead) {
  return outcome(
      e, {{"sway_rms", sway}, {"duration", 80.0}, {"offlead_max", offlead}, {"daf_total", 1.2}, {"heel_max", 1}});
}

bool same_bits(const Evaluation& a, const Evaluation& b) {
  bool details = a.details.size() == b.details.size();
  for (std::size_t i = 0; details && i < a.details.size(); ++i)
    details = a.details[i] == b.details[i] || (std::isnan(a.details[i]) && std::isnan(b.details[i]));
  return details && a.usable == b.usable && a.objective == b.objective && a.constraints == b.constraints;
}

}  // namespace

TEST_CASE("the objective is the weighted sum of scaled metrics, mean or worst over scenarios") {
  Case c = small_lift();  // sway_rms / 0.1 + 0.5 duration / 100
  c.plan.scenarios[0].weight = 3.0;
  c.plan.scenarios[1].weight = 1.0;
  const Evaluator mean(c);
  const auto outcomes = std::vector{usual(mean, 0.2, 3), usual(mean, 0.4, 5)};
  const Evaluation e = mean.aggregated(outcomes);
  CHECK(e.usable);
  CHECK(e.objective == Approx((3 * (2.0 + 0.4) + (4.0 + 0.4)) / 4));
  const std::vector<TermValue> terms = mean.terms(e);
  REQUIRE(terms.size() == 2);
  CHECK(terms[0].value + terms[1].value == Approx((3 * 0.2 + 0.4) / 4 + 80.0));
  CHECK(terms[0].contribution + terms[1].contribution == Approx(e.objective));

  c.plan.aggregate = PlanSpec::Aggregate::worst;
  const Evaluator worst(c);
  const Evaluation w = worst.aggregated(outcomes);
  CHECK(w.objective == Approx(4.4));  // weights say how often, not how bad
  CHECK(worst.terms(w)[0].contribution + worst.terms(w)[1].contribution == Approx(4.4));
}

TEST_CASE("constraints are the worst over the scenarios, scaled by the limit") {
  Case c = small_lift();
  c.limits = {{"offlead_max", 4.0, {}, "", true},
              {"slack_ratio_min", {}, 0.1, "", true},
              {"rehits", 0.0, {}, "", true},
              {"setdown_offset", 0.0, {}, "", true},
              {"heel_max", 1.0, {}, "", false}};  // soft: no constraint
  const Evaluator evaluator(c);
  ScenarioOutcome a = outcome(evaluator, {{"sway_rms", 1},
                                          {"duration", 1},
                                          {"offlead_max", 3},
                                          {"slack_ratio_min", 0.05},
                                          {"rehits", 0},
                                          {"setdown_offset", 0.3},
                                          {"heel_max", 9}});
  ScenarioOutcome b = outcome(
      evaluator,
      {{"sway_rms", 1}, {"duration", 1}, {"offlead_max", 5}, {"slack_ratio_min", 0.4}, {"rehits", 2}, {"heel_max", 9}});
  const Evaluation e = evaluator.aggregated({a, b});
  REQUIRE(e.constraints.size() == 4);
  CHECK(e.constraints[0] == Approx((5.0 - 4.0) / 4.0));
  CHECK(e.constraints[1] == Approx((0.1 - 0.05) / 0.1));
  CHECK(e.constraints[2] == Approx(2.0));  // a count from zero: one is 1
  CHECK(e.constraints[3] == Approx(3.0));  // 0.3 m in steps of 0.1; the one that is missing counts as 1
  CHECK(e.usable);
  CHECK(evaluator.problem().constraint_names ==
        std::vector<std::string>{"offlead_max max", "slack_ratio_min min", "rehits max", "setdown_offset max"});
  // Feasible exactly when every check of the results passes.
  b = a = outcome(evaluator, {{"sway_rms", 1},
                              {"duration", 1},
                              {"offlead_max", 4},
                              {"slack_ratio_min", 0.1},
                              {"rehits", 0},
                              {"setdown_offset", 0}});
  CHECK(evaluator.aggregated({a, b}).violation() == 0.0);
}

TEST_CASE("what could not be completed is graded by how far it got, and never beats what could") {
  const Evaluator evaluator(small_lift());
  ScenarioOutcome good = usual(evaluator, 0.2, 3);
  double before = std::numeric_limits<double>::infinity();
  Evaluation previous;
  for (const double reached : {0.0, 0.2, 0.7, 0.99}) {
    ScenarioOutcome bad = usual(evaluator, kNaN, kNaN);
    bad.status = reached > 0.0 ? RunStatus::diverged : RunStatus::not_run;
    bad.reached = reached;
    bad.message = "diverged at the hinge";
    const Evaluation e = evaluator.aggregated({good, bad});
    CHECK_FALSE(e.usable);
    CHECK(std::isfinite(e.objective));
    CHECK(e.objective < before);
    CHECK(e.constraints.size() == 3);
    CHECK(e.constraints.minCoeff() > 0.0);
    CHECK_THAT(e.message, Catch::Contains("from_ahead") && Catch::Contains("diverged at the hinge"));
    if (reached > 0.0) CHECK(better(e, previous));
    CHECK(better(evaluator.aggregated({usual(evaluator, 90, 90), good}), e));
    before = e.objective;
    previous = e;
  }
  // Completed, but a term of the objective does not exist: not a number must not get out.
  const Evaluation e = evaluator.aggregated({good, usual(evaluator, kNaN, 3)});
  CHECK_FALSE(e.usable);
  CHECK(std::isfinite(e.objective));
  CHECK(e.objective < before);
  CHECK(e.constraints.allFinite());
}

TEST_CASE("details give every scenario's metrics back") {
  const Evaluator evaluator(small_lift());
  ScenarioOutcome a = usual(evaluator, 0.2, 3), b = usual(evaluator, 0.3, 4);
  b.status = RunStatus::diverged;
  b.reached = 0.25;
  const Evaluation e = evaluator.aggregated({a, b});
  const std::vector<ScenarioOutcome> back = evaluator.outcomes(e);
  REQUIRE(back.size() == 2);
  CHECK(back[0].status == RunStatus::completed);
  CHECK(back[1].status == RunStatus::diverged);
  CHECK(back[1].reached == 0.25);
  for (std::size_t i = 0; i < a.metrics.size(); ++i)
    CHECK((back[0].metrics[i] == a.metrics[i] || (std::isnan(back[0].metrics[i]) && std::isnan(a.metrics[i]))));
}

TEST_CASE("a scenario changes its sea and nothing else") {
  const Case c = small_lift();
  ScenarioSpec scenario;
  scenario.name = "s";
  scenario.sea = "wind_sea";
  scenario.seed = 77;
  scenario.heading = 0.5;
  const Specification changed = in_scenario(c.specification, scenario);
  CHECK(changed.sea.active == "wind_sea");
  CHECK(changed.sea.states[1].seed == 77);
  CHECK(changed.sea.states[1].heading == 0.5);
  CHECK(changed.sea.states[0].heading == c.specification.sea.states[0].heading);
  scenario.phase = 0.1;
  CHECK_THROWS_WITH(in_scenario(c.specification, scenario), Catch::Contains("phase_deg"));
  scenario.sea = "swell";
  CHECK_THROWS_WITH(in_scenario(c.specification, scenario), Catch::Contains("seed"));
  scenario.seed.reset();
  CHECK(in_scenario(c.specification, scenario).sea.states[0].phase == 0.1);
  scenario.sea = "swel";
  CHECK_THROWS_WITH(in_scenario(c.specification, scenario), Catch::Contains("swel"));
  Case without = c;
  without.plan.scenarios.clear();
  REQUIRE(scenarios_of(without).size() == 1);
  CHECK(scenarios_of(without)[0].sea == "swell");
}

TEST_CASE("a plan without objective or with the baseline out of bounds is refused") {
  Case c = small_lift();
  c.plan.objective.clear();
  CHECK_THROWS_WITH(Evaluator(c), Catch::Contains("plan.objective"));
  c = small_lift();
  c.plan.variables.clear();
  CHECK_THROWS_WITH(Evaluator(c), Catch::Contains("plan.variables"));
  c = small_lift();
  c.plan.variables[0].lower = 13.0;
  CHECK_THROWS_WITH(Evaluator(c), Catch::Contains("speed_m_per_min") && Catch::Contains("has 12, outside"));
}

TEST_CASE("the same x gives the same bits with any number of threads and from several threads at once") {
  const Evaluator evaluator(small_lift());
  Eigen::VectorXd x = evaluator.baseline();
  x[0] = 9.37;
  x[1] = 0.31;
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Evaluation one = evaluator.evaluate(x);
  omp_set_num_threads(2);
  const Evaluation two = evaluator.evaluate(x);
  CHECK(one.usable);
  CHECK(same_bits(one, two));
  Evaluation a, b;
  std::thread first([&] { a = evaluator.evaluate(x); });
  std::thread second([&] { b = evaluator.evaluate(x); });
  first.join();
  second.join();
  omp_set_num_threads(threads);
  CHECK(same_bits(one, a));
  CHECK(same_bits(one, b));
  CHECK_FALSE(same_bits(one, evaluator.evaluate(evaluator.baseline())));
  // The two scenarios are two different seas.
  const std::vector<ScenarioOutcome> outcomes = evaluator.outcomes(one);
  CHECK(outcomes[0].metrics != outcomes[1].metrics);
}

TEST_CASE("an operation that cannot be built is graded, not thrown") {
  const Evaluator evaluator(small_lift());
  Eigen::VectorXd x = evaluator.baseline();
  x[0] = 40.0;  // the winch makes 30 m/min
  const Evaluation fast = evaluator.evaluate(x);
  CHECK_FALSE(fast.usable);
  CHECK(fast.objective == 2000.0);
  CHECK(fast.constraints.minCoeff() == 2.0);
  CHECK_FALSE(fast.message.empty());
  x[0] = -1.0;  // the case itself refuses a negative speed
  const Evaluation refused = evaluator.evaluate(x);
  CHECK_FALSE(refused.usable);
  CHECK(refused.objective == 2000.0);
}

TEST_CASE("a stop flag interrupts the evaluation under way") {
  const std::atomic<bool> stop = true;
  const Evaluator evaluator(small_lift(), &stop);
  const Evaluation e = evaluator.evaluate(evaluator.baseline());
  CHECK(e.interrupted);
  CHECK_FALSE(e.usable);
}

TEST_CASE("where the variables are timing alone the lift that is taken over gives the bits of one built for itself") {
  Case c = small_lift();
  std::erase_if(c.plan.variables, [](const VariableSpec& v) { return !v.key.starts_with("operation.phases."); });
  REQUIRE(c.plan.variables.size() == 1);
  const Evaluator evaluator(c);
  Eigen::VectorXd x = evaluator.baseline();
  x[0] = 7.3;
  const std::vector<ScenarioOutcome> outcomes = evaluator.outcomes(evaluator.evaluate(x));
  const std::vector<ScenarioSpec>& scenarios = evaluator.scenarios();
  REQUIRE(outcomes.size() == scenarios.size());
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    const Specification specification = in_scenario(evaluator.case_at(x).specification, scenarios[i]);
    const Model model = build_model(specification);
    const Metrics metrics = compute_metrics(specification, simulate(model, build_operation(model)));
    for (std::size_t k = 0; k < evaluator.metric_names().size(); ++k) {
      CAPTURE(evaluator.metric_names()[k]);
      const double alone = metrics.value(evaluator.metric_names()[k]), taken_over = outcomes[i].metrics[k];
      CHECK((alone == taken_over || (std::isnan(alone) && std::isnan(taken_over))));
    }
  }
}
