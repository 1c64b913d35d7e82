// Derivatives through the memory of retardation functions against Richardson-extrapolated central differences of whole
// runs: the crane's hull, released 1 m too high, heaves and pitches to rest.
#include <catch2/catch.hpp>

#include <fmt/core.h>

#include <cmath>

#include "problems/case_reader.h"
#include "problems/tangent_run.h"

namespace stillhook {
namespace {

Case hull_case(double step) {
  std::string text = fmt::format(R"(
name = "hull"
[sea]
ramp_s = 5.0
[[sea.states]]
name = "calm"
type = "regular"
amplitude_m = 1.0e-9
frequency_rad_per_s = 0.6
[[bodies]]
name = "hull"
mass_t = 20746.0
cog_m = [0.0, 0.0, 1.0]
gyration_m = [14.0, 32.0, 34.0]
[bodies.hull]
shape = "box"
size_m = [110.0, 46.0, 7.5]
centre_m = [0.0, 0.0, -0.25]
[bodies.hydrodynamics]
kind = "table"
critical_fraction_pitch = 0.05
radiation = "retardation"
coefficient_file = "{}/problems/hulls/crane_110x46x4.csv"
)",
                                 STILLHOOK_SOURCE_DIR);
  for (int i = 0; i < 4; ++i)
    text += fmt::format(
        "[[moorings]]\nname = \"spring_{0}\"\ntype = \"linear\"\nbody = \"hull\"\nfairlead_m = [0.0, 0.0, 0.0]\n"
        "azimuth_deg = {1}.0\npretension_kN = 500.0\nstiffness_kN_per_m = 300.0\nanchor_distance_m = 300.0\n",
        i, 90 * i);
  text += fmt::format(
      "[operation]\n[solver]\ntime_step_s = {}\noutput_interval_s = {}\nnewton_tolerance = 1.0e-13\n"
      "max_duration_s = 40.0\n",
      step, 2.0 * step);
  return read_case_text(text, "hull.toml", ".");
}

/// At rest but for the height and a pitch that couples the modes.
SystemState released(const Model& model) {
  SystemState from = model.initial_state();
  from.body[0].p_WC.z() += 1.0;
  from.body[0].R_WB = from.body[0].R_WB * exp_rotation({0.0, 0.01, 0.0});
  return from;
}

std::vector<double> series_of(const Case& c, const SystemState& from, const std::string& channel) {
  const Model model = build_model(c.specification);
  RunOptions options;
  options.from = &from;
  const Trajectory t = simulate(model, build_operation(model), options);
  return t.values[static_cast<std::size_t>(t.find(channel))];
}

TEST_CASE("Derivatives through the memory of retardation functions", "[tangent][retardation]") {
  // Steps that do not meet the memory's own nodes, 0.1 s apart, within one interval of it and over several.
  const Case c = hull_case(GENERATE(0.09, 0.23));
  const SystemState from = released(build_model(c.specification));
  const std::string factor =
      GENERATE(as<std::string>{}, "added_mass_factor", "radiation_factor", "critical_fraction_pitch");
  const std::string key = "bodies.hull.hydrodynamics." + factor;
  TangentRequest request;
  request.keys = {key};
  request.channels = {"hull.z", "hull.pitch"};
  request.from = from;
  const TangentRun run = run_with_tangents(c, request);
  REQUIRE(run.tangents.valid);
  for (std::size_t k = 0; k < request.channels.size(); ++k) {
    const double x = key_value(c, key);
    const auto slope = [&](double h) {
      const auto plus = series_of(with_values(c, {{key, x + h}}), from, request.channels[k]),
                 minus = series_of(with_values(c, {{key, x - h}}), from, request.channels[k]);
      std::vector<double> d(plus.size());
      for (std::size_t i = 0; i < d.size(); ++i) d[i] = (plus[i] - minus[i]) / (2.0 * h);
      return d;
    };
    const auto coarse = slope(2e-3), fine = slope(1e-3);
    double size = 0.0, error = 0.0, doubt = 0.0;
    for (std::size_t i = 0; i < coarse.size(); ++i) {
      const double truth = (4.0 * fine[i] - coarse[i]) / 3.0;
      size = std::max(size, std::abs(truth));
      doubt = std::max(doubt, std::abs(fine[i] - coarse[i]));
      error = std::max(error, std::abs(truth - run.tangents.values[k](static_cast<Eigen::Index>(i), 0)));
    }
    CAPTURE(key, request.channels[k], size, error, doubt, run.tangents.growth);
    // The differences' own error is (h / 2)^2, 1e-6, of what the extrapolation removes; a run of some metres is
    // rounded to 1e-13, which the step of 1e-3 makes 1e-10.
    CHECK(error <= 1e-3 * doubt + 1e-8 * size + 2e-10);
    CHECK(doubt <= 1e-4 * size);
  }
}

}  // namespace
}  // namespace stillhook
