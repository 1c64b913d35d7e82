// Equal uniform bars, hinged end to end, between two fixed points of one height, the last through a massless elastic
// line: the discrete catenary. With the horizontal pull H and the vertical pull V at the left end, bar i has the slope
// tan(th_i) = (V - (i + 1/2) w) / H (moments about its hinge), the line that of the pull in it. H and V by Newton's
// method on the two closures. (Irvine 1981, ch. 1, for bars.)
#pragma once

#include <Eigen/Dense>
#include <cmath>

namespace stillhook::truth {

struct HingedChain {
  int bars = 0;
  double length = 0.0, weight = 0.0;      // of a bar, m and N
  double line_length = 0.0, line_EA = 0;  // of the line, m and N
  double span = 0.0;                      // m

  /// (H, V) in N; H > 0.
  Eigen::Vector2d pull() const {
    Eigen::Vector2d x(0.5 * bars * weight, 0.5 * bars * weight);
    for (int k = 0; k < 200; ++k) {
      const Eigen::Vector2d f = miss(x);
      if (f.norm() < 1e-12) break;
      Eigen::Matrix2d J;
      for (int j = 0; j < 2; ++j) {
        Eigen::Vector2d y = x;
        const double by = 1e-6 * weight;
        y[j] += by;
        J.col(j) = (miss(y) - f) / by;
      }
      Eigen::Vector2d step = -J.inverse() * f;
      while (x[0] + step[0] <= 0.0) step *= 0.5;
      x += step;
    }
    return x;
  }
  double tension() const {  // N, in the line
    const Eigen::Vector2d x = pull();
    return std::hypot(x[0], x[1] - bars * weight);
  }

 private:
  Eigen::Vector2d miss(const Eigen::Vector2d& x) const {
    double along = 0.0, up = 0.0;
    for (int i = 0; i < bars; ++i) {
      const double slope = (x[1] - (i + 0.5) * weight) / x[0], c = 1.0 / std::sqrt(1.0 + slope * slope);
      along += length * c;
      up -= length * c * slope;
    }
    const double V = x[1] - bars * weight, T = std::hypot(x[0], V), l = line_length * (1.0 + T / line_EA);
    along += l * x[0] / T;
    up -= l * V / T;
    return {along - span, up};
  }
};

}  // namespace stillhook::truth
