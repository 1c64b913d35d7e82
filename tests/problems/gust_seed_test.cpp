// Where the seed of the gusts comes from: their own, that of the sea, that of a scenario.
#include <catch2/catch.hpp>

#include "problems/scenarios.h"

using namespace stillhook;

namespace {

/// The small lift with a wind on its load.
Case windy_lift(const std::vector<Override>& more = {}) {
  std::vector<Override> all = {
      {"wind", R"({ speed_m_per_s = 10.0, from_deg = 0.0, spectrum = "npd" })"},
      {"wind_areas", R"([{ name = "sail", body = "load", areas_m2 = [6.0, 6.0, 6.0] }])"},
  };
  all.insert(all.end(), more.begin(), more.end());
  return read_case(std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml", all);
}

ScenarioSpec in_sea(const std::string& sea) {
  ScenarioSpec scenario;
  scenario.name = scenario.sea = sea;
  return scenario;
}

}  // namespace

TEST_CASE("gusts follow the seed of the sea unless they have their own", "[wind]") {
  const Case c = windy_lift();
  CHECK(c.specification.gust_seed() == 1);  // in a regular wave
  Specification irregular = in_scenario(c.specification, in_sea("wind_sea"));
  CHECK(irregular.gust_seed() == 4);  // that of the state
  ScenarioSpec other = in_sea("wind_sea");
  other.seed = 77;
  CHECK(in_scenario(c.specification, other).gust_seed() == 77);
  CHECK(in_scenario(c.specification, other).sea.states[1].seed == 77);
  const Case fixed = windy_lift({{"wind.seed", "9"}});
  CHECK(in_scenario(fixed.specification, other).gust_seed() == 9);
  CHECK(in_scenario(fixed.specification, other).sea.states[1].seed == 77);
}

TEST_CASE("a scenario's seed is that of the gusts where the sea has none", "[wind]") {
  const Case c = windy_lift();
  ScenarioSpec swell = in_sea("swell");
  swell.seed = 5;
  const Specification changed = in_scenario(c.specification, swell);
  CHECK(changed.gust_seed() == 5);
  CHECK(changed.sea.states[0].seed == c.specification.sea.states[0].seed);
  ScenarioSpec calm = in_sea("calm");
  calm.seed = 6;
  CHECK(in_scenario(c.specification, calm).gust_seed() == 6);
  // Gusts with a seed of their own, or none at all, leave nothing that the scenario's seed could change.
  CHECK_THROWS_WITH(in_scenario(windy_lift({{"wind.seed", "9"}}).specification, swell), Catch::Contains("seed"));
  CHECK_THROWS_WITH(in_scenario(windy_lift({{"wind.spectrum", "\"none\""}}).specification, swell),
                    Catch::Contains("seed"));
}

TEST_CASE("fresh conditions have fresh gusts in every sea", "[wind]") {
  Case c = windy_lift();
  c.plan.scenarios = {in_sea("swell"), in_sea("wind_sea")};
  const std::vector<ScenarioSpec> fresh = fresh_scenarios(c, 3);
  REQUIRE(fresh.size() == 6);
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    REQUIRE(fresh[i].seed);
    for (std::size_t j = 0; j < i; ++j)
      if (fresh[i].sea == fresh[j].sea) CHECK(*fresh[i].seed != *fresh[j].seed);
    CHECK(fresh[i].phase.has_value() == (fresh[i].sea == "swell"));
    CHECK(in_scenario(c.specification, fresh[i]).gust_seed() == *fresh[i].seed);
  }
  ScenarioSpec many = in_sea("swell");
  many.seeds = 3;
  c.plan.scenarios = {many};
  CHECK(scenarios_of(c).size() == 3);
  CHECK(scenarios_of(c)[2].seed == 3);
  Case steady = windy_lift({{"wind.spectrum", "\"none\""}});
  steady.plan.scenarios = {in_sea("swell")};
  for (const ScenarioSpec& one : fresh_scenarios(steady, 3)) CHECK_FALSE(one.seed);
}
