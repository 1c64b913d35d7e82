// The classical Runge-Kutta formula of order 4 with a fixed step, for reference solutions in few coordinates.
#pragma once

#include <Eigen/Dense>
#include <cmath>

namespace stillhook::truth {

/// Integrates y' = f(y) from y(0) to y(t) in steps of at most `step` (s).
template <int N, typename F>
Eigen::Matrix<double, N, 1> runge_kutta(const F& f, Eigen::Matrix<double, N, 1> y, double t, double step = 2e-4) {
  using Vec = Eigen::Matrix<double, N, 1>;
  const int steps = static_cast<int>(std::ceil(t / step - 1e-9));
  const double h = steps > 0 ? t / steps : 0.0;
  for (int i = 0; i < steps; ++i) {
    const Vec k1 = f(y), k2 = f(Vec(y + h / 2 * k1)), k3 = f(Vec(y + h / 2 * k2)), k4 = f(Vec(y + h * k3));
    y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return y;
}

}  // namespace stillhook::truth
