#include "sim/hull/bemio_file.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <sstream>

#include "sim/hull/hdf5_file.h"
#include "sim/specification.h"
#include "tests/sim/coefficient_sets.h"
#include "tests/sim/temporary_folder.h"

namespace stillhook {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// The datasets of a small file, as BEMIO would make it: one body, w = 1, 0.5, 2 in this order (others sort periods),
/// four headings. Written without the writer under test.
struct SmallFile {
  std::map<std::string, Hdf5Array> numbers;
  std::map<std::string, std::string> texts;

  static constexpr double rho = 1000.0, g = 10.0;

  SmallFile() {
    texts["/bem_data/code"] = "NEMOH";
    texts["/body1/properties/name"] = "float";
    texts["/simulation_parameters/water_depth"] = "infinite";
    const std::string p = "/simulation_parameters/", b = "/body1/properties/", h = "/body1/hydro_coeffs/";
    numbers[p + "scaled"] = {{1, 1}, {0.0}};
    numbers[p + "rho"] = {{1, 1}, {rho}};
    numbers[p + "g"] = {{}, {g}};  // a scalar, as h5py writes it
    numbers[p + "w"] = {{3, 1}, {1.0, 0.5, 2.0}};
    numbers[p + "T"] = {{3}, {2.0 * std::numbers::pi, 4.0 * std::numbers::pi, std::numbers::pi}};
    numbers[p + "wave_dir"] = {{4, 1}, {0.0, 90.0, 180.0, 270.0}};
    numbers[b + "dof"] = {{1, 1}, {6.0}};
    numbers[b + "disp_vol"] = {{1, 1}, {25.0}};
    numbers[b + "cg"] = {{3, 1}, {2.0, -1.0, -0.5}};
    numbers[h + "linear_restoring_stiffness"] = {{6, 6}, std::vector<double>(36, 0.0)};
    numbers[h + "linear_restoring_stiffness"].value[14] = 13.0;
    numbers[h + "added_mass/inf_freq"] = {{6, 6}, std::vector<double>(36, 0.0)};
    Hdf5Array matrix{{6, 6, 3}, std::vector<double>(108, 0.0)};
    numbers[h + "added_mass/all"] = numbers[h + "radiation_damping/all"] = matrix;
    Hdf5Array force{{6, 4, 3}, std::vector<double>(72, 0.0)};
    numbers[h + "excitation/re"] = numbers[h + "excitation/im"] = force;
    for (int i = 0; i < 6; ++i) {
      numbers[h + "added_mass/inf_freq"].value[static_cast<std::size_t>(7 * i)] = 4.0;
      for (int f = 0; f < 3; ++f) {
        A(i, i, f) = 5.0 + f;
        B(i, i, f) = 0.5 + 0.1 * f;
      }
    }
    A(2, 4, 0) = -0.75;  // not its transpose: an order of dimensions that is reversed would be seen
    re(2, 1, 1) = 3.0;   // heave, 90 deg, 0.5 rad/s
    im(2, 1, 1) = 1.0;
  }

  double& A(int i, int j, int f) { return at("/body1/hydro_coeffs/added_mass/all", (i * 6 + j) * 3 + f); }
  double& B(int i, int j, int f) { return at("/body1/hydro_coeffs/radiation_damping/all", (i * 6 + j) * 3 + f); }
  double& re(int i, int h, int f) { return at("/body1/hydro_coeffs/excitation/re", (i * 4 + h) * 3 + f); }
  double& im(int i, int h, int f) { return at("/body1/hydro_coeffs/excitation/im", (i * 4 + h) * 3 + f); }
  double& at(const std::string& name, int n) { return numbers.at(name).value[static_cast<std::size_t>(n)]; }

  void with_kernels() {
    const std::string name = "/body1/hydro_coeffs/radiation_damping/impulse_response_fun/";
    numbers[name + "t"] = {{4, 1}, {0.0, 0.2, 0.4, 0.6}};
    numbers[name + "K"] = {{6, 6, 4}, std::vector<double>(144, 0.0)};
    for (int m = 0; m < 4; ++m) at(name + "K", (2 * 6 + 2) * 4 + m) = 4.0 - m;
  }

  void write(const std::string& path) const {
    Hdf5File file(path, Hdf5File::Mode::create);
    for (const auto& [name, array] : numbers) file.write(name, array, "");
    for (const auto& [name, text] : texts) file.write(name, text);
    file.close();
  }
};

DatabaseFrame frame() {
  DatabaseFrame f;
  f.length = 8.0;
  f.bodies = {{Vector3(2.0, -1.0, -0.5), 0.0}};  // Bo in the centre of gravity of the small file
  f.retardation = {10.0, 0.1};
  return f;
}

DatabaseFrame frame_of(const HydrodynamicCoefficients& c) {
  DatabaseFrame f;
  f.length = c.length;
  f.bodies = {{Vector3(10.0, 4.0, -c.waterline), 0.0}};
  if (c.hulls() == 2) f.bodies.push_back({Vector3(-7.0, 60.0, -c.waterline), 0.0});
  return f;
}

std::vector<BemioBody> bodies_of(const HydrodynamicCoefficients& c) {
  std::vector<BemioBody> bodies = {{"crane", Vector3(12.0, 4.0, 7.0), Vector3(12.0, 4.0, -2.0), Matrix6::Identity()}};
  if (c.hulls() == 2)
    bodies.push_back({"barge", Vector3(-7.0, 61.0, 3.0), Vector3(-7.0, 61.0, -2.0), Matrix6::Identity()});
  for (std::size_t n = 0; n < bodies.size(); ++n) bodies[n].stiffness(2, 2) = c.density * c.gravity * c.waterplane[n];
  return bodies;
}

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
