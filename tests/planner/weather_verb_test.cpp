// The verb `weather` as a user meets it.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "results/weather/calendar.h"
#include "tests/planner/documented_keys.h"
#include "tests/planner/program.h"

namespace stillhook {
namespace {

using Catch::Contains;
using nlohmann::json;

const std::string kWeather = std::string(STILLHOOK_SOURCE_DIR) + "/problems/weather/";

std::string written(const Folder& folder, const std::string& name, const std::string& text) {
  std::ofstream(folder / name, std::ios::binary) << text;
  return folder / name;
}

constexpr const char* kCalm = "time,hs [m],tp [s],wave_from [deg]\n";

/// A forecast of so many hours, calm from an hour on.
std::string forecast_text(int hours, int calm_from) {
  std::string text = kCalm;
  for (int i = 0; i < hours; ++i)
    text += instant_text(*instant_of("2026-06-01") + 3600 * i) + (i < calm_from ? ",2.5,7,250\n" : ",0.5,7,250\n");
  return text;
}

TEST_CASE("weather leaves a folder whose summary is documented", "[cli][weather]") {
  const Folder folder;
  written(folder, "forecast.csv", forecast_text(60, 12));
  const Result r = run(folder, {"weather", kWeather + "limits.csv", "--hindcast", kWeather + "hindcast.csv",
                                "--scatter", kWeather + "scatter.csv", "--forecast", "forecast.csv", "--set",
                                "weather.bow_towards_deg=250", "--set", "weather.operation_h=10", "--json", "--quiet"});
  INFO(r.err);
  REQUIRE(r.code == 0);
  const json summary = json::parse(r.out);
  CHECK(undocumented_keys(summary) == std::set<std::string>{});
  const json& w = summary["weather"];
  CHECK(w["workability"].get<double>() == Approx(0.6628649635036497));
  CHECK(w["windows"][0]["duration_h"] == 16.0);
  CHECK(w["forecast"]["decision"] == "wait");
  CHECK(w["forecast"]["first_start"] == "2026-06-01T12:00Z");
  for (const char* file :
       {"summary.json", "report.html", "weather.csv", "weather_months.csv", "weather.nc", "forecast.csv"})
    CHECK(std::filesystem::exists(folder / (std::string("runs/limits-weather/") + file)));
  const std::string page = content(folder / "runs/limits-weather/report.html");
  for (const char* word : {"Workable by month", "Persistence of calms", "Go or no-go", "Every sample of 2021"})
    CHECK_THAT(page, Contains(word));
  // It is not overwritten without --force.
  CHECK(run(folder, {"weather", "1.5", "--hindcast", kWeather + "hindcast.csv", "--out", "runs/limits-weather"}).code ==
        2);
  CHECK(run(folder,
            {"weather", "1.5", "--hindcast", kWeather + "hindcast.csv", "--out", "runs/limits-weather", "--force"})
            .code == 0);
  CHECK_FALSE(std::filesystem::exists(folder / "runs/limits-weather/forecast.csv"));
}

TEST_CASE("weather decides by phase, and says when nothing is allowed", "[cli][weather]") {
  const Folder folder;
  written(folder, "forecast.csv", forecast_text(60, 12));
  written(folder, "rough.csv", forecast_text(60, 60));
  written(folder, "phases.csv", "phase,hs_limit [m]\nlift_off,5\nset_down,1\n");
  const auto decide_with = [&](const std::string& forecast, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"weather", "phases.csv", "--forecast", forecast, "--out",
                                          "x",       "--force",    "--json",     "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(folder, arguments);
  };
  const Result whole = decide_with("forecast.csv", {"--set", "weather.operation_h=6"});
  REQUIRE(whole.code == 0);
  CHECK(json::parse(whole.out)["weather"]["forecast"]["first_start"] == "2026-06-01T12:00Z");
  const Result none = decide_with("rough.csv", {"--set", "weather.operation_h=6"});
  CHECK(none.code == 3);
  CHECK(json::parse(none.out)["weather"]["forecast"]["decision"] == "no-go");
  CHECK(decide_with("forecast.csv", {"--set", "weather.operation_h=80"}).code == 2);
  const std::string small = content(std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml");
  written(folder, "case.toml",
          small +
              "\n[[weather.phases]]\nname = \"lift_off\"\nduration_h = 3\n[[weather.phases]]\nname = "
              "\"set_down\"\nduration_h = 3\n");
  const Result by_phase = decide_with("forecast.csv", {"--case", "case.toml"});
  INFO(by_phase.err);
  REQUIRE(by_phase.code == 0);
  CHECK(json::parse(by_phase.out)["weather"]["forecast"]["first_start"] == "2026-06-01T09:00Z");
  written(folder, "phases.csv", "phase,hs_limit [m]\nlift_off,5\nsetdown,1\n");
  CHECK_THAT(decide_with("forecast.csv", {"--case", "case.toml"}).err, Contains("limits for a phase \"setdown\""));
}

TEST_CASE("weather tells what is wrong with its command and settings", "[cli][weather]") {
  const Folder folder;
  written(folder, "heights.csv", "time,hs [m]\n2020-01-01,1\n2020-01-02,1\n");
  const auto told = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"weather"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Result r = run(folder, arguments);
    CHECK(r.code == 2);
    return r.err;
  };
  CHECK_THAT(told({"1.5"}), Contains("give --hindcast FILE, --scatter FILE or --forecast FILE"));
  CHECK_THAT(told({"none.csv", "--hindcast", "heights.csv"}),
             Contains("there is no such file, nor is it a height in m"));
  CHECK_THAT(told({"99", "--hindcast", "heights.csv"}), Contains("a height above 0 and up to 30 m"));
  CHECK_THAT(told({".", "--hindcast", "heights.csv"}), Contains("holds no operability.csv"));
  CHECK_THAT(told({kWeather + "limits.csv", "--hindcast", "heights.csv"}),
             Contains("no column of wave periods, but the limits depend on the peak period"));
  CHECK_THAT(told({"1.5", "--hindcast", "heights.csv", "--set", "weather.wind_max_m_per_s=10"}),
             Contains("no column of wind speeds"));
  CHECK_THAT(told({"1.5", "--forecast", "heights.csv"}), Contains("planned duration of the operation"));
  CHECK_THAT(told({"1.5", "--hindcast", "heights.csv", "--set", "weather.bow_towards=90"}),
             Contains("did you mean \"bow_towards_deg\"") || Contains("bow_towards_deg"));
  CHECK_THAT(told({"1.5", "--hindcast", "heights.csv", "--set", "sea.active=swell"}),
             Contains("without a case only keys of the section weather"));
  CHECK_THAT(told({"1.5", "--hindcast", "heights.csv", "--set", "weather.daylight_h=[20,6]"}),
             Contains("from an earlier to a later hour"));
}

}  // namespace
}  // namespace stillhook
