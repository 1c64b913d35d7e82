// What is read of WAMIT files: headings, frequencies, bodies, the meaning of the first column.
#include "sim/hull/coefficients/wamit_file.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <tuple>

#include "sim/sea/dispersion.h"
#include "sim/specification.h"
#include "tests/sim/coefficient_sets.h"
#include "tests/sim/wamit_sample.h"

namespace stillhook {

using namespace wamit_sample;

TEST_CASE("a first column of frequencies has its own codes", "[wamit_file]") {
  std::string text = kRadiation;
  for (const auto& [period, frequency] : {std::pair<std::string, std::string>{" -0.100000E+01 ", " zero "},
                                          {"  0.000000E+00     ", "  -1.0     "},
                                          {"0.125663706144E+02", "0.5"},
                                          {"0.628318530718E+01", "1.0"},
                                          {"0.418879020479E+01", "1.5"}})
    for (std::size_t at = text.find(period); at != std::string::npos; at = text.find(period))
      text.replace(at, period.size(), frequency);
  for (std::size_t at = text.find("zero"); at != std::string::npos; at = text.find("zero")) text.replace(at, 4, "0.0");
  std::string forces = excitation();
  for (std::size_t at = forces.find("0.628318530718E+01"); at != std::string::npos;
       at = forces.find("0.628318530718E+01"))
    forces.replace(at, 18, "1.0");
  const Files by_frequency(text, forces), by_period;
  WamitUnits u = units();
  u.column = WamitUnits::Column::frequency;
  const HydrodynamicCoefficients a = read_wamit(by_frequency.base, u, frame());
  const HydrodynamicCoefficients b = read_wamit(by_period.base, units(), frame());
  CHECK(difference(a.A_inf, b.A_inf) < 1e-9);
  REQUIRE(a.frequency.size() == b.frequency.size());
  for (std::size_t f = 0; f < a.frequency.size(); ++f) {
    CHECK(a.frequency[f].frequency == Approx(b.frequency[f].frequency));
    CHECK(difference(a.frequency[f].A, b.frequency[f].A) < 1e-9);
  }
  CHECK(difference(a.excitation, b.excitation) < 1e-9);
}

TEST_CASE("headings that come twice at the ends of the circle count once", "[wamit_file]") {
  DatabaseFrame f = frame();
  f.port_starboard = false;
  const Files whole(kRadiation, excitation({"-180", "-90", "0", "90", "180"}));
  CHECK(read_wamit(whole.base, units(), f).excitation.headings.size() == 4);
  const std::string other = replaced(excitation({"-180", "-90", "0", "90", "180"}),
                                     "-180  1  1.0  36.8698976458  0.8  0.6", "-180  1  2.0  36.8698976458  1.6  1.2");
  const Files unequal(kRadiation, other);
  CHECK_THROWS_WITH(read_wamit(unequal.base, units(), f), Catch::Contains("180 deg is given twice"));
}

TEST_CASE("a file of one heading serves calm water and waves from there", "[wamit_file]") {
  DatabaseFrame f = frame();
  const Files head(kRadiation, excitation({"180"}));
  CHECK(read_wamit(head.base, units(), f).excitation.headings.size() == 1);
  f.port_starboard = false;
  const Files uneven(kRadiation, excitation({"0", "60", "90", "180"}));
  const ExcitationTable X = read_wamit(uneven.base, units(), f).excitation;
  REQUIRE(X.headings.size() == 4);
  CHECK(X.headings[1] == Approx(std::numbers::pi / 3.0));  // as it stands in the file
}

TEST_CASE("endings of WAMIT files may be in capitals", "[wamit_file]") {
  const Files files;
  std::filesystem::rename(files.base + ".hst", files.base + ".HST");
  REQUIRE(read_wamit(files.base, units(), frame()).waterplane.size() == 1);
}

TEST_CASE("what lies outside the wanted band is left out", "[wamit_file]") {
  const Files files;
  DatabaseFrame f = frame();
  f.lowest = 0.2;
  f.highest = 1.6;
  const HydrodynamicCoefficients c = read_wamit(files.base, units(), f);
  REQUIRE(c.frequency.size() == 3);  // of 0, 0.5, 1, 1.5
  CHECK(c.frequency[0].frequency == Approx(0.5));
  CHECK(c.A_inf(2, 2) == Approx(8000.0));
  f.highest = 1.2;
  CHECK_THROWS_WITH(read_wamit(files.base, units(), f), Catch::Contains("fewer than three frequencies"));
}

TEST_CASE("one body of several is read when it is named", "[wamit_file]") {
  const TemporaryFolder folder;
  const HydrodynamicCoefficients c = pair_set();
  WamitUnits u;
  u.density = c.density;
  u.gravity = c.gravity;
  DatabaseFrame f;
  f.length = c.length;
  f.bodies = {{Vector3(10.0, 4.0, -c.waterline), c.volume[0]}, {Vector3(-7.0, 60.0, -c.waterline), c.volume[1]}};
  std::vector<Matrix6> restoring(2, Matrix6::Identity());
  for (std::size_t n = 0; n < 2; ++n) restoring[n](2, 2) = c.density * c.gravity * c.waterplane[n];
  write_wamit(folder / "set", c, u, f, restoring);
  const int chosen = GENERATE(1, 2);
  const auto at = static_cast<Eigen::Index>(6 * (chosen - 1));
  DatabaseFrame one = f;
  one.bodies = {f.bodies[static_cast<std::size_t>(chosen - 1)]};
  CHECK_THROWS_WITH(read_wamit(folder / "set", u, one), Catch::Contains("database_body = 1 to 2"));
  one.chosen = chosen;
  const HydrodynamicCoefficients back = read_wamit(folder / "set", u, one);
  CHECK(back.hulls() == 1);
  CHECK(difference(c.A_inf.block(at, at, 6, 6), back.A_inf) < 1e-7);  // nine digits
  CHECK(back.waterplane[0] == Approx(c.waterplane[static_cast<std::size_t>(chosen - 1)]));
  for (int h = 0; h < static_cast<int>(c.excitation.headings.size()); ++h)
    CHECK(std::abs(back.excitation.at(2, h, 2) - c.excitation.at(2, h, static_cast<int>(at) + 2)) <
          1e-6 * std::abs(c.excitation.at(2, h, static_cast<int>(at) + 2)));
  REQUIRE(back.remarks.size() == 1);
  CHECK_THAT(back.remarks[0], Catch::Contains("body " + std::to_string(chosen) + " of 2"));
  one.chosen = 3;
  CHECK_THROWS_WITH(read_wamit(folder / "set", u, one), Catch::Contains("no database_body = 3"));
}

TEST_CASE("one heading of a body of revolution stands for all", "[wamit_file]") {
  // Surge 2 - i, heave 0.7 i, pitch 3 + 2 i along the waves, of a body at p: the truth at any heading is the turned
  // force with the phase of the wave at p, which is where WAMIT's moments are about too.
  const Vector3 p(4.0, -2.5, 0.0);
  const double w = 1.0, k = w * w / 10.0;
  const auto truth = [&](double b) {
    const Complex along(2.0, -1.0), heave(0.0, 0.7), pitch(3.0, 2.0);
    Eigen::Matrix<Complex, 6, 1> x;
    x << along * std::cos(b), along * std::sin(b), heave, -pitch * std::sin(b), pitch * std::cos(b), 0.0;
    return (x * std::polar(1.0, -k * (p.x() * std::cos(b) + p.y() * std::sin(b)))).eval();
  };
  const auto rows = [&](double degrees) {
    std::ostringstream text;
    text.precision(12);
    const auto x = truth(degrees * std::numbers::pi / 180.0);
    for (int i = 0; i < 6; ++i)
      text << "6.28318530718 " << degrees << ' ' << i + 1 << ' ' << std::abs(x(i)) << ' '
           << std::arg(x(i)) * 180.0 / std::numbers::pi << ' ' << x(i).real() << ' ' << x(i).imag() << '\n';
    return text.str();
  };
  std::ostringstream radiation;  // A_15 = -A_24
  for (const char* period : {"0.0", "12.5663706144", "8.37758040957", "6.28318530718"})  // three with damping are needed
    for (const auto& [i, j, a, b] : std::vector<std::tuple<int, int, double, double>>{{1, 1, 2.0, 0.1},
                                                                                      {2, 2, 2.0, 0.1},
                                                                                      {3, 3, 1.0, 0.3},
                                                                                      {4, 4, 5.0, 0.2},
                                                                                      {5, 5, 5.0, 0.2},
                                                                                      {1, 5, 0.5, 0.01},
                                                                                      {5, 1, 0.5, 0.01},
                                                                                      {2, 4, -0.5, -0.01},
                                                                                      {4, 2, -0.5, -0.01},
                                                                                      {6, 6, 0.0, 0.0}})
      radiation << period << ' ' << i << ' ' << j << ' ' << a << ' ' << b << '\n';
  WamitUnits u = units();
  u.ulen = 1.0;
  u.reference = {p};
  DatabaseFrame f = frame();
  f.port_starboard = false;
  f.axisymmetric = true;
  f.bodies[0].origin = p;
  const Files files(radiation.str(), rows(30.0), "");
  const HydrodynamicCoefficients c = read_wamit(files.base, u, f);
  REQUIRE(c.excitation.headings.size() >= 12);
  for (int h = 0; h < static_cast<int>(c.excitation.headings.size()); ++h) {
    const double b = c.excitation.headings[static_cast<std::size_t>(h)];
    const Complex at_p = std::polar(1.0, k * (p.x() * std::cos(b) + p.y() * std::sin(b)));
    for (int i = 0; i < 6; ++i)  // here the phase is a lag at Bo, which lies at p
      CHECK(std::abs(c.excitation.at(0, h, i) - 10000.0 * std::conj(truth(b)(i) * at_p)) < 1e-6);
  }
  // No body of revolution: surge and sway differ, or waves push it aside.
  const Files oblong(replaced(radiation.str(), "0.0 2 2 2", "0.0 2 2 3"), rows(30.0), "");
  CHECK_THROWS_WITH(read_wamit(oblong.base, u, f), Catch::Contains("body of revolution") && Catch::Contains("33.3 %"));
  const Files aside(radiation.str(), replaced(rows(0.0), "0 2 ", "0 2 1 0 1 0\n# "), "");
  const Files pushed(radiation.str(), excitation({"90"}), "");
  u.reference = {Vector3::Zero()};
  CHECK_THROWS_WITH(read_wamit(pushed.base, u, f), Catch::Contains("across their own direction"));
}

TEST_CASE("wave numbers solve the dispersion relation", "[wamit_file]") {
  for (double w : {0.05, 0.3, 1.0, 2.5})
    for (double h : {2.0, 20.0, 300.0}) {
      const double k = wave_number(w, 9.81, h);
      CHECK(9.81 * k * std::tanh(k * h) == Approx(w * w).epsilon(1e-10));
    }
  CHECK(wave_number(0.7, 9.81, std::numeric_limits<double>::infinity()) == Approx(0.49 / 9.81));
}

}  // namespace stillhook
