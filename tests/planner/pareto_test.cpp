// The front between two metrics, as a user asks for it.
#include <nlohmann/json.hpp>

#include "problems/case.h"
#include "tests/planner/program.h"

namespace stillhook {
namespace {

using Catch::Matchers::Contains;

const std::string kCase = std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml";

std::vector<std::string> front_of(const std::string& out, const std::string& gradient, const std::string& more) {
  return {"plan",
          kCase,
          "--out",
          out,
          more,
          "--set",
          "plan.evaluations=6",
          "--set",
          "plan.global_algorithm=none",
          "--set",
          "plan.gradient_algorithm=" + gradient,
          "--set",
          "plan.gradient_evaluations=4",
          "--set",
          "plan.pareto.first=duration",
          "--set",
          "plan.pareto.second=daf_total",
          "--set",
          "plan.pareto.points=4",
          "--set",
          "plan.pareto.evaluations=8",
          "--quiet"};
}

TEST_CASE("plan traces the front between duration and DAF", "[cli][pareto]") {
  const Folder folder;
  const std::string gradient = GENERATE(as<std::string>(), "slsqp", "none");
  const Result r = run(folder, front_of("front", gradient, "--force"));
  INFO(r.err);
  REQUIRE(r.code == 0);
  CHECK(r.out.empty());  // --quiet
  CHECK_THAT(content(folder / "front/report.html"), Contains("Choice between"));
  const auto front = nlohmann::json::parse(content(folder / "front/summary.json"))["pareto"];
  CHECK(front["first"] == "duration");

  // Dominance, computed apart.
  const auto& points = front["points"];
  REQUIRE(points.size() >= 6);
  const auto beats = [](const auto& a, const auto& b) {
    return a["within_limits"] && a["first"] <= b["first"] && a["second"] <= b["second"] &&
           (a["first"] < b["first"] || a["second"] < b["second"]);
  };
  int on_front = 0;
  double quickest = 1e9, stillest = 1e9, slowest = 0.0;
  for (const auto& p : points) {
    const bool beaten = std::any_of(points.begin(), points.end(), [&](const auto& q) { return beats(q, p); });
    if (p["on_front"]) {
      ++on_front;
      CHECK_FALSE(beaten);
      quickest = std::min(quickest, p["first"].template get<double>());
      slowest = std::max(slowest, p["first"].template get<double>());
      stillest = std::min(stillest, p["second"].template get<double>());
    } else {
      CHECK((beaten || !p["within_limits"] || std::any_of(points.begin(), points.end(), [&](const auto& q) {
               return q["on_front"] && q["first"] == p["first"] && q["second"] == p["second"];
             })));
    }
  }
  CHECK(on_front >= 3);
  CHECK(slowest > quickest);
  // Nothing is quicker than the fastest hoisting: the end of the front is known without a search.
  const Result fastest =
      run(folder, {"simulate", kCase, "--set", "operation.phases.hoist_up.moves.hoist.speed_m_per_min=25", "--json",
                   "--quiet", "--out", "fastest", "--force"});
  const double least = nlohmann::json::parse(fastest.out)["metrics"]["duration"]["value"];
  CHECK(quickest >= least - 1e-9);
  CHECK(quickest == Approx(least).epsilon(0.02));  // a local search stops within 2 % of it

  // The same front again from what is stored, without simulating.
  const Result again = run(folder, front_of("front", gradient, "--resume"));
  REQUIRE(again.code == 0);
  CHECK(nlohmann::json::parse(content(folder / "front/summary.json"))["pareto"] == front);
  // And the drawing in a rebuilt report.
  std::filesystem::remove(folder / "front/report.html");
  REQUIRE(run(folder, {"report", "front"}).code == 0);
  CHECK_THAT(content(folder / "front/report.html"), Contains("Choice between"));
}

TEST_CASE("a front of what is no pair of metrics is refused", "[cli][pareto][bad_input]") {
  const Folder folder;
  const auto refused = [&](const std::string& first, const std::string& second) {
    const Result r =
        run(folder, {"plan", kCase, "--set", "plan.pareto.first=" + first, "--set", "plan.pareto.second=" + second});
    CHECK(r.code == 2);
    return r.err;
  };
  CHECK_THAT(refused("duration", "sway_pek"), Contains("did you mean \"sway_peak\"?"));
  CHECK_THAT(refused("duration", "duration"), Contains("a front needs two"));
  CHECK_THAT(refused("duration", "slack_ratio_min"), Contains("better when larger"));
}

}  // namespace
}  // namespace stillhook
