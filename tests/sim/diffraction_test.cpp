#include "sim/hull/diffraction.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sim/hull/coefficients/coefficient_file.h"
#include "sim/hull/linear_froude_krylov.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

constexpr double kDensity = 1025.0, kGravity = 9.80665, kDegree = std::numbers::pi / 180.0;
using Vector6c = Eigen::Matrix<Complex, 6, 1>;

/// Froude-Krylov force on a box |x| < a, |y| < b, low < z < water plane, in closed form: every face is a product of
/// one-dimensional integrals. Moments about the point at height `origin` above the water plane.
Vector6c box_truth(double a, double b, double draft, double origin, double frequency, double heading) {
  const double k = frequency * frequency / kGravity, p = k * std::cos(heading), q = k * std::sin(heading);
  const Complex i(0.0, 1.0);
  // int exp(i s u) du and int u exp(i s u) du over |u| < h
  const auto even = [](double s, double h) { return std::abs(s * h) < 1e-6 ? 2.0 * h : 2.0 * std::sin(s * h) / s; };
  const auto odd = [i](double s, double h) {
    return std::abs(s * h) < 1e-4 ? i * (2.0 / 3.0) * s * h * h * h
                                  : i * 2.0 * (std::sin(s * h) - s * h * std::cos(s * h)) / (s * s);
  };
  // int exp(k z) dz and int z exp(k z) dz over -draft < z < 0
  const double e = std::exp(-k * draft), Z0 = (1.0 - e) / k, Z1 = draft * e / k - (1.0 - e) / (k * k);
  const double Z1_from_origin = Z1 - origin * Z0;
  const Complex ends = -2.0 * i * std::sin(p * a), sides = -2.0 * i * std::sin(q * b);  // -(e^{ipa} - e^{-ipa})
  Vector6c X;
  X(0) = ends * even(q, b) * Z0;
  X(1) = sides * even(p, a) * Z0;
  X(2) = e * even(p, a) * even(q, b);
  X(3) = e * even(p, a) * odd(q, b) - sides * even(p, a) * Z1_from_origin;
  X(4) = -e * odd(p, a) * even(q, b) + ends * even(q, b) * Z1_from_origin;
  X(5) = sides * odd(p, a) * Z0 - ends * odd(q, b) * Z0;
  return kDensity * kGravity * X;
}

HydrodynamicCoefficients crane() {
  return read_coefficient_file(STILLHOOK_SOURCE_DIR "/problems/hulls/crane_110x46x4.csv");
}

/// The crane hull with its deck, Bo in the water plane.
Mesh crane_mesh(double panel) { return box_mesh(Vector3(110.0, 46.0, 7.5), Vector3(0.0, 0.0, -0.25), panel); }

WaveComponent component(double amplitude, double frequency, double heading, double phase) {
  return {amplitude, frequency, frequency * frequency / kGravity, std::cos(heading), std::sin(heading), phase};
}

}  // namespace

TEST_CASE("linear Froude-Krylov force on a box against the closed form", "[diffraction]") {
  for (double panel : {2.0, 25.0}) {
    // Bo 1.5 m below the water plane, so that the waterline and the moments' reference are exercised.
    const Mesh mesh = box_mesh(Vector3(60.0, 22.0, 7.0), Vector3(0.0, 0.0, 0.0), panel);
    const LinearFroudeKrylov fk(mesh, 1.5, kDensity, kGravity);
    CHECK(fk.volume() == Approx(60.0 * 22.0 * 5.0).epsilon(1e-12));
    for (double w : {0.3, 0.8, 1.7})
      for (double heading : {0.0, 0.7, 90.0 * kDegree, 2.6, -1.1}) {
        const Vector6c X = fk.excitation(w, heading), truth = box_truth(30.0, 11.0, 5.0, -1.5, w, heading);
        for (int i = 0; i < 6; ++i) {
          // Relative to one face in phase; the quadrature leaves 1e-5 of that.
          const double scale = kDensity * kGravity * (i < 2 ? 5.0 * 60.0 : 60.0 * 22.0) * (i < 3 ? 1.0 : 20.0);
          INFO("w " << w << " heading " << heading << " mode " << i + 1);
          CHECK(std::abs(X(i) - truth(i)) < 2e-6 * scale);
        }
      }
  }
}

TEST_CASE("the sea pushes towards where it runs to", "[diffraction]") {
  const LinearFroudeKrylov fk(crane_mesh(5.0), 0.0, kDensity, kGravity);
  // Before the crest arrives the water stands higher on the side it comes from: force ahead, a quarter period before
  // the crest, is a lag of -90 degrees. Waves towards +y press the starboard side: roll+ (port side up) is negative
  // while the slope makes port low, i.e. the wave's own slope rolls the hull: its crest at starboard lifts starboard.
  CHECK(std::arg(fk.excitation(0.3, 0.0)(0)) == Approx(-90.0 * kDegree).epsilon(1e-6));
  CHECK(std::arg(fk.excitation(0.3, 90.0 * kDegree)(1)) == Approx(-90.0 * kDegree).epsilon(1e-6));
  CHECK(std::arg(fk.excitation(0.3, 180.0 * kDegree)(0)) == Approx(90.0 * kDegree).epsilon(1e-6));
  CHECK(std::arg(fk.excitation(0.3, 90.0 * kDegree)(3)) == Approx(90.0 * kDegree).epsilon(1e-6));
  CHECK(std::abs(std::arg(fk.excitation(0.3, 0.7)(2))) < 1e-6);
}

TEST_CASE("excitation of the crane hull in long waves is Froude-Krylov plus relative motion", "[diffraction]") {
  // At 0.4 rad/s (385 m) the hull feels the mean motion of the water over it: X_D = -(w^2 A + i w B) zeta_mean, here
  // for the heave force in beam seas. A wrong sign of the phase, a mirrored axis or a wrong Froude-Krylov part is off
  // by 100 %; the estimate itself is good to some 5 %.
  const HydrodynamicCoefficients c = crane();
  const LinearFroudeKrylov fk(crane_mesh(4.0), c.waterline, c.density, c.gravity);
  const double w = 0.4, k = w * w / c.gravity;
  const FrequencyCoefficients& f = c.frequency[1];
  REQUIRE(f.frequency == w);
  const Complex X = c.excitation.at(0, 2, 2), incident = fk.excitation(w, 90.0 * kDegree)(2);
  const double mean = std::exp(-k * 4.0) * std::sin(k * 23.0) / (k * 23.0);
  const Complex estimate = incident - (w * w * f.A(2, 2) + Complex(0.0, w * f.B(2, 2))) * mean;
  CHECK(std::abs(X - estimate) < 0.05 * std::abs(X));
  // Surge and sway: within 20 % of Froude-Krylov, the rest is the added mass in the water's acceleration.
  for (int mode : {0, 1}) {
    const Complex total = c.excitation.at(0, mode == 0 ? 0 : 2, mode);
    const Complex own = fk.excitation(w, mode * 90.0 * kDegree)(mode);
    CHECK(std::abs(total - own) < 0.2 * std::abs(total));
  }
}

TEST_CASE("the diffraction table returns its entries and their mirror images", "[diffraction]") {
  const HydrodynamicCoefficients c = crane();
  const LinearFroudeKrylov fk(crane_mesh(6.0), c.waterline, c.density, c.gravity);
  const double heading = 0.4;
  const DiffractionTable table(c.excitation, {&fk, 1}, {&heading, 1}, 110.0);
  CHECK(table.highest_frequency() == 1.2);
  for (int f = 0; f < 6; ++f)
    for (int h = 0; h < 8; ++h) {
      const double w = c.excitation.frequencies[f], b = c.excitation.headings[h];
      const Eigen::VectorXcd X_D = table.at(w, b), turned = table.at(w, b - 4.0 * std::numbers::pi);
      const Vector6c incident = fk.excitation(w, b);
      for (int i = 0; i < 6; ++i) {
        const double scale = 1e-13 * incident.norm();  // rounding; turning by 4 pi costs another digit or two
        CHECK(std::abs(X_D(i) + incident(i) - c.excitation.at(f, h, i)) < scale);
        CHECK(std::abs(X_D(i) - turned(i)) < 100.0 * scale);
      }
      // Between entries too, a sea from the other side is the mirror image.
      const Eigen::VectorXcd one = table.at(0.95 * w, 0.3), other = table.at(0.95 * w, -0.3);
      for (int i = 0; i < 6; ++i)
        CHECK(std::abs(one(i) - (i % 2 ? -1.0 : 1.0) * other(i)) < 1e-9 * (1.0 + std::abs(incident.norm())));
    }
  CHECK(table.at(0.0, 1.0).norm() == 0.0);
  // Vanishes with w^2 towards long waves.
  CHECK(table.at(0.02, 1.0).norm() / table.at(0.01, 1.0).norm() == Approx(4.0).epsilon(0.05));
}

TEST_CASE("interpolation between table entries converges", "[diffraction]") {
  // A made-up diffraction force that turns in phase as that of a hull 110 m long does: w^2 exp(i k 40 cos b).
  const LinearFroudeKrylov fk(crane_mesh(12.0), 0.0, kDensity, kGravity);
  const double heading = 0.0;
  const auto truth = [](double w, double b) {
    return 1e7 * w * w * std::exp(Complex(0.0, w * w / kGravity * 40.0 * std::cos(b)));
  };
  double error[2];
  for (int level = 0; level < 2; ++level) {
    ExcitationTable X;
    const int refine = level + 1;
    for (int f = 0; f <= 8 * refine; ++f) X.frequencies.push_back(0.4 + 0.1 * f / refine);
    for (int h = 0; h < 24; ++h) X.headings.push_back(15.0 * kDegree * h);
    X.value.resize(X.frequencies.size() * X.headings.size() * 6);
    for (std::size_t f = 0; f < X.frequencies.size(); ++f)
      for (std::size_t h = 0; h < X.headings.size(); ++h)
        X.at(f, h, 2) = truth(X.frequencies[f], X.headings[h]) + fk.excitation(X.frequencies[f], X.headings[h])(2);
    const DiffractionTable table(X, {&fk, 1}, {&heading, 1}, 110.0);
    error[level] = 0.0;
    for (double w : {0.43, 0.57, 0.75, 0.97, 1.13})
      for (double b = 0.1; b < 6.0; b += 0.5) {
        REQUIRE(table.resolves(w, b));
        error[level] = std::max(error[level], std::abs(table.at(w, b)(2) - truth(w, b)) / std::abs(truth(w, b)));
      }
  }
  INFO(error[0] << " " << error[1]);
  CHECK(error[1] < 0.02);
  CHECK(error[0] / error[1] > 6.0);  // third order in frequency where slopes are one-sided, fourth elsewhere
}

TEST_CASE("headings between entries are used only for waves long enough", "[diffraction]") {
  const HydrodynamicCoefficients c = crane();
  const LinearFroudeKrylov fk(crane_mesh(8.0), c.waterline, c.density, c.gravity);
  const double psi = 0.2;
  const DiffractionTable table(c.excitation, {&fk, 1}, {&psi, 1}, c.length);
  CHECK(table.resolves(0.628, 0.5));
  CHECK(table.resolves(1.2, -135.0 * kDegree));
  CHECK(table.resolves(0.05, 0.5));
  CHECK_FALSE(table.resolves(1.0, 0.5));
  CHECK_FALSE(table.resolves(1.21, 0.0));
  const auto waves = std::make_shared<const WaveField>(std::vector<WaveComponent>{component(1.0, 1.0, 0.5, 0.0)}, 10.0);
  CHECK_THROWS_WITH(Diffraction(waves, table, {&psi, 1}, 0.01, "bodies.crane"),
                    Catch::Contains("between the headings"));
}

TEST_CASE("headings that do not go round serve waves from there alone", "[diffraction]") {
  HydrodynamicCoefficients c = crane();
  const LinearFroudeKrylov fk(crane_mesh(8.0), c.waterline, c.density, c.gravity);
  const double psi = 0.2, head = c.excitation.headings[4];  // 180 deg
  ExcitationTable one{c.excitation.frequencies, {head}, 6, {}};
  for (int f = 0; f < static_cast<int>(one.frequencies.size()); ++f)
    for (int i = 0; i < 6; ++i) one.value.push_back(c.excitation.at(f, 4, i));
  const DiffractionTable table(one, {&fk, 1}, {&psi, 1}, c.length), all(c.excitation, {&fk, 1}, {&psi, 1}, c.length);
  CHECK_FALSE(table.all_around());
  CHECK(table.resolves(0.628, head));
  CHECK(table.resolves(0.628, head - 2.0 * std::numbers::pi + 0.4 * kDegree));
  CHECK_FALSE(table.resolves(0.628, head + 1.0 * kDegree));
  CHECK_FALSE(table.resolves(0.628, 0.0));
  // The same numbers as in the table that goes round, at an entry of both: rounding.
  CHECK((table.at(0.6, head) - all.at(0.6, head)).norm() < 1e-12 * all.at(0.6, head).norm());
  const auto beam = std::make_shared<const WaveField>(std::vector<WaveComponent>{component(1.0, 0.6, 1.5, 0.0)}, 10.0);
  CHECK_THROWS_WITH(Diffraction(beam, table, {&psi, 1}, 0.01, "bodies.crane"),
                    Catch::Contains("towards 180 deg of the hull alone") && Catch::Contains("axisymmetric = true"));
  const auto along =
      std::make_shared<const WaveField>(std::vector<WaveComponent>{component(1.0, 0.6, psi + head, 0.0)}, 10.0);
  CHECK_NOTHROW(Diffraction(along, table, {&psi, 1}, 0.01, "bodies.crane"));
}

TEST_CASE("diffraction force at the hull's position", "[diffraction]") {
  const HydrodynamicCoefficients c = crane();
  const LinearFroudeKrylov fk(crane_mesh(5.0), c.waterline, c.density, c.gravity);
  const double psi = 0.6;
  const DiffractionTable table(c.excitation, {&fk, 1}, {&psi, 1}, 110.0);
  const double w = 0.628, beta = psi + 45.0 * kDegree, a = 0.7, phase = 1.1;
  const auto waves = std::make_shared<const WaveField>(
      std::vector<WaveComponent>{component(a, w, beta, phase), component(0.2, 0.7, 2.5, -0.4)}, 30.0);
  const Diffraction diffraction(waves, table, {&psi, 1}, 0.01, "bodies.crane");
  const double x = 12.0, y = -31.0;
  for (double t : {12.0, 47.3}) {
    Vector6 F, expected = Vector6::Zero();
    Eigen::Matrix<double, 6, 2> dF;
    diffraction.evaluate(0, t, x, y, F, dF);
    for (const WaveComponent& wave : waves->components()) {
      const double b = std::atan2(wave.sin_heading, wave.cos_heading);
      const double angle = wave.wavenumber * (x * std::cos(b) + y * std::sin(b)) - wave.frequency * t + wave.phase;
      const Eigen::VectorXcd X = table.at(wave.frequency, b - psi);
      expected += waves->ramp(t) * wave.amplitude * (X * std::polar(1.0, angle)).real();
    }
    CHECK((F - expected).norm() < 1e-10 * expected.norm());
    CHECK(expected.norm() > 1e6);
    for (int axis = 0; axis < 2; ++axis) {
      const double h = 1e-3;
      Vector6 up, down;
      Eigen::Matrix<double, 6, 2> unused;
      diffraction.evaluate(0, t, x + (axis == 0) * h, y + (axis == 1) * h, up, unused);
      diffraction.evaluate(0, t, x - (axis == 0) * h, y - (axis == 1) * h, down, unused);
      CHECK(((up - down) / (2.0 * h) - dF.col(axis)).norm() < 1e-7 * dF.norm());  // rounding at this h
    }
  }
}

TEST_CASE("a sea with energy above the table is refused with its share", "[diffraction]") {
  const HydrodynamicCoefficients c = crane();
  const LinearFroudeKrylov fk(crane_mesh(8.0), c.waterline, c.density, c.gravity);
  const double psi = 0.0;
  const DiffractionTable table(c.excitation, {&fk, 1}, {&psi, 1}, 110.0);
  const auto sea = [](double above) {
    return std::make_shared<const WaveField>(
        std::vector<WaveComponent>{component(1.0, 0.7, 0.0, 0.0), component(above, 1.5, 0.0, 0.0)}, 10.0);
  };
  CHECK_NOTHROW(Diffraction(sea(0.09), table, {&psi, 1}, 0.01, "bodies.crane"));
  try {
    Diffraction(sea(0.5), table, {&psi, 1}, 0.01, "bodies.crane");
    FAIL_CHECK("was accepted");
  } catch (const SpecificationError& error) {
    CHECK(error.entry == "bodies.crane");
    CHECK(std::string(error.what()).find("20 % of the sea's energy lies above 1.2 rad/s") != std::string::npos);
  }
}

}  // namespace stillhook
