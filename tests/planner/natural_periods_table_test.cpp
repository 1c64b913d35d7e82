// The natural periods that `check` prints: at the start, at the end of every phase, in the poses of the case.
#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/planner/program.h"

using namespace stillhook;
using nlohmann::json;

namespace {

const std::string kSmallLift = std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml";

/// A load of 100 t on one wire of EA = 4e5 kN from a fixed point, paid out from 20 m to 800 m.
const char* const kDeep = R"(
name = "deep"
[sea]
active = "calm"
[[sea.states]]
name = "calm"
type = "calm"
[[bodies]]
name = "module"
mass_t = 100.0
gyration_m = [2.0, 2.0, 2.0]
position_m = [0.0, 0.0, -10.0]
[[drives]]
name = "hoist"
kind = "winch"
[[wires]]
name = "fall"
role = "hoist"
from = "world"
to = "module"
point_from_m = [0.0, 0.0, 10.0]
point_to_m = [0.0, 0.0, 0.0]
axial_stiffness_kN = 4.0e5
unstretched_length_m = 20.0
winch = "hoist"
[operation]
load = "module"
[[operation.phases]]
name = "lower"
moves = [{ drive = "hoist", speed_m_per_min = 30.0, travel_m = -780.0 }]
[[poses]]
name = "at_800_m"
drives = [{ drive = "hoist", position_m = -780.0 }]
)";

/// Rows of a table of `check --json` by the name of their pose.
std::map<std::string, json> rows(const std::string& text, const std::string& title) {
  std::map<std::string, json> found;
  const json document = json::parse(text);
  for (const json& table : document["tables"])
    if (table["title"] == title)
      for (const json& row : table["rows"]) found[row[0]] = row;
  return found;
}

enum Column { kX = 1, kY, kZ, kRoll };

}  // namespace

TEST_CASE("natural periods at the ends of phases: a load on 20 m and on 800 m of wire", "[check][periods]") {
  const Folder folder;
  std::ofstream(folder / "deep.toml") << kDeep;
  const Result r = run(folder, {"check", "deep.toml", "--json"});
  INFO(r.err);
  REQUIRE(r.code == 0);
  const auto periods = rows(r.out, "Natural periods of module");
  REQUIRE(periods.size() == 3);
  // Two decimals are printed. Heave: 2 pi sqrt(m L / EA) with the unstretched length; pendulum: 2 pi sqrt(l / g) with
  // the stretched one, L (1 + m g / EA).
  const double mass = 1e5, EA = 4e8, g = 9.80665, two_pi = 2.0 * std::numbers::pi;
  for (const auto& [pose, length] :
       {std::pair{"start", 20.0}, std::pair{"lower", 800.0}, std::pair{"at_800_m", 800.0}}) {
    CAPTURE(pose);
    const json& row = periods.at(pose);
    CHECK(row[kZ].get<double>() == Approx(two_pi * std::sqrt(mass * length / EA)).margin(0.006));
    const double pendulum = two_pi * std::sqrt(length * (1.0 + mass * g / EA) / g);
    CHECK(row[kX].get<double>() == Approx(pendulum).margin(0.006));
    CHECK(row[kY].get<double>() == Approx(pendulum).margin(0.006));
    CHECK(row[kRoll].is_null());  // the wire ends in the centre of gravity: nothing turns the load back
  }
}

TEST_CASE("natural periods at a phase's end are those of the pose with the same drives", "[check][periods]") {
  const Folder folder;
  std::ofstream(folder / "lift.toml")
      << content(kSmallLift) << "\n[[poses]]\nname = \"high\"\ndrives = [{ drive = \"hoist\", position_m = 4.0 }]\n";
  const Result r = run(folder, {"check", "lift.toml", "--json"});
  INFO(r.err);
  REQUIRE(r.code == 0);
  for (const char* body : {"barge", "load"}) {
    CAPTURE(body);
    const auto periods = rows(r.out, std::string("Natural periods of ") + body);
    REQUIRE(periods.size() == 5);  // start, settle, hoist_up, hold, high
    for (int c = 1; c <= 6; ++c) {
      CHECK(periods.at("hoist_up")[c] == periods.at("high")[c]);
      CHECK(periods.at("hoist_up")[c] == periods.at("hold")[c]);
      CHECK(periods.at("settle")[c] == periods.at("start")[c]);
    }
  }
  // Four metres of 18 less: a shorter pendulum, 2 pi sqrt(l / g) with l = 19 m and 15 m from the tip to the load's
  // centre of gravity, 1 m below the eye. 3 %: the barge gives way, and the load turns about its own centre.
  const auto load = rows(r.out, "Natural periods of load");
  CHECK(load.at("hoist_up")[kX].get<double>() / load.at("start")[kX].get<double>() ==
        Approx(std::sqrt(15.0 / 19.0)).epsilon(0.03));
}

TEST_CASE("natural periods leave taglines out", "[check][periods]") {
  const Folder folder;
  // The line acts from the start, with its load swung out: the control would add kp / length to the stiffness.
  const auto periods = [&](const char* kp) {
    const Result r =
        run(folder, {"check", kSmallLift, "--json", "--set", std::string("taglines.tagline.kp_kN_per_deg=") + kp,
                     "--set", "taglines.tagline.set_point_deg=-2", "--set", "taglines.tagline.tension_max_kN=200"});
    INFO(r.err);
    REQUIRE(r.code == 0);
    return rows(r.out, "Natural periods of load").at("start");
  };
  const json soft = periods("0.01"), stiff = periods("2.0");
  // The pull of the stiff line moves barge and load a little: 2 %.
  CHECK(stiff[kX].get<double>() == Approx(soft[kX].get<double>()).epsilon(0.02));
}
