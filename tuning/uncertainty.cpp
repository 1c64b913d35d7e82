#include "tuning/uncertainty.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stillhook {
namespace {

constexpr int kQuiet = 5;            // lags in a row within the noise end the correlation
constexpr double kOpen = 1e-10;      // eigenvalue of the scaled H: below, the direction is not determined

double bent(double r, double robust) { return std::clamp(r, -robust, robust); }

/// Values on the even grid, NaN in the gaps.
std::vector<double> on_grid(const VectorX& values, const std::vector<Eigen::Index>& sample) {
  std::vector<double> grid(sample.empty() ? 0 : static_cast<std::size_t>(sample.back() - sample.front() + 1),
                           std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < sample.size(); ++i)
    grid[static_cast<std::size_t>(sample[i] - sample.front())] = values[static_cast<Eigen::Index>(i)];
  return grid;
}

/// sum over lags of weight_l gamma_l J_i^T J_(i+l), both ways.
MatrixX coloured_sum(const ResidualSeries& s, const Autocorrelation& a) {
  const Eigen::Index columns = s.J.cols();
  const Eigen::Index length = s.sample.empty() ? 0 : s.sample.back() - s.sample.front() + 1;
  MatrixX even = MatrixX::Zero(length, columns);
  for (std::size_t i = 0; i < s.sample.size(); ++i)
    even.row(s.sample[i] - s.sample.front()) = s.J.row(static_cast<Eigen::Index>(i));
  MatrixX M = a.variance * s.J.transpose() * s.J;
  const double span = 2.0 * static_cast<double>(a.rho.size());
  for (std::size_t l = 1; l < a.rho.size(); ++l) {
    const auto lag = static_cast<Eigen::Index>(l);
    const MatrixX product = even.topRows(length - lag).transpose() * even.bottomRows(length - lag);
    M += a.variance * a.rho[l] * (1.0 - static_cast<double>(l) / span) * (product + product.transpose());
  }
  return M;
}

}  // namespace

double Autocorrelation::time() const {
  double sum = 1.0;
  const double span = 2.0 * static_cast<double>(rho.size());
  for (std::size_t l = 1; l < rho.size(); ++l) sum += 2.0 * rho[l] * (1.0 - static_cast<double>(l) / span);
  return std::max(1.0, sum);
}

Autocorrelation autocorrelation(const VectorX& values, const std::vector<Eigen::Index>& sample) {
  Autocorrelation a;
  a.rho = {1.0};
  const std::vector<double> grid = on_grid(values, sample);
  if (values.size() < 2) return a;
  const double n = static_cast<double>(values.size());
  a.variance = values.squaredNorm() / n;
  if (!(a.variance > 0.0)) return a;
  const double noise = 2.0 / std::sqrt(n);
  int quiet = 0;
  for (std::size_t lag = 1; lag < grid.size() / 4 && quiet < kQuiet; ++lag) {
    double sum = 0.0;
    for (std::size_t i = 0; i + lag < grid.size(); ++i)
      if (const double product = grid[i] * grid[i + lag]; !std::isnan(product)) sum += product;
    a.rho.push_back(sum / n / a.variance);
    quiet = std::abs(a.rho.back()) < noise ? quiet + 1 : 0;
  }
  a.rho.resize(a.rho.size() - static_cast<std::size_t>(quiet));
  return a;
}

MatrixX Uncertainty::correlation() const {
  const VectorX s = sd();
  MatrixX C = MatrixX::Identity(s.size(), s.size());
  for (Eigen::Index i = 0; i < s.size(); ++i)
    for (Eigen::Index j = 0; j < s.size(); ++j)
      if (i != j) C(i, j) = s[i] > 0.0 && s[j] > 0.0 ? std::clamp(covariance(i, j) / (s[i] * s[j]), -1.0, 1.0) : 0.0;
  return C;
}

Uncertainty uncertainty_of(const std::vector<ResidualSeries>& series, const MatrixX& prior, double robust,
                           const std::vector<bool>& held) {
  const Eigen::Index n = prior.rows();
  MatrixX H = prior, M = prior, plain = prior;
  for (const ResidualSeries& s : series) {
    VectorX psi = s.r;
    VectorX quadratic = VectorX::Ones(s.r.size());
    for (Eigen::Index i = 0; i < s.r.size(); ++i) {
      psi[i] = bent(s.r[i], robust);
      if (psi[i] != s.r[i]) quadratic[i] = 0.0;
    }
    // On the average over samples: a sample beyond the threshold is not known before to be one.
    const double share = s.r.size() > 0 ? quadratic.mean() : 1.0;
    H += share * s.J.transpose() * s.J;
    const Autocorrelation a = autocorrelation(psi, s.sample);
    plain += a.variance * s.J.transpose() * s.J;
    M += coloured_sum(s, a);
  }
  Uncertainty u;
  u.unknown.assign(static_cast<std::size_t>(n), false);
  u.covariance = u.white = MatrixX::Zero(n, n);
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (held[static_cast<std::size_t>(i)]) continue;
    if (H(i, i) > 0.0)
      free.push_back(i);
    else
      u.unknown[static_cast<std::size_t>(i)] = true;
  }
  const auto m = static_cast<Eigen::Index>(free.size());
  const VectorX scale = H(free, free).diagonal().cwiseSqrt().cwiseInverse();
  const MatrixX scaled = scale.asDiagonal() * MatrixX(H(free, free)) * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixX> eigen(scaled);
  MatrixX inverse = MatrixX::Zero(m, m);
  for (Eigen::Index k = 0; k < m; ++k) {
    const VectorX v = eigen.eigenvectors().col(k);
    if (eigen.eigenvalues()[k] > kOpen) {
      inverse += v * v.transpose() / eigen.eigenvalues()[k];
      continue;
    }
    VectorX direction = VectorX::Zero(n);
    for (Eigen::Index i = 0; i < m; ++i) direction[free[static_cast<std::size_t>(i)]] = v[i];
    u.open.push_back(direction);
    for (Eigen::Index i = 0; i < m; ++i)
      if (std::abs(v[i]) > 0.1) u.unknown[static_cast<std::size_t>(free[static_cast<std::size_t>(i)])] = true;
  }
  const MatrixX back = scale.asDiagonal() * inverse * scale.asDiagonal();
  const MatrixX white = back * MatrixX(plain(free, free)) * back;
  MatrixX coloured = back * MatrixX(M(free, free)) * back;
  if (m > 0 && !(coloured.diagonal().minCoeff() > 0.0)) coloured = white;  // the taper can overshoot
  // Residuals that swing against the derivatives would narrow an interval: not a thing to rely on.
  VectorX widen = VectorX::Ones(m);
  for (Eigen::Index i = 0; i < m; ++i)
    if (coloured(i, i) < white(i, i)) widen[i] = std::sqrt(white(i, i) / coloured(i, i));
  coloured = widen.asDiagonal() * coloured * widen.asDiagonal();
  for (Eigen::Index i = 0; i < m; ++i)
    for (Eigen::Index j = 0; j < m; ++j) {
      u.covariance(free[static_cast<std::size_t>(i)], free[static_cast<std::size_t>(j)]) = coloured(i, j);
      u.white(free[static_cast<std::size_t>(i)], free[static_cast<std::size_t>(j)]) = white(i, j);
    }
  return u;
}

}  // namespace stillhook
