// What a case is told that its model leaves out, and what it is not told.
#include "problems/model_gaps.h"

#include <catch2/catch.hpp>

#include "problems/case.h"
#include "problems/case_reader.h"

using namespace stillhook;
using Catch::Matchers::Contains;

namespace {

std::string gaps_of(std::vector<Override> more) {
  const Case c = read_case(std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml", std::move(more));
  const Model model = build_model(c.specification);
  std::string all;
  for (const std::string& gap : model_gaps(model, build_operation(model))) all += gap + "\n";
  return all;
}

}  // namespace

TEST_CASE("waves that feel the bottom are told", "[gaps]") {
  // 0.9 rad/s: 2 pi 9.80665 / 0.81 = 76.07 m, half of it 38.03 m.
  CHECK_THAT(gaps_of({{"sea.depth_m", "38.0"}}),
             Contains("the waves feel the bottom: those of 7.0 s are 76 m long in 38.0 m of water, 0.4 % shorter than in "
                      "deep water"));
  CHECK_THAT(gaps_of({{"sea.depth_m", "38.1"}}), !Contains("bottom"));
  CHECK_THAT(gaps_of({}), !Contains("bottom"));  // deep
}

TEST_CASE("a swell that feels the bottom is told although the wind sea holds the energy", "[gaps]") {
  // Waves of 8 s are 100 m long and those of 14 s 306 m: 60 m of water is deep for the first alone.
  const std::string parts =
      "[{ name = \"wind\", type = \"jonswap\", significant_height_m = 1.5, peak_period_s = 8.0, heading_deg = 90.0 }, "
      "{ name = \"swell\", type = \"jonswap\", significant_height_m = 0.5, peak_period_s = 14.0, heading_deg = 0.0 }]";
  const std::string sum =
      "[{ name = \"crossed\", type = \"sum\", parts = " + parts +
      " }, { name = \"swell\", type = \"regular\", amplitude_m = 0.1, frequency_rad_per_s = 0.9, heading_deg = 0.0 }]";
  CHECK_THAT(gaps_of({{"sea.depth_m", "60.0"}, {"sea.active", "\"crossed\""}, {"sea.states", sum}}),
             Contains("the waves feel the bottom: those of 14.0 s"));
}

TEST_CASE("a load that goes through the surface is told, one that stays in air is not", "[gaps]") {
  CHECK_THAT(gaps_of({}), !Contains("surface"));
  CHECK_THAT(gaps_of({{"operation.phases.hoist_up.moves.hoist.travel_m", "-7.0"}}),
             Contains("load goes through the surface (in phase hoist_up)") && Contains("no slamming") &&
                 Contains("without a hull it has no buoyancy"));
}

TEST_CASE("a phase that takes a hull through the surface and far beyond is told, phases of its height are not",
          "[gaps]") {
  const auto gaps = [](std::vector<Override> more) {
    const Case c = read_case(std::string(STILLHOOK_SOURCE_DIR) + "/tests/lifts/deep_lowering.toml", std::move(more));
    const Model model = build_model(c.specification);
    std::string all;
    for (const std::string& gap : model_gaps(model, build_operation(model))) all += gap + "\n";
    return all;
  };
  // As written, phases end 0 m over and 0 m under the surface. With the first of them 5 m higher the splash zone is of
  // 7.5 m for a hull of 2.5 m.
  CHECK_THAT(gaps({}), !Contains("evenly"));
  CHECK_THAT(
      gaps({{"operation.phases.to_the_surface.moves.winch.goal.value_m", "4.25"}}),
      Contains("phase splash_zone takes module through the surface and beyond") && Contains("end one phase where"));
}

TEST_CASE("a wire paid out to many times its first length keeps its dashpot, and that is told", "[gaps]") {
  const auto gaps = [](std::vector<Override> more) {
    const Case c = read_case(std::string(STILLHOOK_SOURCE_DIR) + "/tests/lifts/deep_lowering.toml", std::move(more));
    const Model model = build_model(c.specification);
    std::string all;
    for (const std::string& gap : model_gaps(model, build_operation(model))) all += gap + "\n";
    return all;
  };
  // 10 m to the sea bed at 816 m: 0.02 of critical becomes 0.02 sqrt(81.6) = 0.181. A dashpot in kN s/m is what it says.
  CHECK_THAT(gaps({}), !Contains("damping_ratio"));
  CHECK_THAT(gaps({{"wires.wire.damping_ratio", "0.02"}, {"wires.wire.damping_mass_t", "100.0"}}),
             Contains("wire wire is paid out from 10 m to 816") && Contains("which is 0.181 of critical") &&
                 Contains("give damping_kN_s_per_m"));
}

TEST_CASE("a vessel that no line holds is told", "[gaps]") {
  // Both lines pull along x: y has the pretension over the distance alone, 2 * 50 kN / 200 m = 0.5 kN/m for 2,000 t of
  // barge and added mass, 2 pi sqrt(2000/0.5) = 400 s.
  const std::string gaps = gaps_of({});
  CHECK_THAT(gaps, Contains("barge is not held in y: its period there is"));
  CHECK_THAT(gaps, !Contains("held in x"));
  // Abeam, in line with the centre of gravity, so that they do not turn the barge until they hang slack: 40 kN/m in y
  // give 2 pi sqrt(2000/40) = 45 s; x has their pretension alone.
  const std::string abeam = gaps_of({{"moorings.bow.azimuth_deg", "90.0"},
                                     {"moorings.bow.fairlead_m", "[0.0, 10.0, 0.0]"},
                                     {"moorings.stern.azimuth_deg", "-90.0"},
                                     {"moorings.stern.fairlead_m", "[0.0, -10.0, 0.0]"}});
  CHECK_THAT(abeam, !Contains("held in y"));
  CHECK_THAT(abeam, Contains("barge is not held in x: its period there is"));
  // Oblique lines from bow and stern are a couple: the barge turns until both are slack, and nothing holds it.
  const std::string oblique = gaps_of({{"moorings.stern.azimuth_deg", "120.0"}, {"moorings.bow.azimuth_deg", "-60.0"}});
  CHECK_THAT(oblique, Contains("barge is not held in y: nothing brings it back"));
}
