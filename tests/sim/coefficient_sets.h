// Coefficient sets for tests, and how two of them are compared.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>

#include "sim/hull/coefficients/coefficient_file.h"

namespace stillhook {

inline HydrodynamicCoefficients crane_set() {
  HydrodynamicCoefficients c = read_coefficient_file(STILLHOOK_SOURCE_DIR "/problems/hulls/crane_110x46x4.csv");
  c.waterplane = {110.0 * 46.0};
  return c;
}

/// Largest difference, of sqrt(X_ii X_jj) of the first.
inline double difference(const MatrixX& a, const MatrixX& b) {
  double worst = 0.0;
  for (int i = 0; i < a.rows(); ++i)
    for (int j = 0; j < a.cols(); ++j) {
      const double scale = std::sqrt(std::abs(a(i, i) * a(j, j)));
      const double d = std::abs(a(i, j) - b(i, j));
      if (d > 0.0) worst = std::max(worst, scale > 0.0 ? d / scale : 1.0);
    }
  return worst;
}

/// Largest difference, of the largest of each mode. The tables must have the same frequencies, headings and modes.
inline double difference(const ExcitationTable& a, const ExcitationTable& b) {
  REQUIRE(a.modes == b.modes);
  REQUIRE(a.value.size() == b.value.size());
  for (std::size_t f = 0; f < a.frequencies.size(); ++f)
    CHECK(a.frequencies[f] == Approx(b.frequencies[f]).epsilon(1e-8));
  for (std::size_t h = 0; h < a.headings.size(); ++h) CHECK(std::abs(a.headings[h] - b.headings[h]) < 1e-7);
  VectorX largest = VectorX::Zero(a.modes);
  for (std::size_t n = 0; n < a.value.size(); ++n)
    largest(static_cast<int>(n) % a.modes) = std::max(largest(static_cast<int>(n) % a.modes), std::abs(a.value[n]));
  double worst = 0.0;
  for (std::size_t n = 0; n < a.value.size(); ++n)
    worst = std::max(worst, std::abs(a.value[n] - b.value[n]) / largest(static_cast<int>(n) % a.modes));
  return worst;
}

/// Two hulls, made up from the crane hull about general points: symmetric, every block filled.
inline HydrodynamicCoefficients pair_set() {
  const HydrodynamicCoefficients one = crane_set();
  HydrodynamicCoefficients c = one;
  c.volume = {one.volume[0], 0.9 * one.volume[0]};
  c.waterplane = {5060.0, 4554.0};
  const auto both = [](const MatrixX& X) {
    const Matrix6 a = about_point(Matrix6(X), {4.0, -2.0, 1.0}), b = 0.9 * about_point(Matrix6(X), {-3.0, 1.0, 2.0});
    MatrixX result(12, 12);
    result << a, 0.1 * a, 0.1 * a.transpose(), b;
    return result;
  };
  c.A_inf = both(one.A_inf);
  for (FrequencyCoefficients& f : c.frequency) f.A = both(f.A), f.B = both(f.B);
  for (const RetardationKernel& kernel : one.retardation.kernels)
    c.retardation.kernels.push_back({kernel.i + 6, kernel.j + 6, kernel.value});
  c.retardation.kernels.push_back({1, 8, one.retardation.kernels[0].value});
  c.retardation.kernels.push_back({8, 1, one.retardation.kernels[0].value});
  c.excitation = {one.excitation.frequencies, one.excitation.headings, 12, {}};
  for (std::size_t n = 0; n < one.excitation.value.size(); n += 6) {
    for (std::size_t i = 0; i < 6; ++i) c.excitation.value.push_back(one.excitation.value[n + i]);
    for (std::size_t i = 0; i < 6; ++i) c.excitation.value.push_back(Complex(0.8, 0.3) * one.excitation.value[n + i]);
  }
  return c;
}

}  // namespace stillhook
