// What an engineer writes down of a hull without a word on how its coefficients are computed is computed as it should be:
// the symmetry that a mesh has, frequencies as dense as the waves along the hull ask for, a band that the seas of the case
// reach, cells that grow to the size that is allowed, retardation functions that have the whole of a fit.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sim/hull/coefficients/sea_band.h"
#include "sim/hull/hydrostatics.h"
#include "sim/hull/radiation/causal_kernels.h"
#include "sim/hull/rankine/bands.h"
#include "sim/hull/rankine/frequencies.h"
#include "sim/hull/rankine/mesh_symmetry.h"
#include "sim/specification.h"
#include "tests/truth/sphere_mesh.h"

namespace stillhook {
namespace {

using namespace rankine;

/// A ship of quadrilaterals, cut into triangles by diagonals that are not each other's mirror images.
Mesh ship(double length, double breadth, double draft, double depth) {
  constexpr int kStations = 24, kLevels = 6;
  Mesh mesh;
  for (int i = 0; i <= kStations; ++i)
    for (int j = 0; j <= kLevels; ++j) {
      const double x = length * (i - 0.5 * kStations) / kStations;
      const double z = j < kLevels ? -draft * (1.0 - j / (kLevels - 1.0)) : depth - draft;
      const double section = z >= 0.0 ? 1.0 : 0.15 + 0.85 * (1.0 - std::pow(z / draft, 4));
      const double y = 0.5 * breadth * std::max(0.02, 1.0 - std::pow(std::abs(2.0 * x / length), 3)) * section;
      mesh.vertices.push_back({x, y, z});
      mesh.vertices.push_back({x, -y, z});
    }
  const auto at = [](int i, int j, int side) { return 2 * (i * (kLevels + 1) + j) + side; };
  const auto quad = [&](int a, int b, int c, int d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (int i = 0; i < kStations; ++i) {
    for (int j = 0; j < kLevels; ++j) {
      quad(at(i, j, 0), at(i, j + 1, 0), at(i + 1, j + 1, 0), at(i + 1, j, 0));
      quad(at(i + 1, j, 1), at(i + 1, j + 1, 1), at(i, j + 1, 1), at(i, j, 1));
    }
    quad(at(i, 0, 0), at(i + 1, 0, 0), at(i + 1, 0, 1), at(i, 0, 1));
    quad(at(i, kLevels, 0), at(i, kLevels, 1), at(i + 1, kLevels, 1), at(i + 1, kLevels, 0));
  }
  for (int j = 0; j < kLevels; ++j) {
    quad(at(0, j, 0), at(0, j, 1), at(0, j + 1, 1), at(0, j + 1, 0));
    quad(at(kStations, j, 0), at(kStations, j + 1, 0), at(kStations, j + 1, 1), at(kStations, j, 1));
  }
  return mesh;
}

PanelHull box_of(const Vector3& size, double draft) {
  PanelHull hull;
  hull.name = "barge";
  hull.box_size = size;
  hull.box_centre = {0.0, 0.0, 0.5 * size.z() - draft};
  hull.mesh = box_mesh(size, hull.box_centre, 8.0);
  return hull;
}

PanelMethodOptions automatic() {
  PanelMethodOptions options;
  options.highest = 0.0;
  options.frequencies = 0;
  return options;
}

void require_accepted(const Vector3& size, double draft) {
  HydrodynamicCoefficients c = panel_method({box_of(size, draft)}, automatic());
  c.retardation = causal_kernels(c);
  const std::vector<SelfCheck> checks = self_checks(c);
  CHECK(checks.size() == 13);  // none is left out for want of data
  for (const SelfCheck& check : checks) {
    INFO(size.transpose() << ", " << draft << " m: " << check.key << " " << check.value << " " << check.detail);
    CHECK(check.passed());
  }
}

}  // namespace

TEST_CASE("a hull's symmetry does not depend on how its sides are cut into triangles", "[ordinary_hulls]") {
  const Mesh whole = ship(120.0, 20.0, 6.0, 10.0);
  REQUIRE(properties_of(whole).volume > 0.0);
  const Mesh refined = refined_mesh(whole, 3.0);
  CHECK_FALSE(symmetry_of(refined, 0.012).y);  // vertex by vertex it is not symmetric
  CHECK(surface_symmetry(refined, 0.0).x);
  CHECK(surface_symmetry(refined, 0.0).y);

  // A sponson of 1.5 m along the aft part of one side, and a bow 4 m longer than the stern, are no such difference.
  Mesh sponson = refined;
  for (Vector3& v : sponson.vertices)
    if (v.y() > 4.0 && v.x() < 0.0) v.y() += 1.5;
  CHECK_FALSE(surface_symmetry(sponson, 0.0).y);
  CHECK_FALSE(surface_symmetry(sponson, 0.0).x);
  Mesh full = refined;
  for (Vector3& v : full.vertices)
    if (v.x() > 20.0) v.x() += 4.0;
  CHECK_FALSE(surface_symmetry(full, 0.0).x);
  CHECK(surface_symmetry(full, 0.0).y);
}

TEST_CASE("frequencies are as dense as the waves along the hull ask for", "[ordinary_hulls]") {
  const PanelMethodOptions options = automatic();
  for (const Vector3& size : {Vector3(30.0, 9.0, 6.0), Vector3(120.0, 25.0, 10.0), Vector3(250.0, 42.0, 20.0)}) {
    const Layout layout = place({box_of(size, 0.3 * size.z())});
    const std::vector<double> w = frequencies_of(layout, options);
    INFO(size.transpose() << ": " << w.size());
    CHECK(w.front() == options.lowest);
    CHECK(w.back() == Approx(highest_frequency(layout, options)));
    for (std::size_t i = 1; i < w.size(); ++i) {
      // 32 from 0.2 to 2 rad/s are 1.077 times the one before.
      CHECK(w[i] / w[i - 1] > 1.0);
      CHECK(w[i] / w[i - 1] < 1.078);
      // sin^2(k l/2), by which A and B swing along the hull, has a period of pi: three samples of it at least.
      const double phase = 0.5 * std::hypot(size.x(), size.y()) * (w[i] * w[i] - w[i - 1] * w[i - 1]) / options.gravity;
      CHECK(phase < std::numbers::pi / 3.0);
    }
  }
  // 30 m need no more than 32, and 120 m not many more.
  CHECK(frequencies_of(place({box_of({30.0, 9.0, 6.0}, 2.0)}), options).size() == 32);
  CHECK(frequencies_of(place({box_of({120.0, 25.0, 10.0}, 6.0)}), options).size() < 45);
  // What the case says is taken.
  PanelMethodOptions chosen = options;
  chosen.highest = 1.5;
  chosen.frequencies = 24;
  const std::vector<double> w = frequencies_of(place({box_of({250.0, 42.0, 20.0}, 6.0)}), chosen);
  CHECK(w.size() == 24);
  CHECK(w.back() == Approx(1.5));
  CHECK(w[1] / w[0] == Approx(w[23] / w[22]));
}

TEST_CASE("the band reaches the seas of the case, as far as the hull's size allows", "[ordinary_hulls]") {
  SeaSpec sea;
  CHECK(highest_of_seas(sea) == 2.0);
  SeaStateSpec state;
  state.type = SeaStateSpec::Type::jonswap;
  state.significant_height = 1.0;
  const auto with_period = [&](double period) {
    state.peak_period = period;
    sea.states = {state};
    return highest_of_seas(sea);
  };
  CHECK(with_period(9.0) == 2.0);
  CHECK(with_period(6.0) == 2.0);
  CHECK(with_period(5.0) == 2.5);
  CHECK(with_period(4.0) == 3.0);
  PanelMethodOptions options = automatic();
  options.sea_highest = 3.0;
  CHECK(highest_frequency(place({box_of({30.0, 12.0, 6.0}, 2.0)}), options) == 3.0);
  // The longest hulls: waves of an eighth of their diagonal, whatever the seas.
  const double long_hull = highest_frequency(place({box_of({250.0, 42.0, 20.0}, 8.0)}), options);
  const double wave = 2.0 * std::numbers::pi * options.gravity / (long_hull * long_hull);
  CHECK(wave == Approx(std::hypot(250.0, 42.0) * std::numbers::pi / kHighestPhase));
}

TEST_CASE("cells grow to the size that the waves allow, whatever the breadth of the hull", "[ordinary_hulls]") {
  // Doubling from a size at the hull of its own they stopped up to twice below it, with four times the cells.
  for (const double breadth : {9.0, 12.5, 16.0, 21.0, 34.0}) {
    const PanelHull hull = box_of({3.0 * breadth, breadth, 8.0}, 3.0);
    for (const PanelBand& band : bands_of(place({hull}), automatic())) {
      INFO(breadth << " m, " << band.to << " rad/s");
      const double doublings = std::log2(band.far / band.near);
      CHECK(doublings == Approx(std::round(doublings)).margin(1e-9));
      CHECK(doublings >= 1.0);
      // 12 cells in the breadth are asked for, up to 2^0.25 fewer are taken.
      CHECK(band.near <= breadth / 12.0 * 1.19);
    }
  }
}

TEST_CASE("retardation functions have the whole of a fit with a part that dies out at once", "[ordinary_hulls]") {
  // K(t) = a sum of two decays, one within 0.05 s: of it the samples at 0, 0.1, .. s see one value of the first. Truth:
  // its transform in closed form, K(i w) = sum r/(i w - p), with sum r/p = 0, as a hull's has.
  HydrodynamicCoefficients c;
  c.source = "closed form";
  c.density = 1025.0;
  c.gravity = 9.80665;
  c.length = 50.0;
  c.volume = {1000.0};
  c.A_inf = 1e6 * MatrixX::Identity(6, 6);
  const Complex p(-0.3, 0.8), fast(-20.0, 0.0), r(1.0, 1.3);
  const double r_fast = -20.0 * 2.0 * (r / -p).real();
  REQUIRE(2.0 * (r / p).real() + r_fast / fast.real() == Approx(0.0).margin(1e-12));
  const auto transfer = [&](double w) {
    const Complex s(0.0, w);
    return 1e5 * (r / (s - p) + std::conj(r) / (s - std::conj(p)) + r_fast / (s - fast));
  };
  double largest = 0.0;
  for (int i = 0; i < 40; ++i) {
    const double w = 0.2 + 0.05 * i;
    FrequencyCoefficients at{w, c.A_inf, MatrixX::Zero(6, 6)};
    at.A(2, 2) += transfer(w).imag() / w;
    at.B(2, 2) = transfer(w).real();
    largest = std::max(largest, at.B(2, 2));
    REQUIRE(at.B(2, 2) > 0.0);
    c.frequency.push_back(at);
  }
  const RetardationFunctions K = causal_kernels(c);
  for (const FrequencyCoefficients& at : c.frequency) {
    INFO(at.frequency);
    // The fit is asked for 2 %; with the samples as they are the integral is 11 % of the largest B off.
    CHECK(damping_from_kernels(K, 6, at.frequency)(2, 2) == Approx(at.B(2, 2)).margin(0.04 * largest));
  }
}

TEST_CASE("small square barges pass every self-check at the defaults", "[ordinary_hulls][slow]") {
  require_accepted({30.0, 30.0, 6.5}, 2.5);
  require_accepted({40.0, 40.0, 8.0}, 4.0);
}

TEST_CASE("a long barge passes every self-check at the defaults", "[ordinary_hulls][slow]") {
  require_accepted({120.0, 25.0, 10.0}, 6.0);
}

TEST_CASE("a longer barge passes every self-check at the defaults", "[ordinary_hulls][slow]") {
  require_accepted({140.0, 30.0, 10.5}, 6.5);
}

}  // namespace stillhook
