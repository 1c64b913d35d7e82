// Every kind of key that a fit is made for, one by one: perturbed, fitted to a noisy run of the truth, found again.
#include <catch2/catch.hpp>

#include "tests/tuning/buoy.h"
#include "tuning/identification.h"

namespace stillhook {
namespace {

/// The reference crane's hull alone, with coefficients of the panel method, on four springs.
std::string hull_text() {
  std::string text = R"(
name = "hull"
[sea]
ramp_s = 5.0
[[sea.states]]
name = "swell"
type = "regular"
amplitude_m = 0.5
frequency_rad_per_s = 0.6
heading_deg = 150.0
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
kind = "panels"
critical_fraction_roll = 0.05
)";
  for (int i = 0; i < 4; ++i)
    text += fmt::format(
        "[[moorings]]\nname = \"spring_{0}\"\ntype = \"linear\"\nbody = \"hull\"\nfairlead_m = [0.0, 0.0, 0.0]\n"
        "azimuth_deg = {1}.0\npretension_kN = 500.0\nstiffness_kN_per_m = 300.0\nanchor_distance_m = 300.0\n",
        i, 90 * i);
  return text + "[operation]\n[solver]\ntime_step_s = 0.1\noutput_interval_s = 0.2\nmax_duration_s = 60.0\n";
}

std::string lift_text() {
  std::ifstream file(std::string(STILLHOOK_SOURCE_DIR) + "/tests/planner/cases/small_lift.toml");
  return {std::istreambuf_iterator<char>(file), {}};
}

struct Row {
  const char* key;
  std::string text;
  double off;  // the start, as a share of the truth; an amount for a truth of zero
  double lower, upper;
  const char* kind;  // of the record
  std::vector<Sensor> sensors;
  Vector6 release;
  std::string more;  // of the record
};

Vector6 at(double x, double y, double z, double roll, double pitch) {
  return (Vector6() << x, y, z, roll, pitch, 0.0).finished();
}

const Vector6 kRest = Vector6::Zero();

void check_row(const Row& row) {
  const TemporaryFolder folder;
  const std::string sea = std::string(row.kind) == "regular" ? "swell" : "calm";
  const Case truth = case_of(row.text, {{"sea.active", sea}});
  const double value = key_value(truth, row.key);
  const double start = value != 0.0 ? value * row.off : row.off;
  const std::string file = folder.write("run.csv", measured(truth, row.sensors, row.release, 40.0, 11));
  std::string text = row.text + "[fit]\n" +
                     parameter(row.key, row.lower, row.upper, fmt::format("start = {:.10}", start)) +
                     record("run", file, row.kind, row.more + "\nsea = \"" + sea + "\"\n");
  const Case model = read_case_text(row.text, "model.toml", ".");
  const Model built = build_model(model.specification);
  const Trajectory channels = simulate(built, build_operation(built), [] {
    RunOptions o;
    o.until = 0.5;
    return o;
  }());
  for (const Sensor& s : row.sensors)
    text += column(s.channel, channels.channels[static_cast<std::size_t>(channels.find(s.channel))].unit);
  const Identification r = identify(case_of(text));
  CAPTURE(row.key, value, start, r.message);
  REQUIRE(r.usable);
  const FitEstimate& e = r.estimates.front();
  CAPTURE(e.value, e.sd, r.records[0].channels[0].explained);
  CHECK(r.trusted);
  // One of 16,000 is further off. A single number, from a static pull, is met exactly and has no spread.
  if (e.sd > 0.0) CHECK(std::abs(e.value - value) < 4.0 * e.sd);
  // The interval is no excuse: the estimate is nearer by far than where it began.
  CHECK(std::abs(e.value - value) < 0.1 * std::abs(start - value));
}

TEST_CASE("keys of hydrodynamics are found one by one", "[fit][keys][slow]") {
  const std::string z = "free_body = \"buoy\"\nfree = \"z, vz\"", hz = "free_body = \"hull\"\nfree = \"z, vz\"";
  const std::string roll = "free_body = \"buoy\"\nfree = \"roll, wx\"";
  const std::vector<Row> rows = {
      {"bodies.buoy.hydrodynamics.added_mass_t.2",
       buoy_text(),
       1.4,
       100,
       2000,
       "decay",
       {{"buoy.z", 0.01}},
       at(0, 0, 1.5, 0, 0),
       z},
      {"bodies.buoy.hydrodynamics.added_inertia_t_m2.0",
       buoy_text(),
       0.7,
       300,
       20000,
       "decay",
       {{"buoy.roll", 1e-3}},
       at(0, 0, 0, 0.1, 0),
       roll},
      {"bodies.buoy.hydrodynamics.linear_damping_kN_s_per_m.2",
       buoy_text(),
       0.5,
       0,
       500,
       "decay",
       {{"buoy.z", 0.01}},
       at(0, 0, 1.5, 0, 0),
       z},
      {"bodies.buoy.hydrodynamics.linear_angular_damping_kN_m_s_per_rad.0",
       buoy_text(),
       1.8,
       0,
       20000,
       "decay",
       {{"buoy.roll", 1e-3}},
       at(0, 0, 0, 0.1, 0),
       roll},
      {"bodies.buoy.hydrodynamics.quadratic_damping_kN_s2_per_m2.2",
       buoy_text(),
       0.3,
       0,
       1000,
       "decay",
       {{"buoy.z", 0.01}},
       at(0, 0, 1.5, 0, 0),
       z},
      {"bodies.hull.hydrodynamics.added_mass_factor",
       hull_text(),
       1.3,
       0.3,
       3,
       "decay",
       {{"hull.z", 0.005}},
       at(0, 0, 1.0, 0, 0),
       hz},
      {"bodies.hull.hydrodynamics.radiation_factor",
       hull_text(),
       0.6,
       0.1,
       3,
       "decay",
       {{"hull.z", 0.005}},
       at(0, 0, 1.0, 0, 0),
       hz},
      {"bodies.hull.hydrodynamics.critical_fraction_roll",
       hull_text(),
       1.7,
       0,
       0.5,
       "decay",
       {{"hull.roll", 1e-3}},
       at(0, 0, 0, 0.08, 0),
       "free_body = \"hull\"\nfree = \"roll, wx\""},
      {"bodies.hull.hydrodynamics.diffraction_factor",
       hull_text(),
       0.6,
       0,
       3,
       "regular",
       {{"hull.pitch", 2e-4}},
       kRest,
       ""},
  };
  for (const Row& row : rows) check_row(row);
}

TEST_CASE("keys of lines, masses and waves are found one by one", "[fit][keys][slow]") {
  const std::string x = "free_body = \"buoy\"\nfree = \"x, vx\"";
  const std::vector<Row> rows = {
      {"moorings.*.stiffness_kN_per_m", buoy_text(), 1.4, 2, 200, "decay", {{"buoy.x", 0.01}}, at(2, 0, 0, 0, 0), x},
      {"moorings.spring_0.pretension_kN", buoy_text(), 1.5, 5, 400, "static", {{"buoy.x", 0.001}}, kRest, ""},
      {"wires.fall.axial_stiffness_kN", lift_text(), 0.7, 2e4, 2e6, "regular", {{"fall.tension", 5.0}}, kRest, ""},
      {"wires.fall.damping_ratio", lift_text(), 2.0, 0.001, 0.5, "regular", {{"fall.tension", 2.0}}, kRest, ""},
      {"bodies.buoy.cog_m.0", buoy_text(), 0.2, -1, 1, "static", {{"buoy.pitch", 1e-4}}, kRest, ""},
      {"bodies.buoy.cog_m.2",
       buoy_text(),
       1.1,
       -4,
       0,
       "decay",
       {{"buoy.roll", 1e-3}},
       at(0, 0, 0, 0.1, 0),
       "free_body = \"buoy\"\nfree = \"roll, wx\""},
      {"sea.states.swell.amplitude_m", buoy_text(), 0.6, 0.05, 2, "regular", {{"buoy.z", 0.01}}, kRest, ""},
      {"sea.states.swell.phase_deg", buoy_text(), 40.0, -180, 180, "regular", {{"buoy.z", 0.01}}, kRest, ""},
      {"sea.states.swell.heading_deg", lift_text(), 0.85, 90, 180, "regular", {{"barge.roll", 2e-4}}, kRest, ""},
  };
  for (const Row& row : rows) check_row(row);
}

}  // namespace
}  // namespace stillhook
