// Keys of moorings, springs to the world and displacement RAOs: what goes together, and what a case is told.
#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>

#include "problems/case.h"
#include "problems/evaluator.h"
#include "problems/model_gaps.h"
#include "problems/tangent_run.h"
#include "sim/simulate.h"

using namespace stillhook;
using Catch::Matchers::Contains;

namespace {

const std::string kFolder = std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases";

std::string text_of(const std::string& name) {
  std::ifstream in(kFolder + "/" + name);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// What is said about a small lift with this at its end.
std::string said(const std::string& base, const std::string& more) {
  try {
    const Case c = read_case_text(text_of(base) + more, "case.toml", kFolder);
    build_model(c.specification);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

const std::string kLine = "\n[[moorings]]\nname = \"extra\"\nbody = \"barge\"\nfairlead_m = [20.0, 5.0, -1.0]\n";

}  // namespace

TEST_CASE("a mooring has its anchor once, and what follows from it is not given", "[stations]") {
  const auto with = [](const std::string& more) { return said("small_lift.toml", kLine + more); };
  CHECK(with("type = \"linear\"\nanchor_m = [120.0, 5.0, -1.0]\npretension_kN = 10.0\nstiffness_kN_per_m = 5.0\n")
            .empty());
  CHECK_THAT(with("type = \"linear\"\npretension_kN = 10.0\nstiffness_kN_per_m = 5.0\n"),
             Contains("\"azimuth_deg\"") && Contains("\"anchor_m\""));
  CHECK_THAT(with("type = \"linear\"\nanchor_m = [120.0, 5.0, -1.0]\nazimuth_deg = 0.0\npretension_kN = 10.0\n"
                  "stiffness_kN_per_m = 5.0\n"),
             Contains("cannot stand beside"));
  CHECK_THAT(with("type = \"linear\"\nanchor_m = [120.0, 5.0, -1.0]\npretension_kN = 10.0\nstiffness_kN_per_m = 5.0\n"
                  "anchor_distance_m = 100.0\n"),
             Contains("anchor_distance_m") && Contains("anchor_m"));
  CHECK_THAT(with("type = \"linear\"\nazimuth_deg = 0.0\npretension_kN = 10.0\nstiffness_kN_per_m = 5.0\n"),
             Contains("anchor_distance_m: is required with azimuth_deg"));
  const std::string chain = "type = \"catenary\"\nlength_m = 150.0\naxial_stiffness_kN = 1.0e5\n";
  const auto moored = [&](const std::string& more) {
    std::string text = text_of("small_lift.toml");
    text.replace(text.find("ramp_s = 10.0"), 13, "ramp_s = 10.0\ndepth_m = 40.0");
    try {
      build_model(read_case_text(text + kLine + chain + more, "case.toml", kFolder).specification);
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(moored("anchor_m = [160.0, 5.0, -40.0]\nweight_N_per_m = 300.0\n").empty());
  CHECK_THAT(moored("anchor_m = [160.0, 5.0, -40.0]\nweight_N_per_m = 300.0\npretension_kN = 20.0\n"),
             Contains("follows from length_m"));
  CHECK_THAT(moored("azimuth_deg = 0.0\nweight_N_per_m = 300.0\n"),
             Contains("pretension_kN: is required with azimuth_deg"));
  CHECK_THAT(moored("anchor_m = [160.0, 5.0, -40.0]\nweight_N_per_m = 0.0\n"), Contains("wire from"));
  CHECK(moored("anchor_m = [164.5, 5.0, -40.0]\nweight_N_per_m = -30.0\n").empty());
  CHECK_THAT(moored("anchor_m = [90.0, 5.0, -40.0]\nweight_N_per_m = -300.0\n"), Contains("float at the surface"));
}

TEST_CASE("a spring to the world from a case", "[stations]") {
  const std::string head = "\n[[restoring]]\nname = \"hold\"\nbody = \"barge\"\n";
  CHECK(said("small_lift.toml", head + "stiffness_kN_per_m = [10.0, 20.0, 0.0]\n").empty());
  CHECK_THAT(said("small_lift.toml", head), Contains("does nothing"));
  CHECK_THAT(
      said("small_lift.toml", head + "stiffness_matrix_kN_m = [[1.0,0.0,0.0,0.0,0.0,0.0],[0.0,1.0,0.0,0.0,0.0,0.0],"
                                     "[0.0,0.0,1.0,0.0,0.0,0.0],[0.0,0.0,0.0,1.0,0.0,0.0],[0.0,0.0,0.0,0.0,1.0,0.0],"
                                     "[5.0,0.0,0.0,0.0,0.0,1.0]]\n"),
      Contains("symmetric"));
  CHECK_THAT(said("small_rao_lift.toml", "\n[wind]\nspeed_m_per_s = 10.0\nfrom_deg = 0.0\n\n[[wind_areas]]\nname = \"deck\"\n"
                                         "body = \"barge\"\nareas_m2 = [50.0, 200.0, 0.0]\n"),
             Contains("which no wind changes"));
  CHECK_THAT(said("small_rao_lift.toml", head + "stiffness_kN_per_m = [10.0, 20.0, 0.0]\n"),
             Contains("moves by displacement RAOs"));
}

TEST_CASE("what cannot be with a vessel that moves by RAOs is told", "[stations]") {
  CHECK(said("small_rao_lift.toml", "").empty());
  CHECK_THAT(said("small_rao_lift.toml",
                  "\n[[joints]]\nname = \"pin\"\ntype = \"spherical\"\nparent = \"world\"\nchild = \"barge\"\n"),
             Contains("joints.pin") && Contains("RAOs alone"));
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = text_of("small_rao_lift.toml");
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
    try {
      build_model(read_case_text(text, "case.toml", kFolder).specification);
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK_THAT(changed("kind = \"rao\"", "kind = \"rao\"\ncritical_fraction_roll = 0.05"),
             Contains("critical_fraction_roll"));
  CHECK_THAT(changed("name = \"barge\"", "name = \"barge\"\nvelocity_m_per_s = [1.0, 0.0, 0.0]"), Contains("velocity"));
  CHECK_THAT(changed("ramp_s = 10.0", "ramp_s = 0.0"), Contains("ramp"));
  CHECK_THAT(changed("pitch = \"bow_down\"\n", ""), Contains("pitch: is required"));
  CHECK_THAT(changed("phase = \"lag\"\n", ""), Contains("phase: is required"));
  CHECK_THAT(changed("kind = \"rao\"", "kind = \"none\""), Contains("has a meaning only with kind = \"rao\""));
  CHECK_THAT(changed("load = \"load\"", "load = \"barge\""), Contains("has to follow its wires"));
}

TEST_CASE("a case with a vessel by RAOs says what its model leaves out", "[stations][gaps]") {
  const Case c = read_case(kFolder + "/small_rao_lift.toml");
  const Model model = build_model(c.specification);
  std::string all;
  for (const std::string& gap : model_gaps(model, build_operation(model))) all += gap;
  CHECK_THAT(all, Contains("barge moves by its displacement RAOs alone") && Contains("does not heel"));
  CHECK_THAT(all, !Contains("not held"));
  CHECK(model.warnings().empty());  // in long waves its table follows the surface
}

TEST_CASE("derivatives of a run from a vessel that moves by RAOs are those of differences", "[stations][tangent]") {
  // By the vessel's mean place, the wave and the hoist: what moves the frame, and what does not.
  const std::vector<Override> always = {{"solver.newton_tolerance", "1e-13"},
                                        {"operation.phases.settle.duration_s", "20.013"},
                                        {"operation.phases.hoist_up.moves.hoist.ramp_s", "3.007"},
                                        {"operation.phases.hoist_up.moves.hoist.travel_m", "4.003"},
                                        {"operation.phases.hold.duration_s", "20.017"}};
  const Case c = read_case(kFolder + "/small_rao_lift.toml", always);
  const auto last = [](const Case& at) {
    const Model model = build_model(at.specification);
    const Trajectory run = simulate(model, build_operation(model));
    std::vector<double> values;
    for (const char* channel : {"load.x", "load.z", "fall.tension", "barge.pitch"}) {
      const int i = run.find(channel);
      REQUIRE(i >= 0);
      values.push_back(run.values[static_cast<std::size_t>(i)][250]);  // at 50 s
    }
    return values;
  };
  // Steps as small as the wire's own 23 rad/s needs where a key shifts the end of a move.
  for (const auto& [key, step] : {std::pair<std::string, double>{"sea.states.swell.amplitude_m", 1e-3},
                                  {"operation.phases.hoist_up.moves.hoist.speed_m_per_min", 2e-6},
                                  {"taglines.tagline.kp_kN_per_deg", 1e-3}}) {
    CAPTURE(key);
    TangentRequest request;
    request.keys = {key};
    request.channels = {"load.x", "load.z", "fall.tension", "barge.pitch"};
    const TangentRun run = run_with_tangents(c, request);
    REQUIRE(run.tangents.valid);
    const double x = key_value(c, key), h = step * x;
    const auto plus = last(with_values(c, {{key, x + h}})), minus = last(with_values(c, {{key, x - h}}));
    for (std::size_t k = 0; k < plus.size(); ++k) {
      CAPTURE(k);
      const double difference = (plus[k] - minus[k]) / (2.0 * h);
      // The square of the step in the slope's own curvature, at most 1e-6 of it; rounding of a run over the step.
      CHECK(run.tangents.values[k](250, 0) == Approx(difference).epsilon(2e-4).margin(1e-6 * std::abs(plus[k]) / x));
    }
  }
}
