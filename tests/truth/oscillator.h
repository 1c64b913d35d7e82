// One mass on a spring and damper under HHT: the amplification matrix of the method, and what a recorded motion says
// about its roots.
#pragma once

#include <Eigen/Dense>
#include <complex>
#include <vector>

namespace stillhook::truth {

/// (x, h v, h^2 a) one step on for x'' + 2 zeta omega x' + omega^2 x = 0 (Hughes, The Finite Element Method, par.
/// 9.3): a1 + (1 + alpha)(c v1 + k x1) - alpha (c v0 + k x0) = 0 with Newmark's formulas.
inline Eigen::Matrix3d amplification(double alpha, double zeta, double omega_h) {
  const double gamma = 0.5 - alpha, beta = (1.0 - alpha) * (1.0 - alpha) / 4.0;
  const double k = omega_h * omega_h, c = 2.0 * zeta * omega_h;
  Eigen::Matrix3d L, R;
  L << 1.0, 0.0, -beta, 0.0, 1.0, -gamma, (1.0 + alpha) * k, (1.0 + alpha) * c, 1.0;
  R << 1.0, 1.0, 0.5 - beta, 0.0, 1.0, 1.0 - gamma, alpha * k, alpha * c, 0.0;
  return L.inverse() * R;
}

/// The roots of the recurrence x[i+p] = c[p-1] x[i+p-1] + ... + c[0] x[i] that fits the samples best.
inline Eigen::VectorXcd roots_of(const std::vector<double>& x, int order) {
  const int rows = static_cast<int>(x.size()) - order;
  Eigen::MatrixXd A(rows, order);
  Eigen::VectorXd b(rows);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < order; ++j) A(i, j) = x[i + j];
    b[i] = x[i + order];
  }
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(order, order);
  companion.topRightCorner(order - 1, order - 1).setIdentity();
  companion.row(order - 1) = A.colPivHouseholderQr().solve(b).transpose();
  return companion.eigenvalues();
}

/// Damping ratio of samples of a decaying oscillation.
inline double damping_ratio(const std::vector<double>& x) {
  const std::complex<double> s = std::log(roots_of(x, 2)[0]);
  return -s.real() / std::abs(s);
}

}  // namespace stillhook::truth
