// One verdict for a plan over several scenarios: search, tables, summary and page by the same rule.
#include <nlohmann/json.hpp>

#include "planner/verbs/plan/plan_results.h"
#include "problems/case_reader.h"
#include "sim/spatial/constants.h"
#include "tests/planner/program.h"

namespace stillhook {
namespace {

using Json = nlohmann::json;
using Catch::Matchers::Contains;

const std::string kCase = std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml";

ScenarioOutcome outcome(const Evaluator& e, double daf, double heel) {
  ScenarioOutcome o;
  o.status = RunStatus::completed;
  o.reached = 1.0;
  for (const std::string& name : e.metric_names())
    o.metrics.push_back(name == "daf_total"                                            ? daf
                        : name == "heel_max"                                           ? heel
                        : name == "sway_rms" || name == "duration" || name == "offlead_max" ? 1.0
                                                                                            : kNaN);
  return o;
}

TEST_CASE("a limit is that of the scenario that decides, and so is the metric it limits", "[plan]") {
  const Evaluator e(read_case(kCase));
  REQUIRE(e.scenarios().size() == 2);
  // daf_total at most 1.5, heel_max at most 5: each is decided in another scenario.
  const Evaluation evaluation = e.aggregated({outcome(e, 1.41, 2.0), outcome(e, 1.07, 5.5)});
  const std::vector<LimitCheck> limits = deciding_limits(e, evaluation);
  const Metrics metrics = deciding_metrics(e, evaluation);
  for (const LimitCheck& limit : limits) {
    CAPTURE(limit.metric);
    CHECK(metrics.value(limit.metric) == limit.value);
    CHECK(metrics.find(limit.metric)->scenario == limit.scenario);
    if (limit.metric == "daf_total") CHECK((limit.value == 1.41 && limit.scenario == "from_aft" && limit.pass));
    if (limit.metric == "heel_max") CHECK((limit.value == 5.5 && limit.scenario == "from_ahead" && !limit.pass));
  }
  CHECK_FALSE(within_limits(metrics, limits));
  CHECK(evaluation.violation() > 0.0);
}

TEST_CASE("a limit that a share of the scenarios may break is judged as the search judges it", "[plan]") {
  Case c = read_case(kCase);
  for (LimitSpec& limit : c.limits)
    if (limit.metric == "heel_max") limit.share = 0.5;
  const Evaluator e(c);
  const Evaluation allowed = e.aggregated({outcome(e, 1.0, 2.0), outcome(e, 1.0, 5.5)});
  CHECK(allowed.violation() <= 0.0);
  CHECK(within_limits(deciding_metrics(e, allowed), deciding_limits(e, allowed)));
  const Evaluation broken = e.aggregated({outcome(e, 1.0, 5.1), outcome(e, 1.0, 5.5)});
  CHECK(broken.violation() > 0.0);
  CHECK_FALSE(within_limits(deciding_metrics(e, broken), deciding_limits(e, broken)));
}

TEST_CASE("a scenario that fails fails the plan, whichever is shown", "[plan]") {
  const Evaluator e(read_case(kCase));
  Metrics sound, parted;
  sound.status = RunStatus::completed;
  parted.status = RunStatus::failed;
  parted.message = "wire fall parts";
  const Metrics metrics = deciding_metrics(e, {sound, parted}, {}, 0);
  CHECK(metrics.status == RunStatus::failed);
  CHECK(metrics.message == "from_ahead: wire fall parts");
}

int broken_in(const Json& summary) {
  int broken = 0;
  for (const Json& limit : summary.at("limits")) broken += !limit.at("pass").get<bool>() && limit.at("hard").get<bool>();
  return broken;
}

TEST_CASE("plan: page, terminal and summary say the same of every limit", "[cli][plan]") {
  const Folder folder;
  // No plan keeps an off-lead of 0.05 deg in waves; the heel from aft and from ahead differ.
  const Result r = run(folder, {"plan", kCase, "--out", "p", "--evaluations", "3", "--json", "--set",
                                "limits.offlead_max.max=0.05", "--set", "plan.random_search=false"});
  CHECK(r.code == 3);
  const Json summary = Json::parse(r.out);
  CHECK_FALSE(summary.at("within_limits").get<bool>());
  const Json& metrics = summary.at("metrics");
  for (const Json& limit : summary.at("limits")) {
    const std::string name = limit.at("name");
    CAPTURE(name);
    CHECK(metrics.at(name).at("value") == limit.at("value"));
    CHECK(metrics.at(name).at("scenario") == limit.at("scenario"));
  }
  const std::string headline =
      "Outside limits: " + std::to_string(broken_in(summary)) + " of " + std::to_string(summary.at("limits").size());
  CHECK_THAT(content(folder / "p/report.html"), Contains(headline));
  std::filesystem::remove(folder / "p/report.html");
  CHECK(run(folder, {"report", "p"}).code == 0);
  CHECK_THAT(content(folder / "p/report.html"), Contains(headline));
}

TEST_CASE("plan never breaks more limits than the case with a worse objective", "[cli][plan]") {
  const Folder folder;
  // The slower the hoist, the less its limit of 3 m/min is broken: the search goes to the slowest. Below 5.7 m/min
  // (43 s + 240 s m/min / speed > 85 s) the time is out as well, and the objective is the time. The case at 12 m/min
  // breaks the first limit alone. Twelve points would not bring the search below 5.7 m/min, forty do.
  const Result r = run(
      folder, {"plan", kCase, "--out", "p", "--evaluations", "40", "--json", "--set", "plan.random_search=false",
               "--set", "limits={ \"winch_speed_max.hoist\" = { max = 0.05, source = \"made up\" }, duration = { max "
                        "= 85.0, source = \"made up\" } }",
               "--set", "plan.objective={ duration = { weight = 1.0, scale = 100.0 } }"});
  CHECK(r.code == 3);
  const Json summary = Json::parse(r.out);
  CAPTURE(r.out);
  CHECK(summary.at("objective").at("plan").get<double>() <= summary.at("objective").at("baseline").get<double>());
  CHECK(broken_in(summary) <= 1);
  CHECK_THAT(content(folder / "p/report.html"), Contains("the case stays"));  // the search did come to such a point
  CHECK(content(folder / "p/plan.toml").find("speed_m_per_min = 12") != std::string::npos);
}

}  // namespace
}  // namespace stillhook
