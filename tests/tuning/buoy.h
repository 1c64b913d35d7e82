// A small lift to fit: a box afloat on four springs, and measured runs of it that the test makes.
#pragma once

#include <fmt/core.h>

#include <string>
#include <vector>

#include "problems/case.h"
#include "sim/simulate.h"
#include "tests/tuning/measured_file.h"

namespace stillhook {

/// The case without its [fit] section.
inline std::string buoy_text() {
  std::string text = R"(
name = "buoy"
[sea]
ramp_s = 5.0
[[sea.states]]
name = "swell"
type = "regular"
amplitude_m = 0.4
frequency_rad_per_s = 0.8
[[sea.states]]
name = "chop"
type = "jonswap"
significant_height_m = 0.8
peak_period_s = 7.0
components = 20
[[bodies]]
name = "buoy"
mass_t = 1000.0
cog_m = [0.0, 0.0, -2.0]
gyration_m = [4.0, 4.0, 4.0]
position_m = [0.0, 0.0, -0.775]
[bodies.hull]
shape = "box"
size_m = [12.0, 12.0, 12.0]
[bodies.hydrodynamics]
kind = "constant"
added_mass_t = [300.0, 300.0, 600.0]
added_inertia_t_m2 = [3000.0, 3000.0, 3000.0]
linear_damping_kN_s_per_m = [20.0, 20.0, 60.0]
linear_angular_damping_kN_m_s_per_rad = [1000.0, 1000.0, 1000.0]
quadratic_damping_kN_s2_per_m2 = [0.0, 0.0, 150.0]
)";
  const std::vector<std::string> fairleads = {"[6.0, 0.0, 0.0]", "[0.0, 6.0, 0.0]", "[-6.0, 0.0, 0.0]", "[0.0, -6.0, 0.0]"};
  for (int i = 0; i < 4; ++i)
    text += fmt::format(
        "[[moorings]]\nname = \"spring_{}\"\ntype = \"linear\"\nbody = \"buoy\"\nfairlead_m = {}\nazimuth_deg = {}.0\n"
        "pretension_kN = 50.0\nstiffness_kN_per_m = 20.0\nanchor_distance_m = 100.0\n",
        i, fairleads[static_cast<std::size_t>(i)], 90 * i);
  return text + "[operation]\n[solver]\ntime_step_s = 0.1\noutput_interval_s = 0.2\nmax_duration_s = 60.0\n";
}

inline Case case_of(const std::string& text, const std::vector<Override>& overrides = {}) {
  return read_case_text(text, "buoy.toml", ".", overrides);
}

/// What a sensor would have shown: channels of a run with noise, as CSV in SI. With a start displaced by `release` (six
/// numbers: m, rad) of the first body.
struct Sensor {
  std::string channel;
  double noise = 0.0;
};

inline std::string measured(const Case& c, const std::vector<Sensor>& sensors, const Vector6& release, double duration,
                            unsigned seed) {
  Specification spec = c.specification;
  spec.solver.max_duration = duration;
  const Model model = build_model(spec);
  SystemState from = model.initial_state();
  BodyKinematics& k = from.body[0];
  const Vector3 cog = spec.bodies[0].cog, origin = k.p_WC - k.R_WB * cog;
  k.R_WB = k.R_WB * exp_rotation(release.tail<3>());
  k.p_WC = origin + release.head<3>() + k.R_WB * cog;
  RunOptions options;
  options.from = &from;
  const Trajectory run = simulate(model, build_operation(model), options);
  Noise noise(seed);
  std::string text = "t_s";
  for (const Sensor& sensor : sensors) text += "," + sensor.channel;
  text += "\n";
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    text += fmt::format("{:.10g}", run.time[i]);
    for (const Sensor& sensor : sensors)
      text += fmt::format(",{:.12g}",
                          run.values[static_cast<std::size_t>(run.find(sensor.channel))][i] + sensor.noise * noise());
    text += "\n";
  }
  return text;
}

inline std::string column(const std::string& channel, const std::string& unit, const std::string& more = "") {
  return fmt::format("[[fit.records.columns]]\nchannel = \"{}\"\nunit = \"{}\"\n{}\n", channel, unit, more);
}

inline std::string record(const std::string& name, const std::string& file, const std::string& kind,
                          const std::string& more) {
  return fmt::format("[[fit.records]]\nname = \"{}\"\nfile = '{}'\nkind = \"{}\"\n{}\n", name, file, kind, more);
}

inline std::string parameter(const std::string& key, double low, double high, const std::string& more = "") {
  return fmt::format("[fit.parameters.\"{}\"]\nmin = {:.10}\nmax = {:.10}\n{}\n", key, low, high, more);
}

}  // namespace stillhook
