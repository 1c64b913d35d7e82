#include "sim/hull/rankine/compact_matrix.h"

#include <bit>

namespace stillhook::rankine {
namespace {

float widened(std::uint16_t half) { return std::bit_cast<float>(static_cast<std::uint32_t>(half) << 16); }

/// The nearest; entries are finite and far from the largest number there is.
std::uint16_t rounded(double value) {
  return static_cast<std::uint16_t>((std::bit_cast<std::uint32_t>(static_cast<float>(value)) + 0x8000u) >> 16);
}

}  // namespace

CompactMatrix::CompactMatrix(const MatrixX& A) : entries_(static_cast<std::size_t>(A.size()), 0) {
  VectorX lost = VectorX::Zero(A.rows());
  for (Eigen::Index j = 0; j < A.cols(); ++j)
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      if (i == j) continue;
      std::uint16_t& entry = entries_[static_cast<std::size_t>(j * A.rows() + i)];
      const double wanted = A(i, j) + lost[i];
      entry = rounded(wanted);
      lost[i] = wanted - widened(entry);
    }
  diagonal_ = (A.diagonal() + lost).cast<float>();
}

Eigen::VectorXf CompactMatrix::operator*(const Eigen::VectorXf& x) const {
  Eigen::VectorXf y = diagonal_.cwiseProduct(x);
  const int n = size();
  float* out = y.data();
  const std::uint16_t* column = entries_.data();
  int j = 0;
  for (; j + 4 <= n; j += 4, column += 4 * static_cast<std::size_t>(n)) {
    const std::uint16_t *a = column, *b = a + n, *c = b + n, *d = c + n;
    const float x0 = x[j], x1 = x[j + 1], x2 = x[j + 2], x3 = x[j + 3];
    for (int i = 0; i < n; ++i)
      out[i] += (x0 * widened(a[i]) + x1 * widened(b[i])) + (x2 * widened(c[i]) + x3 * widened(d[i]));
  }
  for (; j < n; ++j, column += n)
    for (int i = 0; i < n; ++i) out[i] += x[j] * widened(column[i]);
  return y;
}

}  // namespace stillhook::rankine
