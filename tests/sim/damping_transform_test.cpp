#include "sim/hull/radiation/damping_transform.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "tests/sim/coefficient_sets.h"

namespace stillhook {
namespace {

/// K(t) = exp(-a t) (1 + a t - a^2 t^2): no slope at 0, no area; B(w) = Re(1/s + a/s^2 - 2 a^2/s^3), s = a - i w.
struct ClosedForm {
  double a;
  double K(double t) const { return std::exp(-a * t) * (1.0 + a * t - a * a * t * t); }
  double B(double w) const {
    const Complex s(a, -w);
    return (1.0 / s + a / (s * s) - 2.0 * a * a / (s * s * s)).real();
  }
};

std::vector<FrequencyCoefficients> table(const ClosedForm& form, double step, double last) {
  std::vector<FrequencyCoefficients> rows;
  for (int n = 1; n * step < last + 1e-9; ++n) {
    rows.push_back({n * step, MatrixX::Zero(6, 6), MatrixX::Zero(6, 6)});
    rows.back().B(2, 2) = 3.0 * form.B(n * step);
  }
  return rows;
}

double worst(const ClosedForm& form, double step, double last) {
  const RetardationFunctions K = retardation_from_damping(table(form, step, last), {20.0, 0.1});
  REQUIRE(K.kernels.size() == 1);
  CHECK(K.kernels[0].value.size() == 201);
  double error = 0.0;
  for (std::size_t m = 0; m < K.kernels[0].value.size(); ++m)
    error = std::max(error, std::abs(K.kernels[0].value[m] / 3.0 - form.K(0.1 * static_cast<double>(m))));
  return error;
}

}  // namespace

TEST_CASE("retardation functions follow from damping with a closed form", "[damping_transform]") {
  const ClosedForm form{0.5};
  const double coarse = worst(form, 0.1, 4.0), fine = worst(form, 0.05, 4.0);
  INFO(coarse << " " << fine);
  // K(0) = 1. Between the table's points a cubic is off by a power of their distance above the third.
  CHECK(coarse < 0.005);
  CHECK(fine < coarse / 8.0);
  // A table that ends early, before the fourth power has set in: the power fitted at its end stands for the rest.
  CHECK(worst(form, 0.05, 2.0) < 0.02);
}

TEST_CASE("the crane hull's retardation functions survive a table of their damping", "[damping_transform]") {
  const HydrodynamicCoefficients c = crane_set();
  std::vector<double> frequencies;
  for (int n = 1; n <= 75; ++n) frequencies.push_back(0.04 * n);
  const RetardationFunctions K = retardation_from_damping(sampled(c, frequencies), {40.0, 0.1});
  for (const RetardationKernel& old : c.retardation.kernels) {
    double peak = 0.0;
    for (double v : old.value) peak = std::max(peak, std::abs(v));
    for (const RetardationKernel& fresh : K.kernels)
      if (fresh.i == old.i && fresh.j == old.j)
        for (std::size_t m = 10; m < fresh.value.size(); ++m) {
          INFO(old.i << old.j << " " << m);
          // From 1 s on; before, the file's K has a tail of B beyond 3 rad/s that its own table does not.
          const double known = m < old.value.size() ? old.value[m] : 0.0;
          REQUIRE(std::abs(fresh.value[m] - known) < 0.03 * peak);
        }
  }
}

TEST_CASE("too short a table of damping is refused", "[damping_transform]") {
  CHECK_THROWS_AS(retardation_from_damping(table({0.5}, 1.0, 2.0)), std::invalid_argument);
  CHECK_THROWS_AS(retardation_from_damping({}), std::invalid_argument);
  CHECK_THROWS_AS(retardation_from_damping(table({0.5}, 0.1, 2.0), {1.0, 0.0}), std::invalid_argument);
}

}  // namespace stillhook
