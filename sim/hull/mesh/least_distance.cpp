#include "sim/hull/mesh/least_distance.h"

#include <algorithm>

namespace stillhook {
namespace {

constexpr double kTolerance = 1e-11;      // a violation this small, relative to the first ones, is none
constexpr double kContradiction = 1e-13;  // 1 - d'u when no point satisfies all

}  // namespace

void LeastDistance::add(VectorX a, double b) {
  const double length = a.norm();
  a_.push_back(a / length);
  b_.push_back(b / length);
}

/// Moves u to the least squares solution of the active set; what would turn negative leaves the set.
bool LeastDistance::settle_active(const VectorX& d) {
  while (!active_.empty()) {
    const int n = static_cast<int>(x0_.size()), count = static_cast<int>(active_.size());
    MatrixX E(n + 1, count);
    for (int k = 0; k < count; ++k) {
      E.col(k).head(n) = a_[active_[k]];
      E(n, k) = d(active_[k]);
    }
    const VectorX wanted = E.colPivHouseholderQr().solve(VectorX::Unit(n + 1, n));
    if (!wanted.allFinite()) return false;
    double share = 1.0;
    int leaves = -1;
    for (int k = 0; k < count; ++k) {
      if (wanted(k) > 0.0) continue;
      const double until_zero = u_[k] > 0.0 ? u_[k] / (u_[k] - wanted(k)) : 0.0;
      if (leaves >= 0 && until_zero >= share) continue;
      share = until_zero;
      leaves = k;
    }
    for (int k = 0; k < count; ++k) u_[k] += share * (wanted(k) - u_[k]);
    if (leaves < 0) return true;
    active_.erase(active_.begin() + leaves);
    u_.erase(u_.begin() + leaves);
  }
  return true;
}

int LeastDistance::most_violated(const VectorX& d, const VectorX& y, const std::vector<int>& barred) const {
  int worst = -1;
  double violation = kTolerance * (1.0 + y.norm());
  for (int k = 0; k < d.size(); ++k) {
    const double v = d(k) - a_[k].dot(y);
    if (v <= violation || std::find(active_.begin(), active_.end(), k) != active_.end() ||
        std::find(barred.begin(), barred.end(), k) != barred.end())
      continue;
    violation = v;
    worst = k;
  }
  return worst;
}

bool LeastDistance::solve() {
  const int count = static_cast<int>(a_.size());
  VectorX d(count);
  for (int k = 0; k < count; ++k) d(k) = b_[k] - a_[k].dot(x0_);
  const double size = count > 0 ? d.maxCoeff() : 0.0;
  if (size <= 0.0) {
    x_ = x0_;
    return true;
  }
  d /= size;  // distances in units of the largest violation at x0
  std::vector<int> barred;
  for (int n = 0; n < 20 * count + 100; ++n) {
    if (!settle_active(d)) return false;
    VectorX sum = VectorX::Zero(x0_.size());
    double left = 1.0;
    for (std::size_t k = 0; k < active_.size(); ++k) {
      sum += u_[k] * a_[active_[k]];
      left -= u_[k] * d(active_[k]);
    }
    if (left < kContradiction) return false;
    const VectorX y = sum / left;
    // One that was let in and left at once was violated by round-off alone.
    if (!barred.empty() && std::find(active_.begin(), active_.end(), barred.back()) != active_.end()) barred.clear();
    const int enters = most_violated(d, y, barred);
    if (enters < 0) {
      x_ = x0_ + size * y;
      return true;
    }
    active_.push_back(enters);
    u_.push_back(0.0);
    barred.push_back(enters);
  }
  return false;
}

}  // namespace stillhook
