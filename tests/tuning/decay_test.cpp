// Decays read as p-q lines, against a decay integrated here.
#include "tuning/decay.h"

#include <array>
#include <catch2/catch.hpp>

#include "tests/tuning/measured_file.h"

namespace stillhook {
namespace {

/// I x'' + b x' + Q |x'| x' + C x = 0 by Runge-Kutta with a step of a thousandth of the period.
struct Oscillation {
  double I, b, Q, C, amplitude;

  std::vector<double> sampled(double duration, double interval) const {
    std::vector<double> out;
    double x = amplitude, v = 0.0;
    const int sub = 50;
    const double h = interval / sub;
    const auto a = [&](double p, double u) { return -(b * u + Q * std::abs(u) * u + C * p) / I; };
    for (int i = 0; i * interval <= duration + 1e-9; ++i) {
      out.push_back(x);
      for (int k = 0; k < sub; ++k) {
        const double k1x = v, k1v = a(x, v);
        const double k2x = v + 0.5 * h * k1v, k2v = a(x + 0.5 * h * k1x, v + 0.5 * h * k1v);
        const double k3x = v + 0.5 * h * k2v, k3v = a(x + 0.5 * h * k2x, v + 0.5 * h * k2v);
        const double k4x = v + h * k3v, k4v = a(x + h * k3x, v + h * k3v);
        x += h / 6.0 * (k1x + 2.0 * k2x + 2.0 * k3x + k4x);
        v += h / 6.0 * (k1v + 2.0 * k2v + 2.0 * k3v + k4v);
      }
    }
    return out;
  }
};

std::vector<double> times(std::size_t n, double interval) {
  std::vector<double> t;
  for (std::size_t i = 0; i < n; ++i) t.push_back(interval * static_cast<double>(i));
  return t;
}

TEST_CASE("linear and quadratic damping come back from the p-q line", "[decay]") {
  const Oscillation truth{2.0e6, 6.0e4, 1.5e6, 2.0e6, 0.15};
  const std::vector<double> x = truth.sampled(80.0, 0.1);
  const DecayLine line = analyse_decay(times(x.size(), 0.1), x);
  REQUIRE(line.usable());
  CHECK(line.period == Approx(2.0 * 3.14159265 * std::sqrt(truth.I / truth.C)).epsilon(0.002));
  // The line is of first order in the damping: its error is of the order of the decrement, here at most 15 % of it over
  // a cycle, squared; three per cent covers it.
  CHECK(line.linear(truth.I) == Approx(truth.b).epsilon(0.03));
  CHECK(line.quadratic(truth.I) == Approx(truth.Q).epsilon(0.03));
}

TEST_CASE("an offset and noise do not bend the line much", "[decay]") {
  const Oscillation truth{2.0e6, 6.0e4, 1.5e6, 2.0e6, 0.15};
  std::vector<double> x = truth.sampled(60.0, 0.1);
  Noise noise(3);
  for (double& v : x) v += 0.02 + 0.001 * noise();
  const DecayLine line = analyse_decay(times(x.size(), 0.1), x);
  REQUIRE(line.usable());
  CHECK(line.centre == Approx(0.02).margin(0.002));
  CHECK(line.linear(truth.I) == Approx(truth.b).epsilon(0.3));  // a start value, no estimate
  CHECK(line.quadratic(truth.I) == Approx(truth.Q).epsilon(0.3));
}

TEST_CASE("what is no decay says why", "[decay]") {
  CHECK_FALSE(analyse_decay({0.0, 1.0}, {1.0, 0.5}).usable());
  std::vector<double> creep;
  for (int i = 0; i < 100; ++i) creep.push_back(std::exp(-0.05 * i));
  CHECK(analyse_decay(times(100, 0.1), creep).message == "there are fewer than four turns");
}

}  // namespace
}  // namespace stillhook
