// BEMIO files as they are written here, read back and as WEC-Sim reads them.
#include "sim/hull/coefficients/bemio_file.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <sstream>

#include "sim/hull/coefficients/hdf5_file.h"
#include "sim/specification.h"
#include "tests/sim/bemio_sample.h"
#include "tests/sim/coefficient_sets.h"
#include "tests/sim/temporary_folder.h"

namespace stillhook {

using namespace bemio_sample;

TEST_CASE("one hull and two travel through a BEMIO file and back", "[bemio_file]") {
  const TemporaryFolder folder;
  const bool two = GENERATE(false, true);
  HydrodynamicCoefficients c = two ? pair_set() : crane_set();
  c.waterline = 0.25;
  write_bemio(folder / "set.h5", c, frame_of(c), bodies_of(c));
  CHECK(folder.files() == 1);
  const HydrodynamicCoefficients back = read_bemio(folder / "set.h5", frame_of(c));
  // Doubles throughout; moving to cg and back leaves rounding of moments about other points.
  CHECK(difference(c.A_inf, back.A_inf) < 1e-11);
  REQUIRE(back.frequency.size() == c.excitation.frequencies.size());
  for (std::size_t n = 0; n < back.frequency.size(); ++n) {
    CHECK(back.frequency[n].frequency == c.frequency[n + 1].frequency);  // without zero frequency
    CHECK(difference(c.frequency[n + 1].A, back.frequency[n].A) < 1e-11);
    CHECK(difference(c.frequency[n + 1].B, back.frequency[n].B) < 1e-9);
  }
  for (double w : {0.3, 0.7})
    CHECK(difference(damping_from_kernels(c.retardation, c.modes(), w) + 1e-3 * c.A_inf,
                     damping_from_kernels(back.retardation, c.modes(), w) + 1e-3 * back.A_inf) < 1e-9);
  CHECK(difference(c.excitation, back.excitation) < 1e-11);
  CHECK(back.volume == c.volume);
  CHECK(back.waterline == 0.25);
  for (std::size_t n = 0; n < c.waterplane.size(); ++n) CHECK(back.waterplane[n] == Approx(c.waterplane[n]));
}

TEST_CASE("what a BEMIO file written here looks like to WEC-Sim", "[bemio_file]") {
  const TemporaryFolder folder;
  HydrodynamicCoefficients c = crane_set();
  DatabaseFrame f;
  f.length = c.length;
  write_bemio(folder / "set.h5", c, f, {{"crane", Vector3::Zero(), Vector3(0, 0, -2), Matrix6::Identity()}});
  const Hdf5File file(folder / "set.h5", Hdf5File::Mode::read);
  const std::string h = "/body1/hydro_coeffs/";
  // MATLAB shows the dimensions in reverse: lists are rows there, arrays [w][heading or mode][mode].
  CHECK(file.numbers("/simulation_parameters/w").shape == std::vector<std::size_t>{6, 1});
  CHECK(file.numbers("/body1/properties/cb").shape == std::vector<std::size_t>{3, 1});
  CHECK(file.numbers(h + "added_mass/all").shape == std::vector<std::size_t>{6, 6, 6});
  CHECK(file.numbers(h + "excitation/mag").shape == std::vector<std::size_t>{6, 8, 6});
  CHECK(file.numbers(h + "radiation_damping/impulse_response_fun/K").shape == std::vector<std::size_t>{6, 6, 401});
  CHECK(file.text("/simulation_parameters/water_depth") == "infinite");
  CHECK(file.text("/body1/properties/name") == "crane");
  // By hand from the hull's file: heave at 0.4 rad/s.
  CHECK(file.numbers(h + "added_mass/all").value[14 * 6] == Approx(1.207072e8 / 1025.0));
  CHECK(file.numbers(h + "radiation_damping/all").value[14 * 6] == Approx(2.647073e7 / (1025.0 * 0.4)));
  CHECK(file.numbers(h + "linear_restoring_stiffness").value[14] == Approx(1.0 / (1025.0 * 9.80665)));
  // A lag there is a negative phase.
  const double phase = file.numbers(h + "excitation/phase").value[2 * 8 * 6];
  CHECK(phase == Approx(-std::arg(c.excitation.at(0, 0, 2))));
  const double re = file.numbers(h + "excitation/re").value[2 * 8 * 6],
               im = file.numbers(h + "excitation/im").value[2 * 8 * 6];
  CHECK(std::atan2(im, re) == Approx(phase));
  CHECK(std::hypot(re, im) == Approx(std::abs(c.excitation.at(0, 0, 2)) / (1025.0 * 9.80665)));
}

TEST_CASE("a set that a BEMIO file cannot hold is refused", "[bemio_file]") {
  const TemporaryFolder folder;
  HydrodynamicCoefficients c = crane_set();
  c.retardation = {};
  c.frequency.pop_back();
  const BemioBody body{"crane", Vector3::Zero(), Vector3::Zero(), Matrix6::Identity()};
  DatabaseFrame f;
  f.length = c.length;
  CHECK_THROWS_WITH(write_bemio(folder / "set.h5", c, f, {body}), Catch::Contains("at all frequencies"));
  CHECK_THROWS_WITH(write_bemio(folder / "set.h5", c, f, {}), Catch::Contains("every hull"));
  c.excitation = {};
  CHECK_THROWS_WITH(write_bemio(folder / "set.h5", c, f, {body}), Catch::Contains("no excitation"));
  CHECK(folder.files() == 0);
  CHECK_THROWS_WITH(write_bemio("/nowhere/set.h5", crane_set(), f, {body}),
                    Catch::Contains("/nowhere/set.h5: cannot be written"));
}

}  // namespace stillhook
