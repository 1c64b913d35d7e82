// Wind and current as `check` prints them, against numbers worked out by hand; a run in gusts from end to end.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/planner/program.h"

using namespace stillhook;

namespace {

const std::string kSmallLift = std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml";
const std::vector<std::string> kWindy = {
    "--set",
    R"(wind={ speed_m_per_s = 10.0, towards_deg = 90.0, profile = "constant", spectrum = "npd" })",
    "--set",
    R"(wind_areas=[{ name = "sail", body = "load", areas_m2 = [10.0, 10.0, 10.0] }])",
    "--set",
    "sea.current={ speed_m_per_s = 1.0, towards_deg = 90.0 }",
    "--set",
    R"(current_hulls=[{ name = "wet", body = "barge", drag = [0.08, 0.8], reference_m = [0.0, 0.0, 0.0], length_m = 40.0, draft_m = 2.0 }])"};

std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

nlohmann::json summary_in(const std::string& folder) {
  std::ifstream in(folder + "/summary.json");
  return nlohmann::json::parse(in);
}

}  // namespace

TEST_CASE("check prints what wind and current do", "[check][wind][current]") {
  const Folder folder;
  const Result check = run(folder, with({"check", kSmallLift, "--json"}, kWindy));
  INFO(check.err);
  REQUIRE(check.code == 0);
  std::map<std::string, nlohmann::json> tables;
  const auto document = nlohmann::json::parse(check.out);
  for (const auto& table : document["tables"]) tables[table["title"]] = table["rows"];

  // 10 m/s at all heights; gusts of ISO 19901-1 at 10 m: 11.4403 and 12.4941 m/s, band 0.8714 m/s (six digits of
  // truths).
  const auto reference = tables["Wind"][0];
  CHECK(reference[2].get<double>() == Approx(10.0));
  CHECK(reference[3].get<double>() == Approx(11.44));
  CHECK(reference[4].get<double>() == Approx(12.49));
  CHECK(reference[5].get<double>() == Approx(0.87));
  CHECK(reference[6].get<double>() == Approx(61.0));  // 1/2 1.226 kg/m3 (10 m/s)^2

  // Load: 1/2 1.226 1.2 10 m2 (10 m/s)^2 = 0.7356 kN, but for the share of its turned axes. Barge: 1/2 1025 0.8 80 m2
  // (1 m/s)^2 = 32.8 kN, as far as its moorings let it lie along x.
  bool load = false, barge = false;
  for (const auto& row : tables["Wind and current on bodies"]) {
    if (row[0] == "load") load = row[2].get<double>() == Approx(0.7);
    if (row[0] == "barge") {
      barge = row[2].get<double>() == Approx(32.8).epsilon(0.01);
      // At half the draft, 2 m under the centre of gravity: the moment tips it against its righting one.
      CHECK(std::abs(row[4].get<double>()) > 0.001);
    }
  }
  CHECK(load);
  CHECK(barge);

  // F/W of the load: 0.7356/196.1, over the 18 m fall and the metre from its end to the centre of gravity.
  const double angle = std::atan(0.7356 / (20.0 * 9.80665));
  CHECK(tables["Falls in wind and current"][0][3].get<double>() == Approx(18.0 * std::sin(angle)).margin(2e-3));
}

TEST_CASE("a run in gusts depends on the seed and says so", "[wind]") {
  const Folder folder;
  std::map<std::string, double> largest;
  for (const auto& [name, seed] : {std::pair("first", "3"), {"again", "3"}, {"other", "8"}}) {
    const Result run_in = run(folder, with({"simulate", kSmallLift, "--seed", seed, "--out", name, "--quiet"}, kWindy));
    INFO(run_in.err);
    REQUIRE((run_in.code == 0 || run_in.code == 1));
    largest[name] = summary_in(folder / name)["metrics"]["wind_force_max.sail"]["value"];
  }
  REQUIRE(largest.size() == 3);
  CHECK(largest["first"] == largest["again"]);
  CHECK(largest["first"] != largest["other"]);
  CHECK(largest["first"] > 0.74);  // more than the mean wind does
  std::ifstream page(folder / "first" + "/report.html");
  const std::string text((std::istreambuf_iterator<char>(page)), std::istreambuf_iterator<char>());
  CHECK(text.find("with gusts by the spectrum of NPD (ISO 19901-1) from 1/600 to 0.5 Hz, 200 frequencies, seed 3") !=
        std::string::npos);
  CHECK(text.find("This is one run in one seed of the gusts (3)") != std::string::npos);
  CHECK(text.find("Steady current of 1.00 m/s") != std::string::npos);
}
