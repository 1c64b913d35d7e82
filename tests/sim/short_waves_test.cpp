// Waves shorter than those of the coefficients: the limit of short waves, and the seas it lets in.
#include <catch2/catch.hpp>
#include <cmath>

#include "sim/hull/coefficients/coefficient_file.h"
#include "sim/hull/coefficients/sea_band.h"
#include "sim/hull/diffraction.h"
#include "sim/hull/rankine/panel_method.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr double kDensity = 1025.0, kGravity = 9.80665;
using Vector6c = Eigen::Matrix<Complex, 6, 1>;

/// Half length, half breadth and draft of a box with Bo in the water plane.
constexpr double kA = 20.0, kB = 8.0, kT = 4.0;
Mesh box() { return box_mesh(Vector3(2.0 * kA, 2.0 * kB, 2.0 * kT), Vector3::Zero(), 4.0); }

WaveField jonswap(double period) {
  SeaStateSpec state;
  state.type = SeaStateSpec::Type::jonswap;
  state.significant_height = 1.0;
  state.peak_period = period;
  return build_wave_field(state, kGravity, 0.0);
}

}  // namespace

TEST_CASE("in the limit of short waves a box feels the wave on its weather side alone, twice", "[short_waves]") {
  const LinearFroudeKrylov hull(box(), 0.0, kDensity, kGravity);
  for (const double w : {2.0, 3.0})
    for (const double heading : {0.0, 0.5 * std::numbers::pi, std::numbers::pi}) {
      const double k = w * w / kGravity;
      // Waves run towards +x, +y or -x: the face they meet lies at -a, -b or +a along that direction.
      const bool along_x = std::abs(std::sin(heading)) < 0.5;
      const double half = along_x ? kA : kB, width = along_x ? 2.0 * kB : 2.0 * kA;
      // int rho g exp(k z) dz over the draft times the width; the crest meets the face half a hull before Bo.
      const double face = kDensity * kGravity * width * (1.0 - std::exp(-k * kT)) / k;
      const Complex truth = 2.0 * face * std::exp(Complex(0.0, -k * half));
      const Vector6c X = hull.excitation(w, heading) + hull.short_wave_diffraction(w, heading);
      const int mode = along_x ? 0 : 1;
      const double sign = heading > 3.0 ? -1.0 : 1.0;
      INFO("w = " << w << ", heading " << heading);
      // The rule of integration leaves 4e-4 of each piece.
      CHECK(std::abs(sign * X(mode) - truth) < 2e-3 * std::abs(truth));
      // Nothing across, and the flat bottom is in no light.
      CHECK(std::abs(X(1 - mode)) < 1e-6 * std::abs(truth));
      CHECK(std::abs(hull.short_wave_diffraction(w, heading)(2)) < 1e-6 * std::abs(truth));
    }
}

TEST_CASE("the limit of short waves against the panel method above the band", "[short_waves][slow]") {
  PanelHull hull;
  hull.name = "box";
  hull.box_size = {2.0 * kA, 2.0 * kB, 2.0 * kT};
  hull.mesh = box();
  PanelMethodOptions options;
  options.headings = 48;
  options.chosen = {1.6, 1.8, 2.0, 2.3, 2.6, 3.0};
  const HydrodynamicCoefficients all = panel_method({hull}, options);
  // The same table as if its band ended at 2 rad/s.
  ExcitationTable cut = all.excitation;
  const auto kept = static_cast<std::size_t>(
      std::upper_bound(cut.frequencies.begin(), cut.frequencies.end(), 2.0 + 1e-9) - cut.frequencies.begin());
  cut.frequencies.resize(kept);
  cut.value.resize(kept * cut.headings.size() * 6);
  const LinearFroudeKrylov incident(hull.mesh, 0.0, kDensity, kGravity);
  const double psi = 0.0;
  const DiffractionTable table(cut, {&incident, 1}, {&psi, 1}, all.length);
  double with = 0.0, without = 0.0, size = 0.0;
  for (std::size_t f = kept; f < all.excitation.frequencies.size(); ++f)
    for (std::size_t h = 0; h < all.excitation.headings.size(); ++h) {
      const double w = all.excitation.frequencies[f], heading = all.excitation.headings[h];
      const Vector6c X_D = table.at(w, heading), FK = incident.excitation(w, heading);
      for (int i = 0; i < 6; ++i) {
        const Complex X = all.excitation.at(static_cast<int>(f), static_cast<int>(h), i);
        const double scale = i < 3 ? 1.0 : 1.0 / kA;  // moments as forces at the hull's end
        with += std::norm(scale * (FK(i) + X_D(i) - X));
        without += std::norm(scale * (FK(i) - X));
        size += std::norm(scale * X);
      }
    }
  INFO("rms error over rms X: " << std::sqrt(with / size) << ", without diffraction " << std::sqrt(without / size));
  // Waves of 7 to 15 m at a box of 40 x 16 m: geometric optics leaves what its edges and its draft do, about a fifth;
  // without diffraction nearly half of the force is missing, since the weather side doubles it.
  CHECK(std::sqrt(with / size) < 0.3);
  CHECK(with < 0.4 * without);
}

TEST_CASE("above its table diffraction goes on from the last entry", "[short_waves]") {
  const HydrodynamicCoefficients c = read_coefficient_file(STILLHOOK_SOURCE_DIR "/problems/hulls/crane_110x46x4.csv");
  const LinearFroudeKrylov hull(box_mesh(Vector3(110.0, 46.0, 7.5), Vector3(0.0, 0.0, -0.25), 8.0), c.waterline,
                                c.density, c.gravity);
  const double psi = 0.0, end = c.excitation.frequencies.back();
  const DiffractionTable table(c.excitation, {&hull, 1}, {&psi, 1}, 110.0);
  const Eigen::VectorXcd last = table.at(end, 0.0), next = table.at(end * 1.0001, 0.0);
  // A step of 1e-4 in frequency turns the phase by 2e-4 k L/2 = 2e-3.
  CHECK((next - last).norm() < 5e-3 * last.norm());
  const Vector6c limit = hull.short_wave_diffraction(3.0, 0.0);
  // (1.2/3)^4 = 2.6 % is left of what the table differs by.
  CHECK((table.at(3.0, 0.0) - limit).norm() < 0.03 * (last - hull.short_wave_diffraction(end, 0.0)).norm() + 1e-9);
}

TEST_CASE("working seas are diffracted beyond the band instead of refused", "[short_waves]") {
  const HydrodynamicCoefficients c = read_coefficient_file(STILLHOOK_SOURCE_DIR "/problems/hulls/crane_110x46x4.csv");
  const LinearFroudeKrylov hull(box_mesh(Vector3(110.0, 46.0, 7.5), Vector3(0.0, 0.0, -0.25), 8.0), c.waterline,
                                c.density, c.gravity);
  const double psi = 0.0;
  const DiffractionTable table(c.excitation, {&hull, 1}, {&psi, 1}, 110.0);
  const auto sea = std::make_shared<const WaveField>(jonswap(7.0));
  const Diffraction limit(sea, table, {&psi, 1}, 0.01, "bodies.crane", ShortWaves::limit);
  CHECK(limit.share_left_out() == 0.0);
  CHECK(limit.share_in_limit() > 0.05);  // the table ends at 1.2 rad/s, the sea's peak is at 0.9
  try {
    Diffraction(sea, table, {&psi, 1}, 0.01, "bodies.crane");
    FAIL_CHECK("was accepted");
  } catch (const SpecificationError& error) {
    CHECK_THAT(error.what(), Catch::Contains("panel_method.beyond") && Catch::Contains("highest_rad_per_s"));
  }
}

TEST_CASE("a sea that panels would not resolve is refused before they are computed", "[short_waves]") {
  BodySpec body;
  body.name = "barge";
  body.hydrodynamics.kind = HydrodynamicsSpec::Kind::panels;
  const Mesh mesh = box();
  HullAfloat hull{&body, &mesh, 0.0, 0.0, 0.0, 0.1};
  const WaveField sea = jonswap(7.0);
  SeaSpec water;
  water.gravity = kGravity;
  PanelMethodSpec method;
  CHECK_NOTHROW(require_resolved_sea({&hull, 1}, sea, water, method, 0.01));
  method.beyond = PanelMethodSpec::Beyond::refuse;
  CHECK_THROWS_WITH(require_resolved_sea({&hull, 1}, sea, water, method, 0.01),
                    Catch::Contains("above 2 rad/s") && Catch::Contains("panel_method.beyond"));
  method.beyond = PanelMethodSpec::Beyond::limit;
  method.headings = 4;
  CHECK_THROWS_WITH(require_resolved_sea({&hull, 1}, sea, water, method, 0.01),
                    Catch::Contains("between the headings") && Catch::Contains("panel_method.headings"));
  method.beyond = PanelMethodSpec::Beyond::cut;
  CHECK_NOTHROW(require_resolved_sea({&hull, 1}, sea, water, method, 0.01));
}

}  // namespace stillhook
