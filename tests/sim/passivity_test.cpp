#include "sim/hull/radiation/passivity.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "sim/hull/mesh/least_distance.h"

namespace stillhook {
namespace {

using Complex = std::complex<double>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// c s/(s^2 + 2 a s + b^2) as poles and residues; its real part at i w is c 2 a w^2/((b^2 - w^2)^2 + 4 a^2 w^2).
void add_resonance(PoleResidue& model, const MatrixX& c, double a, double b) {
  const Complex p(-a, std::sqrt(b * b - a * a));
  model.poles.push_back(p);
  model.residues.push_back(c * (p / (p - std::conj(p))));
}
double real_part(double a, double b, double w) {
  const double d = b * b - w * w;
  return 2.0 * a * w * w / (d * d + 4.0 * a * a * w * w);
}

MatrixX coupled(double x, double y, double z) {
  MatrixX c(2, 2);
  c << x, y, y, z;
  return c;
}

TEST_CASE("the weighted real part at all frequencies and both ends", "[passivity]") {
  const MatrixX c1 = coupled(1.0, 0.3, 0.5), c2 = coupled(0.2, -0.1, 2.0), c3 = coupled(0.4, 0.2, 0.7);
  PoleResidue model;
  add_resonance(model, c1, 0.3, 0.7);
  add_resonance(model, c2, 0.8, 1.9);
  // s/((s + d)(s + e)): two real poles. Its real part is (d + e) w^2/((d^2 + w^2)(e^2 + w^2)).
  const double d = 0.4, e = 2.5, w0 = 1.1;
  model.poles.insert(model.poles.end(), {-d, -e});
  model.residues.push_back(c3 * Complex(d / (d - e)));
  model.residues.push_back(c3 * Complex(-e / (d - e)));
  for (double w : {1e-9, 1e-3, 0.2, 1.0999, 1.1001, 3.0, 1e3, 1e9}) {
    const MatrixX exact = c1 * real_part(0.3, 0.7, w) + c2 * real_part(0.8, 1.9, w) +
                          c3 * ((d + e) * w * w / ((d * d + w * w) * (e * e + w * w)));
    const double weight = std::pow(w / w0 + w0 / w, 2);
    CHECK((weighted_real_part(model, w0, w) - weight * exact).norm() < 1e-12 * weight * exact.norm());
  }
  // w -> 0: Re/w^2 -> 2 a/b^4; w -> infinity: Re w^2 -> 2 a.
  const MatrixX at_rest =
      w0 * w0 * (c1 * (0.6 / std::pow(0.7, 4)) + c2 * (1.6 / std::pow(1.9, 4)) + c3 * ((d + e) / (d * d * e * e)));
  CHECK((weighted_real_part(model, w0, 0.0) - at_rest).norm() < 1e-13 * at_rest.norm());
  const MatrixX far_above = (c1 * 0.6 + c2 * 1.6 + c3 * (d + e)) / (w0 * w0);
  CHECK((weighted_real_part(model, w0, kInfinity) - far_above).norm() < 1e-13 * far_above.norm());
  const PassivityTest test = test_passivity(model, w0, 1e-6);
  CHECK(test.passive);
  CHECK(test.crossings.empty());
}

TEST_CASE("a violation narrower than any grid is found", "[passivity]") {
  // A broad resonance less a needle of width 1e-6 rad/s at b: negative where c 2 a/(4 a^2) > broad(b).
  const double a = 1e-6, b = 1.2345678, broad = real_part(0.5, 1.0, b);
  for (double share : {0.9, 1.1}) {
    PoleResidue model;
    add_resonance(model, MatrixX::Identity(1, 1), 0.5, 1.0);
    add_resonance(model, MatrixX::Constant(1, 1, -share * broad * 2.0 * a), a, b);
    const PassivityTest test = test_passivity(model, 1.0, 1e-9);
    INFO("needle of " << share);
    CHECK(test.passive == (share < 1.0));
    if (share < 1.0) continue;
    // share/(1 + (x/a)^2) = 1 at a distance x = a sqrt(share - 1) from b, to the order of a and of the floor.
    REQUIRE(test.crossings.size() == 2);
    CHECK(test.crossings[0] == Approx(b - a * std::sqrt(0.1)).margin(0.02 * a));
    CHECK(test.crossings[1] == Approx(b + a * std::sqrt(0.1)).margin(0.02 * a));
    CHECK(test.least < 0.0);
    CHECK(test.frequency == Approx(b).margin(0.5 * a));
  }
}

TEST_CASE("violations at rest, far above and off the diagonal are seen", "[passivity]") {
  // Re K of a pair (a, b) over w^2 is 2 a/b^4 at rest and 2 a/w^4 above: the slower pair rules below, the wider above.
  PoleResidue at_rest, above, across;
  add_resonance(at_rest, MatrixX::Identity(1, 1), 0.6, 1.5);
  add_resonance(at_rest, MatrixX::Constant(1, 1, -0.02), 0.3, 0.4);
  CHECK(real_part(0.6, 1.5, 1.0) > 0.02 * real_part(0.3, 0.4, 1.0));
  PassivityTest test = test_passivity(at_rest, 1.0, 1e-9);
  CHECK_FALSE(test.passive);
  CHECK(test.frequency < 0.1);
  add_resonance(above, MatrixX::Identity(1, 1), 0.2, 1.0);
  add_resonance(above, MatrixX::Constant(1, 1, -0.1), 2.5, 5.0);
  test = test_passivity(above, 1.0, 1e-9);
  CHECK_FALSE(test.passive);
  CHECK(test.frequency > 5.0);
  add_resonance(across, coupled(1.0, 1.01, 1.0), 0.4, 1.0);
  test = test_passivity(across, 1.0, 1e-9);
  CHECK_FALSE(test.passive);
  PoleResidue within;
  add_resonance(within, coupled(1.0, 0.99, 1.0), 0.4, 1.0);
  CHECK(test_passivity(within, 1.0, 1e-9).passive);
}

TEST_CASE("passive residues are the nearest ones", "[passivity]") {
  // One pair of poles and K(0) = 0 leave K = c s/(s^2 + 2 a s + b^2), whose real part has the sign of c: data with a
  // negative c are met best by the least c that the floor allows.
  const double a = 0.4, b = 1.0, w0 = 1.0, floor = 1e-4;
  const PoleBasis basis({Complex(-a, std::sqrt(b * b - a * a))});
  TransferSamples samples;
  samples.entries.resize(1);
  for (double w = 0.1; w < 3.0; w += 0.1) {
    samples.frequency.push_back(w);
    samples.weight.push_back(1.0);
    const Complex s(0.0, w);
    samples.entries[0].push_back(-0.2 * s / (s * s + 2.0 * a * s + b * b));
  }
  const PassiveResidues passive = fit_passive_residues(basis, samples, 1, w0, floor);
  CHECK(passive.test.passive);
  CHECK(passive.constrained);
  // P/c = 2 a (1 + w^2)^2/((1 - w^2)^2 + 4 a^2 w^2) is least at both ends, 2 a. The cuts ask for up to twice the floor.
  const double c = 2.0 * passive.model.residues[0](0, 0).real();
  CHECK(c >= floor / (2.0 * a) * (1.0 - 1e-9));
  CHECK(c <= 2.0 * floor / (2.0 * a) * (1.0 + 1e-9));
}

TEST_CASE("the nearest point under inequalities", "[passivity]") {
  // The positive orthant: the positive part.
  VectorX x0(4);
  x0 << -1.0, 2.0, -3.0, 0.5;
  LeastDistance orthant(x0);
  for (int i = 0; i < 4; ++i) orthant.add((1.0 + i) * VectorX::Unit(4, i), 0.0);
  REQUIRE(orthant.solve());
  CHECK((orthant.point() - x0.cwiseMax(0.0)).norm() < 1e-14);
  // Two half planes whose corner is nearest; then one more that moves the point along the first.
  LeastDistance corner((VectorX(2) << 0.0, 0.0).finished());
  corner.add((VectorX(2) << 1.0, 2.0).finished(), 5.0);
  REQUIRE(corner.solve());
  CHECK((corner.point() - Eigen::Vector2d(1.0, 2.0)).norm() < 1e-14);  // foot of the perpendicular
  corner.add((VectorX(2) << 1.0, 0.0).finished(), 3.0);
  REQUIRE(corner.solve());
  CHECK((corner.point() - Eigen::Vector2d(3.0, 1.0)).norm() < 1e-14);
  corner.add((VectorX(2) << 1.0, 0.0).finished(), 7.0);  // the first no longer binds
  REQUIRE(corner.solve());
  CHECK((corner.point() - Eigen::Vector2d(7.0, 0.0)).norm() < 1e-14);
  // Contradiction: x >= 1 and -x >= 1.
  LeastDistance none(VectorX::Zero(1));
  none.add(VectorX::Ones(1), 1.0);
  none.add(-VectorX::Ones(1), 1.0);
  CHECK_FALSE(none.solve());
}

}  // namespace
}  // namespace stillhook
