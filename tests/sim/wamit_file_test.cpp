#include "sim/hull/coefficients/wamit_file.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <tuple>

#include "sim/hull/coefficients/wamit_text.h"
#include "sim/specification.h"
#include "tests/sim/coefficient_sets.h"
#include "tests/sim/wamit_sample.h"

namespace stillhook {

using namespace wamit_sample;

TEST_CASE("Fortran's numbers are read as Fortran means them", "[wamit_file]") {
  double value = 0.0;
  const auto reads = [&](const char* text) { return fortran_number(text, value); };
  CHECK((reads("1.0D+03") && value == 1000.0));
  CHECK((reads("-0.5d-1") && value == -0.05));
  CHECK((reads("1.234-100") && value == 1.234e-100));
  CHECK((reads("-1.5+002") && value == -150.0));
  CHECK((reads("+.25E1") && value == 2.5));
  CHECK((reads("7.") && value == 7.0));
  CHECK((reads("1.0-999") && value == 0.0));
  for (const char* text :
       {"********", "NaN", "Infinity", "1.0D", "E5", "1.0+400", "1..2", "1.0E+3-2", "-", "", "0x10"}) {
    INFO(text);
    CHECK_FALSE(reads(text));
  }
}

TEST_CASE("WAMIT's numbers become those of the hull", "[wamit_file]") {
  const Files files;
  const HydrodynamicCoefficients c = read_wamit(files.base, units(), frame());
  // By hand, rho = 1000, ULEN = 2, g = 10: rho L^3 = 8000, L^4: 16000, L^5: 32000; rho g L^2 = 40000, L^3: 80000.
  CHECK(c.A_inf(2, 2) == Approx(8000.0));
  CHECK(c.A_inf(2, 4) == Approx(-4000.0));
  CHECK(c.A_inf(4, 4) == Approx(96000.0));
  CHECK(c.A_inf(0, 0) == 0.0);
  REQUIRE(c.frequency.size() == 4);
  CHECK(c.frequency[0].frequency == 0.0);
  CHECK(c.frequency[0].A(2, 2) == Approx(16000.0));
  CHECK(c.frequency[1].frequency == Approx(0.5).epsilon(1e-9));
  CHECK(c.frequency[1].A(2, 2) == Approx(10000.0));
  CHECK(c.frequency[1].B(2, 2) == Approx(2000.0).epsilon(1e-9));  // 0.5 * 8000 * 0.5 rad/s
  CHECK(c.frequency[1].B(2, 4) == Approx(800.0));
  CHECK(c.frequency[2].B(4, 4) == Approx(8000.0));
  CHECK(c.frequency[3].frequency == Approx(1.5));
  CHECK(c.excitation.frequencies.size() == 1);
  REQUIRE(c.excitation.headings.size() == 4);
  // exp(+i w t) with +36.9 deg leads; here a lead has a negative phase.
  CHECK(std::abs(c.excitation.at(0, 0, 2) - Complex(32000.0, -24000.0)) < 1e-6);
  CHECK(std::abs(c.excitation.at(0, 0, 4) - Complex(64000.0, -48000.0)) < 1e-6);
  CHECK(std::abs(c.excitation.at(0, 1, 3) - Complex(0.0, -24000.0)) < 1e-6);
  CHECK(std::abs(c.excitation.at(0, 3, 3) - Complex(0.0, 24000.0)) < 1e-6);  // the mirror image
  CHECK(c.excitation.at(0, 3, 2) == c.excitation.at(0, 1, 2));
  CHECK(c.volume == std::vector<double>{20.0});
  REQUIRE(c.waterplane.size() == 1);
  CHECK(c.waterplane[0] == Approx(48.0));  // 12 L^2
  CHECK(c.waterline == 0.0);
  CHECK(c.length == 8.0);
  CHECK(c.retardation.kernels.size() == 4);
}

TEST_CASE("forces about another point and phases at another origin are moved, as forces in time", "[wamit_file]") {
  // The truth in time: the force of the file about XBODY in the wave of the file, against ours about Bo in the same
  // wave.
  const Vector3 reference(1.5, -0.7, -0.4), origin(30.0, -12.0, 0.8);
  const Files files(kRadiation, excitation({"0", "90", "180", "-90"}));
  WamitUnits u = units();
  u.reference = {reference};
  DatabaseFrame f = frame();
  f.port_starboard = false;
  f.bodies[0].origin = origin;
  const HydrodynamicCoefficients c = read_wamit(files.base, u, f);
  CHECK(c.waterline == Approx(-0.8));
  REQUIRE(c.excitation.headings.size() == 4);
  CHECK(c.excitation.headings[3] == Approx(1.5 * std::numbers::pi));
  const double w = 1.0, k = w * w / 10.0;
  for (double t : {0.0, 0.9, 2.3}) {
    const Complex turn = std::exp(Complex(0.0, w * t));
    const Complex even = Complex(0.8, 0.6), odd = Complex(0.0, 0.3);
    const Vector3 F(40000.0 * (even * turn).real(), 40000.0 * (odd * turn).real(), 40000.0 * (even * turn).real());
    const Vector3 M(80000.0 * (odd * turn).real(), 80000.0 * (even * turn).real(), 80000.0 * (odd * turn).real());
    const Vector3 expected = M + (reference - origin).cross(F);
    const double th = k * origin.y() - w * t;  // heading 90 deg
    for (int i = 0; i < 3; ++i) {
      CHECK((c.excitation.at(0, 1, i) * std::exp(Complex(0.0, th))).real() == Approx(F(i)).margin(1e-6));
      CHECK((c.excitation.at(0, 1, 3 + i) * std::exp(Complex(0.0, th))).real() == Approx(expected(i)).margin(1e-6));
    }
  }
  // Energy of a motion does not depend on the point: velocities of Bo and of the reference in one rotation.
  Vector6 V, V_reference;
  V << 0.3, -0.2, 0.5, 0.1, -0.4, 0.2;
  V_reference = V;
  V_reference.head<3>() += V.tail<3>().cross(reference - origin);
  Matrix6 A = Matrix6::Zero();
  A(2, 2) = 8000.0, A(2, 4) = A(4, 2) = -4000.0, A(4, 4) = 96000.0;
  CHECK(V.dot(c.A_inf * V) == Approx(V_reference.dot(A * V_reference)).epsilon(1e-12));
}

TEST_CASE("broken WAMIT files are refused by line", "[wamit_file]") {
  struct Broken {
    std::string radiation, forces, restoring;
    std::string where, part;
  };
  const std::string A = kRadiation, X = excitation(), C = kRestoring;
  const std::vector<Broken> corpus = {
      {"", X, C, ".1:1", "holds no numbers"},
      {"a heading\nanother\n", X, C, ".1:2", "expected a number, got \"another\""},
      {std::string("1 2\0 3\n", 7), X, C, ".1:1", "not text"},
      {replaced(A, "0.110000E+01", "************"), X, C, ".1:13", "expected a number"},
      {replaced(A, "0.110000E+01", "NaN"), X, C, ".1:13", "expected a number"},
      {A.substr(0, A.size() - 3), X, C, ".1:20", "middle of a line"},    // 0.100000E+: no number
      {A.substr(0, A.size() - 2), X, C, ".1:20", "middle of a line"},    // 0.100000E+0: a digit short
      {A.substr(0, A.size() - 16), X, C, ".1:20", "middle of a line"},   // a column short
      {A.substr(0, A.size() - 15) + "\n", X, C, ".1:20", "5 columns, got 4: is the file cut off?"},
      {A.substr(0, A.rfind("  0.418879020479E+01")), X, C, ".1:19", "5,5 is missing at the period 4.18879 s"},
      {replaced(A, "     3     5 -0.250", "     3     3 -0.250"), X, C, ".1:6", "repeats line 5"},
      {replaced(A, "     3     5 -0.250", "     3     7 -0.250"), X, C, ".1", "holds 2 bodies, it is read for 1: say which with database_body = 1 to 2"},
      {replaced(A, "     3     5 -0.250", "     3   2.5 -0.250"), X, C, ".1:6", "mode from 1 to 6"},
      {A, "", C, ".3:1", "holds no numbers"},
      {A, replaced(X, "0.628318530718E+01", "0.0"), C, ".3:1", "no excitation at infinite frequency"},
      {A, replaced(X, "36.8698976458", "0.6435"), C, ".3:1", "not those of Re and Im"},
      {A, replaced(X, "  1.0  36.8698976458  0.8  0.6", "  1.0  36.8698976458  0.8  -0.6"), C, ".3:1",
       "not those of Re and Im"},
      {A, replaced(X, "  1.0  36.8698976458  0.8  0.6", "  1.0  36.8698976458"), C, ".3:1", "7 columns, got 5"},
      {A, replaced(X, "  0  3  ", "  0  1  "), C, ".3:3", "repeats line 1"},
      {A, X.substr(0, X.rfind("  0.628318530718E+01")), C, ".3:17", "mode 6 is missing"},
      {A, excitation({"0", "90", "270"}), C, ".3", "must lie between 0 and 180 deg, got 0 deg to 270 deg"},
      {A, replaced(X, "  0  2  0.0  0.0  0.0  0.0", "  0  2  0.3  0.0  0.3  0.0"), C, ".3", "must vanish"},
      {A, X, "     3     3\n", ".hst:1", "3 columns, got 2"},
      {A, X, "     4     4  0.5\n", ".hst:1", "heave is missing"},
      {A, X, replaced(C, " 0.120000E+02", "-0.120000E+02"), ".hst:1", "heave must be >= 0"},
  };
  for (const Broken& broken : corpus) {
    const Files files(broken.radiation, broken.forces, broken.restoring);
    INFO(broken.where << " " << broken.part);
    try {
      read_wamit(files.base, units(), frame());
      FAIL_CHECK("was accepted");
    } catch (const SpecificationError& error) {
      INFO(error.what());
      CHECK(error.entry == files.base + broken.where);
      CHECK(std::string(error.what()).find(broken.part) != std::string::npos);
    }
  }
}

TEST_CASE("what WAMIT files do not say must be given", "[wamit_file]") {
  const Files files;
  const auto message = [&](WamitUnits u, DatabaseFrame f) -> std::string {
    try {
      read_wamit(files.base, u, f);
    } catch (const SpecificationError& error) {
      return error.what();
    }
    return "accepted";
  };
  WamitUnits u = units();
  u.density = 0.0;
  CHECK_THAT(message(u, frame()), Catch::Contains("density, gravity and ULEN"));
  u = units();
  u.depth = 20.0;  // k h = 2 at 1 rad/s
  // k h = pi at w^2 = g pi tanh(pi) / h = 1.565, where waves cease to feel the bottom (Newman 1977, ch. 6): 1.251 rad/s
  CHECK_THAT(message(u, frame()), Catch::Contains("depth of 20 m") &&
                                      Catch::Contains("database_lowest_rad_per_s = 1.251"));
  DatabaseFrame f = frame();
  f.accept_finite_depth = true;
  CHECK(message(u, f) == "accepted");
  // In water as deep as the case's, within 5 %, it is what the case needs.
  f = frame();
  f.depth = 20.9;
  CHECK(message(u, f) == "accepted");
  CHECK(read_wamit(files.base, u, f).depth == 20.0);
  f.depth = 21.1;
  CHECK_THAT(message(u, f), Catch::Contains("depth of 20 m") && Catch::Contains("sea.depth_m = 21.1 m"));
  u.depth = 40.0;  // no wave of the file feels it
  CHECK(std::isinf(read_wamit(files.base, u, frame()).depth));
  u.depth = 20.0;
  f = frame();
  f.length = 0.0;
  CHECK_THAT(message(units(), f), Catch::Contains("length scale"));
  f = frame();
  f.bodies[0].volume = 0.0;
  CHECK_THAT(message(units(), f), Catch::Contains("displaced volume"));
  f = frame();
  f.port_starboard = false;
  f.axisymmetric = f.port_starboard = true;
  CHECK_THAT(message(units(), f), Catch::Contains("cannot stand together"));
  f = frame();
  f.lowest = 2.0;
  f.highest = 1.0;
  CHECK_THAT(message(units(), f), Catch::Contains("must be below the highest"));
  f = frame();
  f.port_starboard = false;
  f.bodies.push_back({Vector3::Zero(), 20.0});
  CHECK_THAT(message(units(), f), Catch::Contains("holds 1 body, it is read for 2"));
  std::filesystem::rename(files.base + ".3", files.base + ".2");
  CHECK(message(units(), frame()) == "accepted");  // Haskind's forces serve as well
  std::filesystem::remove(files.base + ".2");
  CHECK(read_wamit(files.base, units(), frame()).excitation.empty());  // calm water needs none
}

namespace {

/// Every row of `text` without the end of the last.
std::string without_last_break(const std::string& text) { return text.substr(0, text.size() - 1); }

}  // namespace

TEST_CASE("a last row without its line end is whole when nothing of it is missing", "[wamit_file]") {
  // As "\n".join(rows) writes a file.
  const Files files(without_last_break(kRadiation), without_last_break(excitation()), without_last_break(kRestoring));
  const Files ended;
  const HydrodynamicCoefficients a = read_wamit(files.base, units(), frame());
  const HydrodynamicCoefficients b = read_wamit(ended.base, units(), frame());
  CHECK(a.frequency.back().B(4, 4) == b.frequency.back().B(4, 4));
  CHECK(a.excitation.value == b.excitation.value);
  CHECK(a.waterplane == b.waterplane);
}

TEST_CASE("forces that symmetry makes zero may be rounding noise", "[wamit_file]") {
  // Mod, Pha, Re, Im of nothing contradict each other; so they do in files of real codes, at 1e-13 of 1.
  const std::string noisy = replaced(excitation(), "  0  2  0.0  0.0  0.0  0.0", "  0  2  3.4e-14  163.1  -1.2e-13  1.1e-14");
  const Files files(kRadiation, noisy);
  CHECK(std::abs(read_wamit(files.base, units(), frame()).excitation.at(0, 0, 1)) < 1e-8);
  // A contradiction that matters stays one: a thousandth of the largest.
  const std::string wrong = replaced(excitation(), "  0  2  0.0  0.0  0.0  0.0", "  0  2  1e-3  0.0  0.0  1e-3");
  const Files refused(kRadiation, wrong);
  CHECK_THROWS_WITH(read_wamit(refused.base, units(), frame()), Catch::Contains("not those of Re and Im"));
}

TEST_CASE("one hull and two travel through WAMIT files and back", "[wamit_file]") {
  const bool two = GENERATE(false, true);
  const bool by_frequency = GENERATE(false, true);
  const TemporaryFolder folder;
  HydrodynamicCoefficients c = two ? pair_set() : crane_set();
  WamitUnits u;
  u.ulen = 3.7;
  u.density = c.density;
  u.gravity = c.gravity;
  u.column = by_frequency ? WamitUnits::Column::frequency : WamitUnits::Column::period;
  DatabaseFrame f;
  f.length = c.length;
  f.bodies = {{Vector3(10.0, 4.0, -c.waterline), c.volume[0]}};
  u.reference = {Vector3(11.0, 4.5, 2.0)};
  if (two) {
    f.bodies.push_back({Vector3(-7.0, 60.0, -c.waterline), c.volume[1]});
    u.reference.push_back(Vector3(-7.5, 61.0, -1.0));
  }
  Matrix6 stiffness = Matrix6::Identity();
  std::vector<Matrix6> restoring;
  for (double area : c.waterplane) {
    stiffness(2, 2) = c.density * c.gravity * area;
    restoring.push_back(stiffness);
  }
  write_wamit(folder / "set", c, u, f, restoring);
  CHECK(folder.files() == 3);
  const HydrodynamicCoefficients back = read_wamit(folder / "set", u, f);
  // Nine digits, of numbers about a point where moments are larger by some per cent.
  CHECK(difference(c.A_inf, back.A_inf) < 1e-7);
  REQUIRE(back.frequency.size() == c.frequency.size());
  for (std::size_t n = 0; n < c.frequency.size(); ++n) {
    CHECK(back.frequency[n].frequency == Approx(c.frequency[n].frequency));
    CHECK(difference(c.frequency[n].A, back.frequency[n].A) < 1e-7);
    if (n > 0) CHECK(difference(c.frequency[n].B, back.frequency[n].B) < 1e-6);
  }
  CHECK(difference(c.excitation, back.excitation) < 1e-7);
  REQUIRE(back.waterplane.size() == c.waterplane.size());
  for (std::size_t n = 0; n < c.waterplane.size(); ++n) CHECK(back.waterplane[n] == Approx(c.waterplane[n]));
}

TEST_CASE("a dense WAMIT set passes every self-check, as its original does", "[wamit_file]") {
  const TemporaryFolder folder;
  HydrodynamicCoefficients c = crane_set();
  std::vector<double> frequencies;
  for (int n = 1; n <= 75; ++n) frequencies.push_back(0.04 * n);
  c.frequency = sampled(c, frequencies);
  WamitUnits u;
  u.density = c.density;
  u.gravity = c.gravity;
  DatabaseFrame f;
  f.length = c.length;
  f.bodies = {{Vector3::Zero(), c.volume[0]}};
  write_wamit(folder / "set", c, u, f);
  CHECK_NOTHROW(require_self_checks(read_wamit(folder / "set", u, f)));
  u.ulen = 2.0;  // another unit of length than it was written with
  CHECK_THROWS_AS(require_self_checks(read_wamit(folder / "set", u, f)), SpecificationError);
}

TEST_CASE("a set that WAMIT files cannot hold is refused", "[wamit_file]") {
  const TemporaryFolder folder;
  HydrodynamicCoefficients c = crane_set();
  WamitUnits u = units();
  DatabaseFrame f;
  f.length = c.length;
  CHECK_THROWS_WITH(write_wamit(folder / "set", pair_set(), u, f), Catch::Contains("every hull"));
  f.bodies[0].origin.z() = 1.0;
  CHECK_THROWS_WITH(write_wamit(folder / "set", c, u, f), Catch::Contains("water plane"));
  f.bodies[0].origin.z() = 0.0;
  c.frequency.clear();
  CHECK_THROWS_WITH(write_wamit(folder / "set", c, u, f), Catch::Contains("no table of A and B"));
  CHECK(folder.files() == 0);
}

}  // namespace stillhook
