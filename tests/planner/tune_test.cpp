// `stillhook tune`, and `plan` with gradients and certification, as a user runs them.
#include <nlohmann/json.hpp>

#include "problems/case.h"
#include "tests/planner/program.h"

namespace stillhook {
namespace {

using Catch::Matchers::Contains;

const std::string kCase = std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml";

TEST_CASE("tune lowers the objective and leaves a case that simulate takes", "[cli][tune]") {
  const Folder folder;
  const Result r = run(folder, {"tune", kCase, "--out", "tuned", "--evaluations", "12", "--json", "--quiet"});
  INFO(r.err);
  REQUIRE(r.code == 0);
  const auto summary = nlohmann::json::parse(r.out);
  CHECK(summary["verb"] == "tune");
  CHECK(summary["objective"]["plan"].get<double>() < summary["objective"]["baseline"].get<double>());
  REQUIRE(summary["variables"].size() == 2);
  const Case tuned = read_case(folder / "tuned/tuned.toml");
  for (const auto& v : summary["variables"])
    CHECK(key_value(tuned, v["name"].get<std::string>()) == Approx(v["plan"].get<double>()).epsilon(1e-12));
  CHECK_THAT(content(folder / "tuned/report.html"), Contains("Damping of the swing") && Contains("Winches"));
  CHECK(run(folder, {"simulate", folder / "tuned/tuned.toml", "--quiet"}).code == 0);
}

TEST_CASE("tune says what the model leaves out, as the other verbs do", "[cli][tune]") {
  const Folder folder;
  // In the shallow water of 8 m the swell of 7 s feels the bottom; the barge's lines do not hold it sideways.
  const Result r = run(folder, {"tune", kCase, "--out", "t", "--evaluations", "3", "--json", "--set", "sea.depth_m=8"});
  INFO(r.err);
  REQUIRE(r.code == 0);
  CHECK_THAT(r.err, Contains("warning: the waves feel the bottom") && Contains("barge is not held in y"));
  const auto warnings = nlohmann::json::parse(r.out)["warnings"].dump();
  CHECK_THAT(warnings, Contains("the waves feel the bottom") && Contains("barge is not held in y"));
  CHECK_THAT(content(folder / "t/report.html"), Contains("the waves feel the bottom"));
}

TEST_CASE("tune: the verdict is that of its limits, and the map shows objectives", "[cli][tune]") {
  const Folder folder;
  const Result r = run(folder, {"tune", kCase, "--out", "t", "--evaluations", "4", "--map", "3", "--json", "--quiet"});
  INFO(r.err);
  REQUIRE(r.code == 0);
  const auto summary = nlohmann::json::parse(r.out);
  for (const auto& limit : summary["limits"]) CHECK(limit["pass"].get<bool>());
  CHECK(summary["within_limits"].get<bool>());
  CHECK(summary["metrics"].size() > 10);
  // Gains outside the bounds of [plan.variables] make no case that can be read: the search and the map keep within.
  CHECK(summary["variables"][0]["lower"] == 0.01);
  CHECK(summary["variables"][0]["upper"] == 2.0);
  CHECK(summary["variables"][1]["upper"] == 4.0);
  const std::string page = content(folder / "t/report.html");
  CHECK_THAT(page, Contains("Objective over the gains") && !Contains("best inf") && !Contains("fill=\"#ddd\""));
  // A limit that no gain keeps: the verdict says so, and the exit code.
  const Result broken = run(folder, {"tune", kCase, "--out", "b", "--evaluations", "3", "--json", "--quiet", "--set",
                                     "limits.offlead_max.max=0.01"});
  CHECK(broken.code == 3);
  CHECK_FALSE(nlohmann::json::parse(broken.out)["within_limits"].get<bool>());
}

TEST_CASE("tune without a tagline is refused", "[cli][tune][bad_input]") {
  const Folder folder;
  const Result r = run(folder, {"tune", kCase, "--set", "taglines.tagline.active=false"});
  CHECK(r.code == 2);
  CHECK_THAT(r.err, Contains("no active tagline"));
}

TEST_CASE("plan follows gradients and certifies in conditions it has not seen", "[cli][plan]") {
  const Folder folder;
  const Result r = run(folder, {"plan", kCase, "--out", "plan", "--evaluations", "6", "--set",
                                "plan.gradient_algorithm=slsqp", "--set", "plan.gradient_evaluations=5", "--set",
                                "plan.global_algorithm=none", "--set", "plan.certify=3"});
  INFO(r.err);
  REQUIRE(r.code == 0);
  CHECK_THAT(r.out, Contains("slsqp+cobyla") && Contains("In 6 fresh conditions"));
  CHECK_THAT(content(folder / "plan/report.html"), Contains("What moves what at the plan") &&
                                                       Contains("What the limits cost") &&
                                                       Contains("conditions the search has not seen"));
  const auto summary = nlohmann::json::parse(content(folder / "plan/summary.json"));
  const auto& certificate = summary["certificate"];
  CHECK(certificate["conditions"] == 6);
  CHECK(certificate["improvement"]["mean"].get<double>() ==
        Approx(certificate["objective"]["baseline"]["mean"].get<double>() -
               certificate["objective"]["plan"]["mean"].get<double>()));
  CHECK(summary["objective"]["plan"].get<double>() < summary["objective"]["baseline"].get<double>());
}

TEST_CASE("an unknown gradient algorithm is refused", "[cli][plan][bad_input]") {
  const Folder folder;
  const Result r = run(folder, {"plan", kCase, "--set", "plan.gradient_algorithm=newton"});
  CHECK(r.code == 2);
  CHECK_THAT(r.err, Contains("gradient_algorithm"));
}

}  // namespace
}  // namespace stillhook
