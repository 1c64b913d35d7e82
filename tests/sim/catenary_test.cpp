#include "sim/lifting/catenary.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

#include "tests/truth/line_integration.h"
#include "tests/truth/moorpy_catenary.h"

using namespace stillhook;

namespace {

const std::vector<CatenaryLine> kLines = {
    {500.0, 800.0, 7.51e12, 5.0, true},  // inextensible chain
    {220.0, 900.0, 2.0e8, 0.0, true},    // chain and wire
    {220.0, 900.0, 2.0e7, 0.6, true},    // springy, with friction
    {150.0, 40.0, 4.0e6, 1.0, true},     // nearly weightless rope
    {300.0, 500.0, 1.0e9, 0.0, false},   // hanging free
};

}  // namespace

TEST_CASE("the catenary gives MoorPy's loads") {
  for (const truth::CatenaryRow& row : truth::kMoorPyCatenaries) {
    const CatenaryLine line{row.length, row.weight, row.axial_stiffness, row.friction, row.on_seabed};
    const CatenaryLoad load = solve_catenary(line, row.x, row.z);
    // Their solver stops at 1e-6 m, which is about 1e-7 of these loads.
    CHECK(load.H == Approx(row.H).epsilon(1e-6));
    CHECK(load.V == Approx(row.V).epsilon(1e-6));
    CHECK(load.grounded_length == Approx(row.grounded).epsilon(1e-6));
  }
}

TEST_CASE("the catenary is the equilibrium of every element of the line") {
  for (const CatenaryLine& line : kLines) {
    for (const double stretch : {0.87, 0.93, 0.98, 1.003}) {
      const double z = 0.31 * line.length;
      // On the seabed a line is slack below x = L - z; start a little above.
      const double slack = line.on_seabed ? line.length - z : 0.2 * line.length;
      const double straight = std::sqrt(line.length * line.length - z * z);
      const double x = slack + (straight - slack) * (stretch - 0.8) / 0.2;
      const CatenaryLoad load = solve_catenary(line, x, z);
      CAPTURE(line.length, line.axial_stiffness, line.on_seabed, x, z, load.H, load.V);
      const auto at = [&](int n) {
        return truth::integrate_line(load.H, load.V, line.length, line.weight, line.axial_stiffness,
                                     line.seabed_friction, line.on_seabed, n);
      };
      // Midpoint errors fall as 1/n^2: extrapolated, what is left is below 1e-8 of the length.
      const truth::IntegratedLine coarse = at(20000), fine = at(40000);
      CHECK((4.0 * fine.x - coarse.x) / 3.0 == Approx(x).margin(1e-8 * line.length).epsilon(0.0));
      CHECK((4.0 * fine.z - coarse.z) / 3.0 == Approx(z).margin(1e-8 * line.length).epsilon(0.0));
      if (line.seabed_friction == 0.0) {
        const double energy = (4.0 * fine.energy - coarse.energy) / 3.0;
        CHECK(catenary_energy(line, load, x, z) == Approx(energy).epsilon(1e-7));
      }
    }
  }
}

TEST_CASE("the stiffness of the catenary is the derivative of its load") {
  for (const CatenaryLine& line : kLines) {
    const double z = 0.27 * line.length;
    for (const double share : {0.78, 0.9, 0.94, 0.962, 0.975}) {
      const double x = share * line.length, d = 1e-5 * line.length;
      const CatenaryLoad load = solve_catenary(line, x, z);
      const auto slope = [&](double step, int axis) -> Eigen::Vector2d {
        const CatenaryLoad a = solve_catenary(line, x + (axis ? 0.0 : step), z + (axis ? step : 0.0));
        const CatenaryLoad b = solve_catenary(line, x - (axis ? 0.0 : step), z - (axis ? step : 0.0));
        return Eigen::Vector2d(a.H - b.H, a.V - b.V) / (2.0 * step);
      };
      for (const int axis : {0, 1}) {
        const Eigen::Vector2d differenced = (4.0 * slope(0.5 * d, axis) - slope(d, axis)) / 3.0;
        CAPTURE(line.length, line.axial_stiffness, share, axis, load.H);
        // Position known to 1e-12 L, divided by steps of 1e-5 L: 1e-7.
        CHECK((load.stiffness.col(axis) - differenced).norm() <= 2e-6 * load.stiffness.norm());
      }
      if (line.seabed_friction == 0.0)
        CHECK(load.stiffness(0, 1) == Approx(load.stiffness(1, 0)).epsilon(1e-9).margin(1e-9 * load.stiffness.norm()));
    }
  }
}

TEST_CASE("a slack line carries the weight it lifts and no horizontal load") {
  const CatenaryLine line = kLines[2];
  const double z = 60.0;
  const CatenaryLoad load = solve_catenary(line, 100.0, z);
  CHECK(load.H == 0.0);
  const double hanging = line.length - load.grounded_length;
  CHECK(load.V == Approx(line.weight * hanging));
  CHECK(hanging + 0.5 * line.weight * hanging * hanging / line.axial_stiffness == Approx(z));
  CHECK(load.stiffness(0, 0) == 0.0);

  // It comes taut without a jump: from the edge of slack on H grows from nothing and V goes on.
  const double edge = line.length - hanging;
  const CatenaryLoad beyond = solve_catenary(line, edge + 1e-6, z);
  CHECK(beyond.H > 0.0);
  CHECK(beyond.H < 1e-3 * line.weight);  // (edge + 1e-6) is within 1e-6 w of H/w (1 + log 2V/H)
  CHECK(beyond.V == Approx(load.V).epsilon(1e-6));
}

TEST_CASE("load and stiffness are continuous where the line leaves the bottom") {
  const CatenaryLine line = kLines[1];
  const double z = 40.0, weight = line.weight * line.length;
  double low = 0.9 * line.length, high = line.length;
  for (int i = 0; i < 100; ++i) {  // x at which V = w L
    const double middle = 0.5 * (low + high);
    (solve_catenary(line, middle, z).V < weight ? low : high) = middle;
  }
  const CatenaryLoad before = solve_catenary(line, low - 1e-7, z), after = solve_catenary(line, high + 1e-7, z);
  CHECK(before.grounded_length > 0.0);
  CHECK(after.grounded_length == 0.0);
  CHECK(after.H == Approx(before.H).epsilon(1e-5));
  CHECK((after.stiffness - before.stiffness).norm() < 1e-5 * before.stiffness.norm());
}

TEST_CASE("the catenary is found from anywhere, with or without a guess, and H grows with x") {
  for (const CatenaryLine& line : kLines) {
    for (const double height : {1e-7, 1e-3, 0.05, 0.3, 0.7, 0.99, 1.02}) {
      if (!line.on_seabed && height < 1e-4) continue;
      double before = 0.0;
      for (double share = 0.002; share < 1.1; share += 0.0137) {
        const double x = share * line.length, z = height * line.length;
        const CatenaryLoad load = solve_catenary(line, x, z);
        CAPTURE(line.length, line.axial_stiffness, share, height, load.H, load.V);
        REQUIRE(std::isfinite(load.H));
        REQUIRE(load.stiffness.allFinite());
        CHECK(load.H >= before);
        before = load.H;
        if (load.H == 0.0 || !line.on_seabed) continue;
        // Solving back by bisection alone. Rounding of x grows with the straightness of the line, H/(w L).
        CHECK(catenary_distance(line, load.H, z) ==
              Approx(x).margin(1e-9 * line.length * (1.0 + load.H / line.axial_stiffness)).epsilon(0.0));
        const CatenaryLoad warm = solve_catenary(line, x, z, 3.0 * load.H, 0.4 * load.V);
        CHECK(warm.H == Approx(load.H).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("a buoyant line is in equilibrium too: it goes up from its anchor and ends above the straight way") {
  const CatenaryLine line{220.0, -350.0, 2.0e7};
  for (const double x : {60.0, 140.0, 205.0}) {
    const double z = 70.0;
    const CatenaryLoad load = solve_catenary(line, x, z);
    CAPTURE(x, load.H, load.V);
    CHECK(load.H > 0.0);
    const auto at = [&](int n) {
      return truth::integrate_line(load.H, load.V, line.length, line.weight, line.axial_stiffness, 0.0, false, n);
    };
    const truth::IntegratedLine coarse = at(20000), fine = at(40000);
    CHECK((4.0 * fine.x - coarse.x) / 3.0 == Approx(x).margin(1e-8 * line.length).epsilon(0.0));
    CHECK((4.0 * fine.z - coarse.z) / 3.0 == Approx(z).margin(1e-8 * line.length).epsilon(0.0));
    CHECK(catenary_energy(line, load, x, z) == Approx((4.0 * fine.energy - coarse.energy) / 3.0).epsilon(1e-7));
    // The stiffness is the derivative of the load, and symmetric.
    const double d = 1e-4;
    const auto slope = [&](double dx, double dz) -> Eigen::Vector2d {
      const CatenaryLoad a = solve_catenary(line, x + dx, z + dz), b = solve_catenary(line, x - dx, z - dz);
      return Eigen::Vector2d((a.H - b.H) / (2.0 * d), (a.V - b.V) / (2.0 * d));
    };
    CHECK((load.stiffness.col(0) - slope(d, 0.0)).norm() < 1e-5 * load.stiffness.norm());
    CHECK((load.stiffness.col(1) - slope(0.0, d)).norm() < 1e-5 * load.stiffness.norm());
    CHECK(load.stiffness(0, 1) == Approx(load.stiffness(1, 0)).epsilon(1e-9).margin(1e-9 * load.stiffness.norm()));
  }
  // Upside down MoorPy's line is a buoyant one: anchor and fairlead change places.
  const truth::CatenaryRow& row = truth::kMoorPyCatenaries[4];
  const CatenaryLine buoyant{row.length, -row.weight, row.axial_stiffness};
  const CatenaryLoad load = solve_catenary(buoyant, row.x, -row.z);
  CHECK(load.H == Approx(row.H).epsilon(1e-6));
  CHECK(-load.V == Approx(row.V).epsilon(1e-6));
}

TEST_CASE("how far a line hangs below its anchor, or rises above its fairlead") {
  // Level ends, an inextensible line: the sag of a catenary with H, a (cosh(x/2a) - 1) with a = H/w.
  const CatenaryLine line{110.0, 500.0, 1e12, 0.0, false};
  const CatenaryLoad load = solve_catenary(line, 100.0, 0.0);
  const double a = load.H / 500.0, sag = a * (std::cosh(50.0 / a) - 1.0);
  CHECK(sag > 15.0);
  CHECK(catenary_overhang(line, load) == Approx(sag).epsilon(1e-6));
  CatenaryLine buoyant = line;
  buoyant.weight = -500.0;
  CHECK(catenary_overhang(buoyant, solve_catenary(buoyant, 100.0, 0.0)) == Approx(sag).epsilon(1e-6));
  // A line that climbs all the way has none; the seabed carries one that lies on it.
  CHECK(catenary_overhang(line, solve_catenary(line, 60.0, 91.0)) == 0.0);
  CHECK(catenary_overhang({220.0, 900.0, 2e8}, solve_catenary({220.0, 900.0, 2e8}, 195.0, 40.0)) == 0.0);
}
