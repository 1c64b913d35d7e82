// Tuning over a part of the operation, over the fall length, and against a grid.
#include "tuning/gains.h"

#include <catch2/catch.hpp>

namespace stillhook {
namespace {

using Catch::Matchers::Contains;

Case small_lift(std::vector<Override> more = {}) {
  more.push_back({"tune.evaluations", "12"});
  return read_case(std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml", more);
}

TEST_CASE("gains are tuned for one pose and for one phase", "[tune]") {
  const auto [key, part] = GENERATE(table<std::string, OperationPart>(
      {{"tune.pose", OperationPart{1, 40.0}}, {"tune.phase", OperationPart{1, 0.0}}}));
  std::vector<std::string> left_out;
  const Case c = tuning_case(small_lift({{key, "hoist_up"}, {"tune.hold_s", "40.0"}}), &left_out);
  CHECK(c.plan.part.phase == part.phase);
  CHECK(c.plan.part.hold == part.hold);
  CHECK(left_out.empty());  // of this lift every term and limit exists while the load hangs
  const Evaluator evaluator(c);
  const GainTuning r = tune_gains(evaluator);
  REQUIRE(r.baseline.usable);
  CHECK(r.improved);
  CHECK(r.tuned.objective < r.baseline.objective);
  REQUIRE(r.after.size() == 2);  // both swings of one pose
  CHECK(r.after[0].pose == "hoist_up");
  CHECK_FALSE(r.schedule);
}

TEST_CASE("a part that the case does not have, or two of them, are refused", "[tune][bad_input]") {
  CHECK_THROWS_WITH(tuning_case(small_lift({{"tune.phase", "hoist_up"}, {"tune.pose", "hold"}})),
                    Contains("one of them, not both"));
  CHECK_THROWS_WITH(small_lift({{"tune.phase", "hoist_down"}}), Contains("hoist_down"));
}

TEST_CASE("a gain schedule is tuned from the pair on and judged against it", "[tune]") {
  const Evaluator evaluator(tuning_case(small_lift({{"tune.schedule", "true"}, {"tune.evaluations", "6"}})));
  const GainTuning r = tune_gains(evaluator);
  REQUIRE(r.schedule);
  const GainSchedule& s = *r.schedule;
  INFO(s.message);
  REQUIRE(s.points.size() == 2);
  // 18 m unstretched at the start, four metres shorter at the end.
  CHECK(s.points[0].fall == Approx(14.0).margin(0.1));
  CHECK(s.points[1].fall == Approx(18.0).margin(0.1));
  REQUIRE(s.evaluation.usable);
  CHECK(s.evaluation.objective <= r.tuned.objective + 1e-9);  // factors of one are where the search begins
  REQUIRE(s.scheduled);
  CHECK(key_value(*s.scheduled, "taglines.tagline.gain_schedule.short.kp_factor") == s.points[0].kp_factor);
  CHECK(key_value(*s.scheduled, "taglines.tagline.kp_kN_per_deg") == Approx(r.gains[0]).epsilon(1e-12));
  CHECK(s.worth_it == (s.evaluation.objective < r.tuned.objective - 0.01 * std::abs(r.tuned.objective) &&
                       s.evaluation.violation() <= std::max(0.0, r.tuned.violation())));
}

TEST_CASE("tuned gains beat the case's and a grid's of ten times the simulations", "[tune][slow]") {
  const Evaluator evaluator(tuning_case(small_lift({{"tune.pose", "hoist_up"}, {"tune.hold_s", "60.0"}})));
  const GainTuning r = tune_gains(evaluator);
  const auto& v = evaluator.base().plan.variables;
  constexpr int kSide = 20;
  std::optional<Evaluation> best;
  double simulations = 0.0;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const auto on = [](const VariableSpec& w, int k) { return w.lower + (w.upper - w.lower) * k / (kSide - 1); };
      const Evaluation e = evaluator.evaluate(Eigen::Vector2d(on(v[0], j), on(v[1], i)));
      simulations += static_cast<double>(evaluator.scenarios().size());
      if (!best || better(e, *best, 0.0)) best = e;
    }
  CAPTURE(r.baseline.objective, r.tuned.objective, best->objective, r.simulations, simulations, r.gains.transpose());
  CHECK(r.tuned.violation() <= 0.0);
  CHECK(r.tuned.objective < r.baseline.objective);
  // As good as the best of the grid, where that lies in a corner of the bounds; better elsewhere.
  CHECK(r.tuned.objective <= best->objective * (1.0 + 1e-3));
  CHECK(10.0 * r.simulations <= simulations);
}

}  // namespace
}  // namespace stillhook
