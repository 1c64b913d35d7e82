#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "sim/hull/coefficients/coefficient_file.h"
#include "sim/specification.h"
#include "tests/sim/coefficient_sets.h"
#include "tests/sim/temporary_folder.h"

namespace stillhook {
namespace {

constexpr double kPrinted = 1e-8;  // nine digits

void require_same(const HydrodynamicCoefficients& a, const HydrodynamicCoefficients& b) {
  CHECK(a.volume == b.volume);
  CHECK(a.waterplane == b.waterplane);
  CHECK(a.waterline == b.waterline);
  CHECK(a.density == b.density);
  CHECK(a.gravity == b.gravity);
  CHECK(a.length == b.length);
  CHECK(difference(a.A_inf, b.A_inf) < kPrinted);
  REQUIRE(a.frequency.size() == b.frequency.size());
  for (std::size_t f = 0; f < a.frequency.size(); ++f) {
    CHECK(a.frequency[f].frequency == Approx(b.frequency[f].frequency).epsilon(kPrinted));
    CHECK(difference(a.frequency[f].A, b.frequency[f].A) < kPrinted);
    CHECK(difference(a.frequency[f].B, b.frequency[f].B) < kPrinted);
  }
  CHECK(b.retardation.interval == Approx(a.retardation.interval).epsilon(kPrinted));
  for (double w : {0.3, 0.7}) {
    const MatrixX B = damping_from_kernels(a.retardation, a.modes(), w);
    CHECK(difference(B, damping_from_kernels(b.retardation, b.modes(), w)) < 1e-6);  // sums of 400 rounded numbers
  }
  CHECK(difference(a.excitation, b.excitation) < kPrinted);
}

}  // namespace

TEST_CASE("a coefficient file is written as it is read", "[coefficient_writer]") {
  const TemporaryFolder folder;
  HydrodynamicCoefficients c = crane_set();
  c.waterline = 0.123456;
  c.description = "one, two,\nthree";
  c.depth = 20.5;
  write_coefficient_file(folder / "hull.csv", c);
  CHECK(folder.files() == 1);  // nothing temporary is left
  const HydrodynamicCoefficients back = read_coefficient_file(folder / "hull.csv");
  CHECK(back.depth == 20.5);
  CHECK(back.description == "one, two, three");  // on one line
  require_same(c, back);
  CHECK(back.retardation.kernels.size() == c.retardation.kernels.size());
}

TEST_CASE("two hulls' coefficients travel too", "[coefficient_writer]") {
  const TemporaryFolder folder;
  const HydrodynamicCoefficients c = pair_set();
  write_coefficient_file(folder / "pair.csv", c);
  require_same(c, read_coefficient_file(folder / "pair.csv"));
  CHECK(
      std::isinf(read_coefficient_file(folder / "pair.csv").depth));  // a file that says no depth is one of deep water
}

TEST_CASE("what the format cannot say is refused before anything is written", "[coefficient_writer]") {
  const TemporaryFolder folder;
  HydrodynamicCoefficients c = crane_set();
  std::string part;
  SECTION("no retardation functions") {
    c.retardation = {};
    part = "no retardation functions";
  }
  SECTION("a number that is none") {
    c.frequency[2].A(1, 1) = std::nan("");
    part = "A holds a number that is not finite";
  }
  SECTION("an infinite force") {
    c.excitation.value[7] = std::numeric_limits<double>::infinity();
    part = "X holds a number that is not finite";
  }
  SECTION("damping that gives energy") {
    c.frequency[2].B(3, 3) *= -1.0;
    part = "B44 at 0.571 rad/s is negative";
  }
  CHECK_THROWS_WITH(write_coefficient_file(folder / "hull.csv", c),
                    Catch::Contains(part) && Catch::Contains("hull.csv"));
  CHECK(folder.files() == 0);
}

TEST_CASE("a folder that is not there is named", "[coefficient_writer]") {
  CHECK_THROWS_WITH(write_coefficient_file("/nowhere/hull.csv", crane_set()),
                    Catch::Contains("/nowhere/hull.csv: cannot be written: No such file"));
}

TEST_CASE("damping that is negative by rounding travels as it is", "[coefficient_writer]") {
  const TemporaryFolder folder;
  HydrodynamicCoefficients c = crane_set();
  c.frequency[1].B(5, 5) = -1e-5 * c.frequency[6].B(5, 5);
  write_coefficient_file(folder / "hull.csv", c);
  CHECK(read_coefficient_file(folder / "hull.csv").frequency[1].B(5, 5) == Approx(c.frequency[1].B(5, 5)));
}

}  // namespace stillhook
