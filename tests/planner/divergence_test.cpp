// A run that diverges, as a user meets it: exit code 4, a sentence with body, time and phase, and a folder with what
// came before; a search that goes on over such points.
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/planner/program.h"

using namespace stillhook;
namespace fs = std::filesystem;
using nlohmann::json;

namespace {
const std::string kDiverging = std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/diverging.toml";
}

TEST_CASE("simulate: a run that diverges ends with exit code 4, says where, and leaves its folder") {
  const Folder folder;
  const Result result = run(folder, {"simulate", kDiverging, "--json", "--out", "out"});
  CHECK(result.code == 4);
  for (const char* part : {"diverged at t = 5.0", "in phase 'wait'", "body 'shot' has left the scene"})
    CHECK_THAT(result.err, Catch::Contains(part));
  CHECK_THAT(result.err, !Catch::Contains("diverged: diverged"));
  const json summary = json::parse(result.out);
  CHECK(summary.at("status").dump().find("diverged") != std::string::npos);
  CHECK(summary.dump().find("body 'shot' has left the scene") != std::string::npos);
  for (const char* file : {"case.toml", "history.nc", "summary.json", "report.html"}) {
    CAPTURE(file);
    CHECK(fs::exists(folder / (std::string("out/") + file)));
  }
  CHECK_THAT(content(folder / "out/report.html"), Catch::Contains("diverged"));
  // What came before can be exported.
  CHECK(run(folder, {"export", "out", "--csv"}).code == 0);
}

TEST_CASE("plan: points that diverge are passed over") {
  const Folder folder;
  const Result result = run(folder, {"plan", kDiverging, "--json", "--out", "out", "--evaluations", "20"});
  CHECK(result.code == 0);
  const json summary = json::parse(result.out);
  CHECK(summary.at("variables").at(0).at("plan").get<double>() < 1e5 / 8.0);  // m/s; the case itself has 2e4
}

TEST_CASE("plan: where every point diverges there is no plan, and the program says so") {
  const Folder folder;
  const Result result = run(folder, {"plan", kDiverging, "--out", "out", "--evaluations", "4", "--set",
                                     "plan.variables.\"bodies.shot.velocity_m_per_s.0\".min=19000"});
  CHECK((result.code == 3 || result.code == 4));
  CHECK_FALSE(result.err.empty());
}
