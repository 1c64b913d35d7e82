#include "sim/hull/rankine/compact_matrix.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace stillhook;

TEST_CASE("a compact matrix multiplies smooth vectors as the matrix does", "[rankine]") {
  // The pattern of a march's P: a large diagonal that the far entries nearly cancel.
  constexpr int n = 203;  // not a multiple of the columns taken at once
  MatrixX A(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) A(i, j) = i == j ? 0.7 : -0.21 / std::pow(std::abs(i - j), 2.2);
  const rankine::CompactMatrix compact(A);
  CHECK(compact.size() == n);
  CHECK(compact.bytes() < 2.05 * n * n);
  Eigen::VectorXf smooth(n);
  for (int i = 0; i < n; ++i) smooth[i] = static_cast<float>(std::sin(0.11 * i + 0.3));
  const VectorX exact = A * smooth.cast<double>(), found = (compact * smooth).cast<double>();
  // Rounding of the nearest entries, 2^-9 of 0.21, times the change of x between them, 0.11: 5e-5, two of them a row.
  CHECK((found - exact).cwiseAbs().maxCoeff() < 1e-4);
  // The roundings of a row are passed on, and the diagonal takes the last: 1e-7 of it is left. Alone they would be
  // 1e-4.
  const Eigen::VectorXf ones = Eigen::VectorXf::Ones(n);
  CHECK(((compact * ones).cast<double>() - A * VectorX::Ones(n)).cwiseAbs().maxCoeff() < 2e-6);
}
