// The point nearest to a given one under linear inequalities that arrive one after another:
//
//   minimise |x - x0|^2   subject to   a_k' x >= b_k
//
// by least distance programming (Lawson & Hanson 1974, ch. 23): with y = x - x0 and d_k = b_k - a_k' x0, the u >= 0
// that minimises |A u|^2 + (d' u - 1)^2, A = [a_1 a_2 ...], gives y = A u/(1 - d' u); d' u = 1 means that the
// inequalities contradict each other. u is found by their active set method; each solve starts from the set of the last
// one.
#pragma once

#include <vector>

#include "sim/spatial/pose.h"

namespace stillhook {

class LeastDistance {
 public:
  explicit LeastDistance(VectorX x0) : x0_(std::move(x0)), x_(x0_) {}

  /// Adds a' x >= b; a not zero.
  void add(VectorX a, double b);
  /// Moves to the new nearest point. False, and the point stays, if there is none or it was not found.
  bool solve();
  const VectorX& point() const { return x_; }

 private:
  bool settle_active(const VectorX& d);
  int most_violated(const VectorX& d, const VectorX& y, const std::vector<int>& barred) const;

  VectorX x0_, x_;
  std::vector<VectorX> a_;  // of length one
  std::vector<double> b_;
  std::vector<int> active_;
  std::vector<double> u_;  // of the active
};

}  // namespace stillhook
