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

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("BEMIO's numbers become those of the hull", "[bemio_file]") {
  const TemporaryFolder folder;
  SmallFile small;
  const bool scaled = GENERATE(false, true);
  if (scaled) small.at("/simulation_parameters/scaled", 0) = 1.0;
  small.write(folder / "small.h5");
  const HydrodynamicCoefficients c = read_bemio(folder / "small.h5", frame());
  const double mass = scaled ? 1.0 : 1000.0, force = scaled ? 1.0 : 10000.0;
  CHECK(c.description.find("from NEMOH") != std::string::npos);
  CHECK(c.density == 1000.0);
  CHECK(c.gravity == 10.0);
  CHECK(c.volume == std::vector<double>{25.0});
  CHECK(c.waterplane[0] == Approx(scaled ? 13.0 / 10000.0 : 13.0));
  CHECK(c.waterline == 0.5);
  CHECK(c.A_inf(3, 3) == Approx(4.0 * mass));
  REQUIRE(c.frequency.size() == 3);
  CHECK(c.frequency[0].frequency == 0.5);
  CHECK(c.frequency[1].frequency == 1.0);
  CHECK(c.frequency[0].A(1, 1) == Approx(6.0 * mass));  // second in the file
  CHECK(c.frequency[1].A(1, 1) == Approx(5.0 * mass));  // first
  CHECK(c.frequency[1].A(2, 4) == Approx(-0.75 * mass));
  CHECK(c.frequency[1].A(4, 2) == 0.0);
  CHECK(c.frequency[0].B(1, 1) == Approx(0.6 * (scaled ? 1.0 : 0.5 * 1000.0)));
  CHECK(c.frequency[2].B(1, 1) == Approx(0.7 * (scaled ? 1.0 : 2.0 * 1000.0)));
  // Phase at Bo, which lies 1 m to starboard of the global origin: k.p = -k for waves to port, k = 0.025.
  const Complex expected = force * std::conj(Complex(3.0, 1.0)) * std::exp(Complex(0.0, 0.025));
  CHECK(std::abs(c.excitation.at(0, 1, 2) - expected) < 1e-9 * force);
  CHECK(c.excitation.at(1, 1, 2) == 0.0);
  CHECK(c.excitation.at(0, 3, 2) == 0.0);
  CHECK(c.retardation.kernels.size() == 6);  // of B: the file has none
}

TEST_CASE("the moment about a body origin away from the centre of gravity", "[bemio_file]") {
  const TemporaryFolder folder;
  SmallFile small;
  small.write(folder / "small.h5");
  DatabaseFrame f = frame();
  f.bodies[0].origin = Vector3(5.0, -1.0, -0.5);  // 3 m ahead of cg: heave forces bow-up there press the bow down
  const HydrodynamicCoefficients c = read_bemio(folder / "small.h5", f);
  // M_Bo = (cg - Bo) x F = (-3, 0, 0) x (0, 0, Fz) = (0, 3 Fz, 0)
  CHECK(std::abs(c.excitation.at(0, 1, 4) - 3.0 * c.excitation.at(0, 1, 2)) < 1e-6);
  CHECK(std::abs(c.excitation.at(0, 1, 3)) < 1e-9);
  // A_55 = A_55(cg) + 9 A_33, A_35 = 3 A_33 by the same arm.
  CHECK(c.A_inf(4, 4) == Approx(4000.0 + 9.0 * 4000.0));
  CHECK(c.A_inf(2, 4) == Approx(3.0 * 4000.0));
}

TEST_CASE("retardation functions of the file are taken as they are", "[bemio_file]") {
  const TemporaryFolder folder;
  SmallFile small;
  small.with_kernels();
  small.write(folder / "small.h5");
  const HydrodynamicCoefficients c = read_bemio(folder / "small.h5", frame());
  CHECK(c.retardation.interval == Approx(0.2));
  REQUIRE(c.retardation.kernels.size() == 1);
  CHECK(c.retardation.kernels[0].i == 2);
  CHECK(c.retardation.kernels[0].j == 2);
  CHECK(c.retardation.kernels[0].value == std::vector<double>{4000.0, 3000.0, 2000.0, 1000.0});
}

TEST_CASE("what other programs leave out of a BEMIO file is not needed", "[bemio_file]") {
  const TemporaryFolder folder;
  SmallFile small;
  small.with_kernels();
  small.write(folder / "whole.h5");
  const std::string h = "/body1/hydro_coeffs/";
  for (const char* name : {"/simulation_parameters/scaled", "/simulation_parameters/T", "/body1/properties/dof"})
    small.numbers.erase(name);
  // Magnitude and phase in place of real and imaginary part; no table of A and B beside the retardation functions.
  Hdf5Array magnitude = small.numbers[h + "excitation/re"], phase = magnitude;
  for (std::size_t n = 0; n < magnitude.value.size(); ++n) {
    const Complex x(small.numbers[h + "excitation/re"].value[n], small.numbers[h + "excitation/im"].value[n]);
    magnitude.value[n] = std::abs(x);
    phase.value[n] = std::arg(x);
  }
  small.numbers[h + "excitation/mag"] = magnitude;
  small.numbers[h + "excitation/phase"] = phase;
  for (const char* name : {"excitation/re", "excitation/im", "added_mass/all", "radiation_damping/all"})
    small.numbers.erase(h + name);
  small.write(folder / "spare.h5");
  const HydrodynamicCoefficients whole = read_bemio(folder / "whole.h5", frame());
  const HydrodynamicCoefficients spare = read_bemio(folder / "spare.h5", frame());
  CHECK(spare.frequency.empty());
  CHECK(spare.A_inf == whole.A_inf);
  CHECK(spare.retardation.kernels[0].value == whole.retardation.kernels[0].value);
  REQUIRE(spare.excitation.value.size() == whole.excitation.value.size());
  for (std::size_t n = 0; n < spare.excitation.value.size(); ++n)
    CHECK(std::abs(spare.excitation.value[n] - whole.excitation.value[n]) < 1e-9);  // rounding, of 3e4 N/m
}

TEST_CASE("frequencies that feel the bottom can be left out of a BEMIO file", "[bemio_file]") {
  const TemporaryFolder folder;
  SmallFile small;
  small.with_kernels();
  small.texts.erase("/simulation_parameters/water_depth");
  small.numbers["/simulation_parameters/water_depth"] = {{1, 1}, {35.0}};  // k h = 3.5 at 1 rad/s
  small.write(folder / "small.h5");
  DatabaseFrame f = frame();
  f.lowest = 0.95;
  // Of three frequencies too few are left for retardation functions of their own; those of the file hold all of B.
  CHECK_THROWS_WITH(read_bemio(folder / "small.h5", f), Catch::Contains("fewer than three frequencies"));
  for (const char* name : {"added_mass/all", "radiation_damping/all"})
    small.numbers.erase(std::string("/body1/hydro_coeffs/") + name);
  small.write(folder / "small.h5");
  const HydrodynamicCoefficients c = read_bemio(folder / "small.h5", f);
  CHECK(c.excitation.frequencies == std::vector<double>{1.0, 2.0});
  CHECK(c.retardation.kernels.size() == 1);  // there is nothing else to know the radiation by
}

TEST_CASE("broken BEMIO files are refused", "[bemio_file]") {
  struct Broken {
    std::function<void(SmallFile&)> change;
    std::string part;
  };
  const std::string p = "/simulation_parameters/", h = "/body1/hydro_coeffs/";
  const auto without = [](const std::string& name) { return [name](SmallFile& s) { s.numbers.erase(name); }; };
  const std::vector<Broken> corpus = {
      {without(p + "rho"), p + "rho is missing"},
      {without(p + "w"), p + "w is missing"},
      {without(h + "added_mass/inf_freq"), "added_mass/inf_freq is missing"},
      {without(h + "radiation_damping/all"), "radiation_damping/all is missing"},
      {without(h + "excitation/im"), "excitation/im is missing"},
      {without("/body1/properties/cg"), "properties/cg is missing"},
      {[&](SmallFile& s) { s.texts.erase(p + "water_depth"); }, "water_depth is missing"},
      {[&](SmallFile& s) { s.texts[p + "water_depth"] = "deep"; }, "got \"deep\""},
      {[&](SmallFile& s) {
         s.texts.erase(p + "water_depth");
         s.numbers[p + "water_depth"] = {{1, 1}, {30.0}};
       },
       "depth of 30 m, which waves of 0.5 rad/s feel"},
      {[&](SmallFile& s) {
         s.numbers[h + "added_mass/all"].shape = {3, 6, 6};
       },
       "must be [6][6][3]"},
      {[&](SmallFile& s) {
         s.numbers[h + "excitation/re"].shape = {6, 3, 4};
       },
       "must be [6][4][3]"},
      {[&](SmallFile& s) { s.at(h + "added_mass/inf_freq", 0) = std::nan(""); }, "not finite"},
      {[&](SmallFile& s) { s.B(1, 1, 0) = kInfinite; }, "not finite"},
      {[&](SmallFile& s) { s.at(p + "rho", 0) = 0.0; }, "must be > 0"},
      {[&](SmallFile& s) { s.at(p + "w", 0) = 0.5; }, "comes twice"},
      {[&](SmallFile& s) { s.at(p + "w", 0) = -1.0; }, "must be >= 0"},
      {[&](SmallFile& s) { s.at(p + "T", 0) = 1.0; }, "not 2 pi / w"},
      {[&](SmallFile& s) { s.at("/body1/properties/dof", 0) = 8.0; }, "other than six modes"},
      {[&](SmallFile& s) { s.at("/body1/properties/disp_vol", 0) = 0.0; }, "disp_vol must be > 0"},
      {[&](SmallFile& s) {
         s.numbers["/body2/properties/dof"] = {{1, 1}, {6.0}};
       },
       "holds 2 bodies, it is read for 1: say which with database_body = 1 to 2"},
      {[&](SmallFile& s) {
         s.with_kernels();
         s.at(h + "radiation_damping/impulse_response_fun/t", 2) = 0.5;
       },
       "evenly spaced"},
      {[&](SmallFile& s) {
         s.with_kernels();
         s.at(h + "radiation_damping/impulse_response_fun/t", 0) = 0.1;
       },
       "begin at 0"},
      {[&](SmallFile& s) {
         s.numbers.erase(p + "g");
         s.texts[p + "g"] = "ten";
       },
       "not of numbers"},
  };
  const TemporaryFolder folder;
  for (const Broken& broken : corpus) {
    SmallFile small;
    broken.change(small);
    small.write(folder / "broken.h5");
    INFO(broken.part);
    try {
      read_bemio(folder / "broken.h5", frame());
      FAIL_CHECK("was accepted");
    } catch (const SpecificationError& error) {
      INFO(error.what());
      CHECK(error.entry == folder / "broken.h5");
      CHECK(std::string(error.what()).find(broken.part) != std::string::npos);
    }
  }
}

TEST_CASE("files that are no BEMIO files are refused, cut off anywhere or foreign", "[bemio_file]") {
  const TemporaryFolder folder;
  SmallFile small;
  small.with_kernels();
  small.write(folder / "small.h5");
  std::ifstream in(folder / "small.h5", std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  for (int part = 0; part < 20; ++part) {
    folder.write("cut.h5", whole.substr(0, whole.size() * static_cast<std::size_t>(part) / 20));
    CHECK_THROWS_AS(read_bemio(folder / "cut.h5", frame()), SpecificationError);
  }
  CHECK_THROWS_WITH(read_bemio(folder.write("text.h5", "stillhook_coefficients,1\n"), frame()),
                    Catch::Contains("is not an HDF5 file"));
  CHECK_THROWS_WITH(read_bemio("/nowhere/hull.h5", frame()), Catch::Contains("/nowhere/hull.h5: cannot be opened"));
  Hdf5File other(folder / "other.h5", Hdf5File::Mode::create);
  other.write("/results/x", {{1}, {2.0}}, "");
  other.close();
  CHECK_THROWS_WITH(read_bemio(folder / "other.h5", frame()), Catch::Contains("is not a BEMIO file"));
}

TEST_CASE("one body of several in a BEMIO file is read when it is named", "[bemio_file]") {
  const TemporaryFolder folder;
  const HydrodynamicCoefficients c = pair_set();
  write_bemio(folder / "set.h5", c, frame_of(c), bodies_of(c));
  const int chosen = GENERATE(1, 2);
  const auto at = static_cast<Eigen::Index>(6 * (chosen - 1));
  DatabaseFrame one = frame_of(c);
  one.bodies = {one.bodies[static_cast<std::size_t>(chosen - 1)]};
  one.chosen = chosen;
  const HydrodynamicCoefficients back = read_bemio(folder / "set.h5", one);
  CHECK(difference(c.A_inf.block(at, at, 6, 6), back.A_inf) < 1e-11);  // rounding of moving to cg and back
  CHECK(difference(c.frequency[3].B.block(at, at, 6, 6), back.frequency[2].B) < 1e-9);
  CHECK(std::abs(back.excitation.at(1, 1, 4) - c.excitation.at(1, 1, static_cast<int>(at) + 4)) <
        1e-9 * std::abs(c.excitation.at(1, 1, static_cast<int>(at) + 4)));
  for (const RetardationKernel& kernel : back.retardation.kernels) CHECK((kernel.i < 6 && kernel.j < 6));
  CHECK(back.remarks.size() == 1);
}

}  // namespace stillhook
