// Derivatives of the reference lift, with its joints, contacts, wires and state spaces of radiation, against central
// differences of whole runs. Other tests have one wire, constant coefficients and no joint.
#include <catch2/catch.hpp>
#include <cmath>

#include "problems/tangent_run.h"
#include "tests/validation/reference_lift.h"

using namespace stillhook;

namespace {

const std::vector<std::string> kChannels = {"load.x",           "load.z",     "hoist_port.tension",
                                            "crane.pitch",      "barge.roll", "boom_hinge_port.force_z",
                                            "stay_port.tension"};

struct Compared {
  double size = 0.0, error = 0.0, doubt = 0.0;
};

std::vector<std::vector<double>> series_of(const Case& c, double until) {
  const Model model = build_model(c.specification);
  RunOptions options;
  options.until = until;
  const Trajectory run = simulate(model, build_operation(model, until), options);
  REQUIRE(run.status == RunStatus::completed);
  return run.values;
}

// The largest of each over a run, a channel each; `step` in the key's unit.
std::vector<Compared> compare(const Case& c, const std::string& key, double step, double until) {
  TangentRequest request;
  request.keys = {key};
  request.channels = kChannels;
  request.until = until;
  const TangentRun run = run_with_tangents(c, request);
  REQUIRE(run.tangents.valid);
  const double x = key_value(c, key);
  std::vector<std::vector<std::vector<double>>> runs;
  for (const double by : {step, -step, 0.5 * step, -0.5 * step})
    runs.push_back(series_of(with_values(c, {{key, x + by}}), until));
  std::vector<Compared> all;
  for (std::size_t k = 0; k < kChannels.size(); ++k) {
    const auto channel = static_cast<std::size_t>(run.trajectory.find(kChannels[k]));
    Compared result;
    const std::size_t samples =
        std::min(runs[0][channel].size(), static_cast<std::size_t>(run.tangents.values[k].rows()));
    for (std::size_t i = 0; i < samples; ++i) {
      const double coarse = (runs[0][channel][i] - runs[1][channel][i]) / (2.0 * step),
                   fine = (runs[2][channel][i] - runs[3][channel][i]) / step, truth = (4.0 * fine - coarse) / 3.0;
      result.size = std::max(result.size, std::abs(truth));
      result.doubt = std::max(result.doubt, std::abs(fine - coarse));
      result.error = std::max(result.error, std::abs(truth - run.tangents.values[k](static_cast<Eigen::Index>(i), 0)));
    }
    all.push_back(result);
  }
  return all;
}

}  // namespace

TEST_CASE("derivatives of the reference lift are those of whole runs, through joints, contacts and state spaces",
          "[slow][tangent]") {
  const Case c = reference_case({{"solver.newton_tolerance", "1e-12"}});
  const auto [key, step] = GENERATE(table<std::string, double>({
      {"operation.phases.load_transfer.moves.hoist.speed_m_per_min", 1e-5},
      {"sea.states.paper_table1.amplitude_m", 1e-4},
      {"contacts.load_on_barge.damping_kN_s_per_m", 1.0},
      {"bodies.load.mass_t", 1e-3},
      {"bodies.barge.hydrodynamics.radiation_factor", 1e-5},
  }));
  const std::vector<Compared> compared = compare(c, key, step, 150.0);
  for (std::size_t k = 0; k < compared.size(); ++k) {
    CAPTURE(key, kChannels[k], compared[k].size, compared[k].error, compared[k].doubt);
    // Touches on the barge fall between the two sides of a difference now and then, and then it is the differences that
    // are in doubt: a hundredth. The derivatives themselves are exact but for the width of the pair of lifts.
    CHECK(compared[k].size > 0.0);
    CHECK(compared[k].doubt <= 1e-2 * compared[k].size);
    CHECK(compared[k].error <= 1e-3 * compared[k].size + compared[k].doubt);
  }
}
