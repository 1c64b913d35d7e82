// Derivatives of runs whose wire goes slack and taut again, and whose load touches a deck, against
// Richardson-extrapolated central differences of whole runs.
#include <catch2/catch.hpp>

#include <cmath>

#include "problems/case_reader.h"
#include "problems/tangent_run.h"

namespace stillhook {
namespace {

Case lift(std::vector<Override> more) {
  // Newton's method far below the differences that are taken, no end of a phase or ramp on a step, and every step kept.
  const std::vector<Override> always = {{"solver.newton_tolerance", "1e-13"},
                                        {"solver.time_step_s", "0.02"},
                                        {"solver.output_interval_s", "0.02"},
                                        {"taglines.tagline.active", "false"},
                                        {"sea.states.swell.amplitude_m", "0.05"},
                                        {"operation.phases.settle.duration_s", "5.0107"},
                                        {"operation.phases.hoist_up.moves.hoist.travel_m", "2.003"},
                                        {"operation.phases.hold.duration_s", "3.017"}};
  more.insert(more.begin(), always.begin(), always.end());
  return read_case(std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml", more);
}

// A mass on a wire: 20 t stretch it by 6 mm and swing on it at 41 rad/s; hauled in at 0.4 m/s within 0.05 s they swing
// by 10 mm, and so does the stop.
Case jerked_lift() {
  return lift({{"drives.hoist.acceleration_max_m_per_s2", "50"},
               {"wires.fall.axial_stiffness_kN", "6.1e5"},
               {"wires.fall.damping_ratio", "0.03"},
               {"operation.phases.hoist_up.moves.hoist.speed_m_per_min", "24.1"},
               {"operation.phases.hoist_up.moves.hoist.ramp_s", "0.05"}});
}

// The load stands on a deck fixed to the world, under a wire that begins exactly at its limit of slack, wherever the
// load's weight makes it stand.
Case lifted_off() {
  return lift({
      {"contacts",
       "[{ name = \"deck\", role = \"pickup\", body = \"load\", points_m = [[0.5, 0.5, -1.0], [-0.5, 0.5, "
       "-1.0], [-0.5, -0.5, -1.0], [0.5, -0.5, -1.0]], surface_body = \"world\", surface_centre_m = [15.0, "
       "0.0, 5.0], surface_length_m = 10.0, surface_breadth_m = 10.0, stiffness_kN_per_m = 2.0e4, "
       "damping_kN_s_per_m = 60.0, friction = 0.3 }]"},
      {"wires.fall.slack_m", "0.0"},
      {"operation.phases.hoist_up.moves.hoist.speed_m_per_min", "4.1"},
      {"operation.phases.hoist_up.moves.hoist.travel_m", "0.503"},
  });
}

std::vector<double> series(const Trajectory& run, const std::string& channel) {
  return run.values[static_cast<std::size_t>(run.find(channel))];
}

struct Truth {
  std::vector<double> value;
  double size = 0.0, doubt = 0.0;
};

// (4 D(h/2) - D(h)) / 3 of each channel, h in the key's unit.
std::vector<Truth> richardson(const Case& c, const std::string& key, double h,
                              const std::vector<std::string>& channels) {
  const double x = key_value(c, key);
  std::vector<Trajectory> runs;
  for (const double by : {h, -h, 0.5 * h, -0.5 * h}) {
    const Model model = build_model(with_values(c, {{key, x + by}}).specification);
    runs.push_back(simulate(model, build_operation(model)));
    REQUIRE(runs.back().status == RunStatus::completed);
  }
  std::size_t samples = runs[0].time.size();
  for (const Trajectory& run : runs) samples = std::min(samples, run.time.size());
  std::vector<Truth> truths;
  for (const std::string& channel : channels) {
    const auto at = [&](int run, std::size_t i) {
      return runs[run].values[static_cast<std::size_t>(runs[run].find(channel))][i];
    };
    Truth truth;
    for (std::size_t i = 0; i < samples; ++i) {
      const double coarse = (at(0, i) - at(1, i)) / (2.0 * h), fine = (at(2, i) - at(3, i)) / h;
      truth.value.push_back((4.0 * fine - coarse) / 3.0);
      truth.size = std::max(truth.size, std::abs(truth.value.back()));
      truth.doubt = std::max(truth.doubt, std::abs(fine - coarse));
    }
    truths.push_back(truth);
  }
  return truths;
}

struct Passes {
  int slack = 0, taut = 0;
  int between = 0;  // samples at which the pair of lifts built for the derivative has one slack wire and one taut
};

Passes passes(const TangentRun& run, std::size_t unstretched) {
  const std::vector<double> length = series(run.trajectory, "fall.length"),
                            natural = series(run.trajectory, "fall.unstretched");
  Passes p;
  for (std::size_t i = 0; i < length.size(); ++i) {
    const double d = length[i] - natural[i];
    ++(d > 0.0 ? p.taut : p.slack);
    const double half = 0.5 * run.widths[0] * run.tangents.values[unstretched](static_cast<Eigen::Index>(i), 0);
    if (std::abs(d) < std::abs(half)) ++p.between;
  }
  return p;
}

// Returns how often the pair stood on either side of the limit of slack.
int check(const Case& c, const std::string& key, double relative_step) {
  const std::vector<std::string> channels = {"load.x", "load.z", "barge.pitch", "fall.tension"};
  TangentRequest request;
  request.keys = {key};
  request.channels = channels;
  request.channels.push_back("fall.unstretched");
  const TangentRun run = run_with_tangents(c, request);
  REQUIRE(run.tangents.valid);
  const Passes p = passes(run, channels.size());
  CHECK(p.slack > 3);
  CHECK(p.taut > 3);
  const std::vector<Truth> truths =
      richardson(c, key, relative_step * std::max(0.1, std::abs(key_value(c, key))), channels);
  for (std::size_t k = 0; k < channels.size(); ++k) {
    const Truth& truth = truths[k];
    double error = 0.0;
    for (std::size_t i = 0; i < truth.value.size(); ++i)
      error = std::max(error, std::abs(truth.value[i] - run.tangents.values[k](static_cast<Eigen::Index>(i), 0)));
    CAPTURE(key, channels[k], truth.size, error, truth.doubt, p.between, p.slack);
    CHECK(truth.size > 0.0);
    CHECK(truth.doubt <= 1e-4 * truth.size);
    // What the width of the pair leaves, 4e-5 of the key's value: 0.2 ms of the time at which a ramp of 50 ms ends, the
    // square of their ratio. By the wire's own length, where a pair stands 0.7 mm apart, tension and pitch are what is
    // left of a metre's worth of the wire's stiffness on either side: found off by 2e-3 and 5e-4, the load by less than
    // 5e-5.
    const bool left_over = key == "wires.fall.unstretched_length_m" && !channels[k].starts_with("load.");
    CHECK(error <= (left_over ? 5e-3 : 5e-5) * truth.size + 2.0 * truth.doubt);
  }
  return p.between;
}

TEST_CASE("Derivatives of a run through a wire that goes slack and taut", "[tangent][kink]") {
  const Case c = jerked_lift();
  int between = 0;
  for (const auto& [key, step] :
       std::vector<std::pair<std::string, double>>{{"operation.phases.hoist_up.moves.hoist.speed_m_per_min", 1e-6},
                                                   {"operation.phases.hoist_up.moves.hoist.travel_m", 1e-6},
                                                   {"wires.fall.unstretched_length_m", 1e-7},
                                                   {"wires.fall.axial_stiffness_kN", 1e-5},
                                                   {"wires.fall.damping_ratio", 1e-5},
                                                   {"bodies.load.mass_t", 1e-6},
                                                   {"sea.states.swell.amplitude_m", 1e-5}})
    between += check(c, key, step);
  // Else none of this would be seen: by the travel it is one step, and without following the branches of the run the
  // derivatives were off by 16 to 40 % from there on.
  CHECK(between > 0);
}

TEST_CASE("Derivatives of a lift-off from the limit of slack", "[tangent][kink]") {
  const Case c = lifted_off();
  int between = 0;
  for (const auto& [key, step] :
       std::vector<std::pair<std::string, double>>{{"bodies.load.mass_t", 1e-6},
                                                   {"operation.phases.hoist_up.moves.hoist.speed_m_per_min", 1e-6},
                                                   {"contacts.deck.stiffness_kN_per_m", 1e-6},
                                                   {"sea.states.swell.amplitude_m", 1e-5}})
    between += check(c, key, step);
  CHECK(between > 0);
}

}  // namespace
}  // namespace stillhook
