// A large square matrix in 16 bits an entry, for products with vectors that are smooth from one entry to the next.
//
//   y = A x,   A_ij off the diagonal as the upper half of a single precision number (8 bits of mantissa); diagonal
//   exact
//
// Such a product reads the whole matrix once, so that memory is what limits its speed: half the bytes, half the time.
// Each entry is rounded together with what the entries before it in its row have lost (error diffusion; Floyd &
// Steinberg 1976, Proc. SID 17, 75-77), the diagonal with what is left, so that sums over neighbours keep single
// precision; what is left is the rounding of one entry, 2^-9 of it, times the change of x from one entry to the next.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/spatial/pose.h"

namespace stillhook::rankine {

class CompactMatrix {
 public:
  explicit CompactMatrix(const MatrixX& A);

  int size() const { return static_cast<int>(diagonal_.size()); }
  double bytes() const {
    return 2.0 * static_cast<double>(entries_.size()) + 4.0 * static_cast<double>(diagonal_.size());
  }
  Eigen::VectorXf operator*(const Eigen::VectorXf& x) const;

 private:
  std::vector<std::uint16_t> entries_;  // column after column
  Eigen::VectorXf diagonal_;
};

}  // namespace stillhook::rankine
