// A point of a search whose simulation diverges: unusable, worse than any that completes, and the worse the sooner it
// diverged, so that the search is led out.
#include <catch2/catch.hpp>

#include "problems/evaluator.h"
#include "problems/search/solve.h"

using namespace stillhook;

namespace {

const std::string kDiverging = std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/diverging.toml";

Evaluation at_speed(const Evaluator& evaluator, double speed) {
  return evaluator.evaluate(Eigen::VectorXd::Constant(1, speed));
}

}  // namespace

TEST_CASE("a simulation that diverges within a search is graded by how far it got") {
  const Evaluator evaluator(read_case(kDiverging));
  const Evaluation completes = at_speed(evaluator, 1e3), late = at_speed(evaluator, 2e4),
                   soon = at_speed(evaluator, 4e4);
  CHECK(completes.usable);
  CHECK(completes.objective == Approx(1.0));  // 8 s over 8 s
  CHECK_FALSE(late.usable);
  CHECK_FALSE(soon.usable);
  // 1000 (2 - share reached), of 8 s: 1e5 m are reached after 5 s and 2.5 s, the last sample is up to 0.1 s before.
  const double sample = 1000.0 * 0.15 / 8.0;  // with half a sample for rounding
  CHECK(late.objective == Approx(1000.0 * (2.0 - 5.0 / 8.0)).margin(sample));
  CHECK(soon.objective == Approx(1000.0 * (2.0 - 2.5 / 8.0)).margin(sample));
  REQUIRE(late.constraints.size() == 1);
  CHECK(late.constraints[0] == Approx(2.0 - 5.0 / 8.0).margin(sample / 1000.0));
  CHECK(completes.constraints[0] <= 0.0);
  // At 5 s, or a step of 0.01 s later, as 1e5 m are rounded.
  CHECK_THAT(late.message, (Catch::Contains("diverged at t = 5 s") || Catch::Contains("diverged at t = 5.01 s")) &&
                               Catch::Contains("in phase 'wait'") && Catch::Contains("body 'shot' has left the scene"));
  const std::vector<ScenarioOutcome> outcomes = evaluator.outcomes(late);
  REQUIRE(outcomes.size() == 1);
  CHECK(outcomes[0].status == RunStatus::diverged);
  CHECK(outcomes[0].reached == Approx(5.0 / 8.0).margin(0.15 / 8.0));
}

TEST_CASE("a search whose beginning diverges finds what does not") {
  const Evaluator evaluator(read_case(kDiverging));
  SolveOptions options;
  options.solver = "cobyla";
  options.evaluations = 20;
  const SearchReport report = solve(evaluator.problem(), options);
  CHECK(report.feasible);
  CHECK(report.best.usable);
  CHECK(report.best_x[0] < 1e5 / 8.0);  // m/s
}
