// A ship model's measured roll decay (1:11, tank test; tests/tuning/data/README.md says whose).
#include <catch2/catch.hpp>

#include "sim/spatial/constants.h"
#include "tests/tuning/buoy.h"
#include "tuning/identification.h"
#include "tuning/record_unit.h"

namespace stillhook {
namespace {

/// The ship as published: body frame x forward, y to starboard, z down, origin at (9.355, 0, -3.21) m of the hull's file,
/// here turned to y port, z up. 253.31 t; centre of gravity (0.258, 0, 0.432) m; Ixx 1.522e6, Iyy 8.279e6, Izz 7.676e6
/// kg m2 about the origin, here about the centre of gravity. Roll added inertia 3.189e5 kg m2, damping 1.74e4 N m s and
/// 1.45e6 N m s2, fitted by hand. Heave and pitch, for which nothing is published, have an added mass of the ship's own
/// size and a tenth of critical damping, so that they follow the roll quietly.
std::string ship_text(const std::string& hull) {
  return fmt::format(R"(
name = "ship"
[sea]
density_kg_per_m3 = 1025.0
gravity_m_per_s2 = 9.81
[[bodies]]
name = "ship"
mass_t = 253.31
cog_m = [0.258, 0.0, -0.432]
inertia_t_m2 = [1474.7, 8214.9, 7659.1]
position_m = [0.0, 0.0, 0.0]
[bodies.hull]
shape = "mesh"
mesh_file = '{}'
mesh_mend = true
mesh_origin_m = [-9.355, 0.0, -3.21]
mesh_attitude_deg = [180.0, 0.0, 0.0]
[bodies.hydrodynamics]
kind = "constant"
added_mass_t = [0.0, 0.0, 250.0]
added_inertia_t_m2 = [318.9, 8000.0, 0.0]
linear_angular_damping_kN_m_s_per_rad = [17.4, 0.0, 0.0]
quadratic_angular_damping_kN_m_s2_per_rad2 = [1450.0, 0.0, 0.0]
critical_fraction_heave = 0.1
critical_fraction_pitch = 0.1
[operation]
[solver]
time_step_s = 0.1
output_interval_s = 0.1
max_duration_s = 30.0
)",
                     hull);
}

std::string roll_record(const std::string& file) {
  return "[[fit.records]]\nname = \"decay\"\nfile = '" + file +
         "'\nkind = \"decay\"\nfree_body = \"ship\"\nfree = \"roll, wx\"\n"
         "[[fit.records.columns]]\nchannel = \"ship.roll\"\ncolumn = \"roll_deg\"\nunit = \"deg\"\nreversed = true\n"
         "estimate_offset = true\n";
}

/// Residuals with the case's own coefficients and the start of the run fitted to them: the best they can do. rad
double rms_by_hand(const Case& c) {
  const RecordModel model = record_model(c, c.fit.records[0]);
  const FitParameters parameters{c.fit.parameters};
  VectorX values(3);
  for (int i = 0; i < 3; ++i) values[i] = key_value(c, c.fit.parameters[static_cast<std::size_t>(i)].key);
  FitProblem problem;
  problem.blocks = {{parameters.scaled(values), {}, {}, true}, {own_start(model, values), {}, {}, false}};
  problem.units = {record_unit(model, parameters, {1.0}, 1)};
  FitOptions squares;
  squares.robust = 1e6;
  REQUIRE(solve_fit(problem, squares).usable);
  return std::sqrt(evaluate_units(problem)[0].r.squaredNorm() / static_cast<double>(valid_samples(model.data).size()));
}

TEST_CASE("measured roll decay of a ship model", "[fit][slow]") {
  const std::string data = STILLHOOK_SOURCE_DIR "/tests/tuning/data/";
  const std::string run = data + "ship_model_roll_decay.csv", hull = data + "ship_model_hull.obj";
  const std::string at = "bodies.ship.hydrodynamics.";
  const Case c = case_of(ship_text(hull) + "[fit]\n" + parameter(at + "added_inertia_t_m2.0", 50.0, 1500.0) +
                         parameter(at + "linear_angular_damping_kN_m_s_per_rad.0", 0.0, 200.0) +
                         parameter(at + "quadratic_angular_damping_kN_m_s2_per_rad2.0", 0.0, 10000.0) + roll_record(run));
  const Identification fit = identify(c);
  REQUIRE(fit.trusted);
  const double by_hand = rms_by_hand(c), fitted = fit.records[0].channels[0].rms_after;
  REQUIRE(fit.records[0].decays.size() == 1);
  const DecayComparison& decay = fit.records[0].decays[0];
  INFO("rms by hand " << by_hand << " rad, fitted " << fitted << " rad");
  // Found: 0.3 % and 0.146 deg. Half a per cent of 6.3 s is a fifth of a sample of the record; what is left of the fit is
  // the record's own noise of a tenth of a degree and the tank's reflections. The publishers' own numbers leave 0.88 deg.
  CHECK(decay.measured.period == Approx(6.337).epsilon(0.002));
  CHECK(decay.simulated.period == Approx(decay.measured.period).epsilon(0.005));
  CHECK(fitted < 0.17 * kDegree);
  CHECK(by_hand == Approx(0.884 * kDegree).epsilon(0.02));
}

}  // namespace
}  // namespace stillhook
