// Intervals of linear fits, whose truth is known in closed form.
#include "tuning/uncertainty.h"

#include <catch2/catch.hpp>

#include "tests/tuning/measured_file.h"
#include "tuning/identifiability.h"

namespace stillhook {
namespace {

using Catch::Matchers::Contains;

/// The fit of a mean and a slope to first-order autoregressive noise.
ResidualSeries line_fit(int n, double rho, unsigned seed, VectorX* estimate = nullptr) {
  Noise noise(seed);
  ResidualSeries s;
  s.J.resize(n, 2);
  VectorX y(n);
  double e = noise() / std::sqrt(1.0 - rho * rho);
  for (int i = 0; i < n; ++i) {
    s.sample.push_back(i);
    s.J.row(i) << 1.0, 2.0 * i / n - 1.0;
    y[i] = e;
    e = rho * e + noise();
  }
  const VectorX b = (s.J.transpose() * s.J).ldlt().solve(s.J.transpose() * y);
  if (estimate) *estimate = b;
  s.r = s.J * b - y;
  return s;
}

const MatrixX kNoPrior = MatrixX::Zero(2, 2);
const std::vector<bool> kFree = {false, false};
constexpr double kSquares = 1e6;  // a threshold that leaves every residual squared

TEST_CASE("white residuals give the textbook's interval", "[uncertainty]") {
  const ResidualSeries s = line_fit(4000, 0.0, 1);
  const Uncertainty u = uncertainty_of({s}, kNoPrior, kSquares, kFree);
  const MatrixX textbook = s.r.squaredNorm() / 4000.0 * (s.J.transpose() * s.J).inverse();
  CHECK(u.white(0, 0) == Approx(textbook(0, 0)));
  CHECK(u.covariance(1, 1) == Approx(textbook(1, 1)).epsilon(0.15));  // autocorrelation within its noise
  CHECK(u.correlation()(0, 1) == Approx(0.0).margin(0.05));
}

TEST_CASE("coloured residuals widen it by their autocorrelation", "[uncertainty]") {
  const double rho = 0.9;
  // For a mean of autoregressive noise the variance is (1 + rho)/(1 - rho) = 19 times that of white noise.
  double ratio = 0.0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Uncertainty u = uncertainty_of({line_fit(4000, rho, seed)}, kNoPrior, kSquares, kFree);
    ratio += u.covariance(0, 0) / u.white(0, 0) / 10.0;
  }
  // Bartlett's taper takes some of the tail away.
  CHECK(ratio > 0.7 * 19.0);
  CHECK(ratio < 1.2 * 19.0);
}

TEST_CASE("the scatter of estimates is what the intervals say", "[uncertainty]") {
  for (const double rho : {0.0, 0.8}) {
    double square = 0.0, said = 0.0;
    const int runs = 200;
    for (unsigned seed = 1; seed <= runs; ++seed) {
      VectorX b;
      const ResidualSeries s = line_fit(1000, rho, seed, &b);
      square += b[1] * b[1] / runs;
      said += uncertainty_of({s}, kNoPrior, 2.5, kFree).covariance(1, 1) / runs;
    }
    // 200 runs know a variance within 10 %, twice that at 95 %; the taper lowers the second by some per cent more.
    CHECK(said / square == Approx(1.0).margin(0.3));
  }
}

TEST_CASE("an unknown that is held leaves the others their own interval", "[uncertainty]") {
  const ResidualSeries s = line_fit(500, 0.0, 4);
  const Uncertainty u = uncertainty_of({s}, kNoPrior, kSquares, {false, true});
  CHECK(u.covariance(1, 1) == 0.0);
  CHECK(u.white(0, 0) == Approx(s.r.squaredNorm() / 500.0 / 500.0));
}

TEST_CASE("what the data leave open is named, a prior closes it", "[uncertainty]") {
  ResidualSeries s = line_fit(500, 0.0, 5);
  s.J.col(1) = 3.0 * s.J.col(0);
  const Uncertainty u = uncertainty_of({s}, kNoPrior, kSquares, kFree);
  REQUIRE(u.open.size() == 1);
  CHECK(u.unknown[0]);
  CHECK(u.unknown[1]);
  MatrixX prior = kNoPrior;
  prior(1, 1) = 100.0;
  const Uncertainty with = uncertainty_of({s}, prior, kSquares, kFree);
  CHECK(with.open.empty());
  CHECK(with.sd()[1] == Approx(0.1).epsilon(0.05));
  s.J.col(1).setZero();
  CHECK(uncertainty_of({s}, kNoPrior, kSquares, kFree).unknown[1]);
}

TEST_CASE("a test that would separate two parameters is named", "[identifiability]") {
  const std::vector<std::string> keys = {"bodies.ship.hydrodynamics.added_mass_t.2", "moorings.m.stiffness_kN_per_m",
                                         "bodies.ship.hydrodynamics.linear_damping_kN_s_per_m.2"};
  MatrixX correlation = MatrixX::Identity(3, 3);
  correlation(0, 1) = correlation(1, 0) = -0.995;
  const std::vector<Inseparable> pairs = inseparable_pairs(keys, correlation);
  REQUIRE(pairs.size() == 1);
  CHECK_THAT(pairs[0].test, Contains("static pull"));
  CHECK_THAT(separating_test("bodies.s.hydrodynamics.linear_angular_damping_kN_m_s_per_rad.0",
                             "bodies.s.hydrodynamics.quadratic_angular_damping_kN_m_s2_per_rad2.0"),
             Contains("amplitude"));
  CHECK_THAT(separating_test("sea.states.a.amplitude_m", "bodies.s.hydrodynamics.radiation_factor"),
             Contains("sea.elevation"));
}

}  // namespace
}  // namespace stillhook
