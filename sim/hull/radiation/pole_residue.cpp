#include "sim/hull/radiation/pole_residue.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace stillhook {
namespace {

using Complex = std::complex<double>;

constexpr int kIterations = 40;
constexpr double kSettled = 1e-13;      // relative change of the poles at which the iteration ends
constexpr double kLeastDamping = 0.02;  // -Re p/|p|: no pole may ring for tens of periods between the samples
constexpr double kFastest = 10.0;       // |p| over the highest sampled frequency
constexpr double kSlowest = 0.1;        // |p| over the lowest

/// Weighted basis at all frequencies, real parts above imaginary parts.
MatrixX stacked_basis(const PoleBasis& basis, const TransferSamples& samples) {
  const int n = static_cast<int>(samples.frequency.size());
  MatrixX rows(2 * n, basis.order());
  for (int k = 0; k < n; ++k) {
    const Eigen::RowVectorXcd f = std::sqrt(samples.weight[k]) * basis.functions({0.0, samples.frequency[k]});
    rows.row(k) = f.real();
    rows.row(n + k) = f.imag();
  }
  return rows;
}

VectorX stacked_samples(const TransferSamples& samples, int entry) {
  const int n = static_cast<int>(samples.frequency.size());
  VectorX rows(2 * n);
  for (int k = 0; k < n; ++k) {
    const Complex value = std::sqrt(samples.weight[k]) * samples.entries[entry][k];
    rows(k) = value.real();
    rows(n + k) = value.imag();
  }
  return rows;
}

/// Squared error of the least squares residues, all entries.
double fit_error(const PoleBasis& basis, const TransferSamples& samples) {
  const MatrixX M = stacked_basis(basis, samples) * basis.zero_at_rest();
  const Eigen::ColPivHouseholderQR<MatrixX> qr(M);
  double sum = 0.0;
  for (int e = 0; e < static_cast<int>(samples.entries.size()); ++e) {
    const VectorX y = stacked_samples(samples, e);
    sum += (y - M * qr.solve(y)).squaredNorm();
  }
  return sum;
}

/// Zeros of the weight d + sum_n c_n f_n(s).
std::vector<Complex> zeros_of_weight(const PoleBasis& basis, const VectorX& c, double d) {
  MatrixX A = MatrixX::Zero(basis.order(), basis.order());
  VectorX b = VectorX::Zero(basis.order());
  int row = 0;
  for (const Complex& p : basis.poles()) {
    if (p.imag() == 0.0) {
      A(row, row) = p.real();
      b(row) = 1.0;
      row += 1;
    } else {
      A.block<2, 2>(row, row) << p.real(), p.imag(), -p.imag(), p.real();
      b(row) = 2.0;
      row += 2;
    }
  }
  const Eigen::VectorXcd eigenvalues = MatrixX(A - b * c.transpose() / d).eigenvalues();
  std::vector<Complex> zeros;
  for (const Complex& z : eigenvalues)
    if (z.imag() >= 0.0) zeros.push_back(z);
  return zeros;
}

/// Mirrors into the left half plane and keeps within what the samples can tell of.
void make_admissible(std::vector<Complex>& poles, const TransferSamples& samples) {
  const double fastest = kFastest * samples.frequency.back(), slowest = kSlowest * samples.frequency.front();
  for (Complex& p : poles) {
    double size = std::abs(p);
    if (size < slowest) p = size > 0.0 ? p * (slowest / size) : Complex(-slowest, 0.0);
    if (size > fastest) p *= fastest / size;
    size = std::abs(p);
    p = {-std::abs(p.real()), p.imag()};
    if (-p.real() < kLeastDamping * size)
      p = size * Complex(-kLeastDamping, std::sqrt(1.0 - kLeastDamping * kLeastDamping));
  }
  std::sort(poles.begin(), poles.end(), [](const Complex& a, const Complex& b) {
    return std::pair(std::abs(a), a.imag()) < std::pair(std::abs(b), b.imag());
  });
  // Coinciding poles would make the basis singular.
  for (std::size_t k = 1; k < poles.size(); ++k)
    if (std::abs(poles[k] - poles[k - 1]) < 1e-6 * std::abs(poles[k])) poles[k] *= 1.01;
}

std::vector<Complex> starting_poles(const TransferSamples& samples, int order) {
  const double low = samples.frequency.front(), high = 0.7 * samples.frequency.back();
  const int pairs = order / 2;
  std::vector<Complex> poles;
  for (int k = 0; k < pairs; ++k) {
    const double w = low + (high - low) * (k + 1.0) / pairs;
    poles.push_back({-0.3 * w, w});
  }
  if (order % 2 == 1) poles.push_back({-0.5 * high, 0.0});
  return poles;
}

/// One step of relaxed vector fitting.
std::vector<Complex> relocated(const std::vector<Complex>& poles, const TransferSamples& samples) {
  const PoleBasis basis(poles);
  const int n = basis.order(), rows = 2 * static_cast<int>(samples.frequency.size());
  const int entries = static_cast<int>(samples.entries.size()), half = rows / 2;
  const MatrixX free = stacked_basis(basis, samples) * basis.zero_at_rest();
  // The entries' residues are eliminated from each entry's equations by a QR of its own.
  MatrixX equations = MatrixX::Zero(entries * (n + 1) + 1, n + 1);
  MatrixX own(rows, n - 1 + n + 1);
  double size = 0.0;
  for (int e = 0; e < entries; ++e) {
    own.leftCols(n - 1) = free;
    for (int k = 0; k < half; ++k) {
      const Complex value = std::sqrt(samples.weight[k]) * samples.entries[e][k];
      const Eigen::RowVectorXcd f = -value * basis.functions({0.0, samples.frequency[k]});
      own.row(k).segment(n - 1, n) = f.real();
      own.row(half + k).segment(n - 1, n) = f.imag();
      own(k, 2 * n - 1) = -value.real();
      own(half + k, 2 * n - 1) = -value.imag();
      size += std::norm(value);
    }
    const MatrixX R = Eigen::HouseholderQR<MatrixX>(own).matrixQR().triangularView<Eigen::Upper>();
    const int kept = std::min<int>(n + 1, rows - (n - 1));
    equations.block(e * (n + 1), 0, kept, n + 1) = R.block(n - 1, n - 1, kept, n + 1);
  }
  // Relaxation: instead of d = 1, the weight's mean over the samples is 1.
  for (int k = 0; k < half; ++k)
    equations.bottomRows<1>().head(n) += basis.functions({0.0, samples.frequency[k]}).real() / half;
  equations(equations.rows() - 1, n) = 1.0;
  size = std::sqrt(size);
  equations.bottomRows<1>() *= size;
  VectorX right = VectorX::Zero(equations.rows());
  right(equations.rows() - 1) = size;
  VectorX scale(n + 1);
  for (int c = 0; c <= n; ++c) {
    const double length = equations.col(c).norm();
    scale(c) = length > 0.0 ? 1.0 / length : 1.0;
  }
  const VectorX x = scale.asDiagonal() * MatrixX(equations * scale.asDiagonal()).colPivHouseholderQr().solve(right);
  double d = x(n);
  if (std::abs(d) < 1e-8) d = d < 0.0 ? -1e-8 : 1e-8;
  std::vector<Complex> result = zeros_of_weight(basis, x.head(n), d);
  make_admissible(result, samples);
  return result;
}

int count(const std::vector<Complex>& poles) {
  int order = 0;
  for (const Complex& p : poles) order += p.imag() == 0.0 ? 1 : 2;
  return order;
}

}  // namespace

int PoleResidue::order() const { return count(poles); }

MatrixXc PoleResidue::transfer(Complex s) const {
  MatrixXc sum = MatrixXc::Zero(size(), size());
  for (std::size_t k = 0; k < poles.size(); ++k) {
    sum += residues[k] / (s - poles[k]);
    if (poles[k].imag() != 0.0) sum += residues[k].conjugate() / (s - std::conj(poles[k]));
  }
  return sum;
}

MatrixX PoleResidue::impulse_response(double t) const {
  MatrixX sum = MatrixX::Zero(size(), size());
  for (std::size_t k = 0; k < poles.size(); ++k)
    sum += (poles[k].imag() == 0.0 ? 1.0 : 2.0) * (residues[k] * std::exp(poles[k] * t)).real();
  return sum;
}

PoleBasis::PoleBasis(std::vector<Complex> poles) : poles_(std::move(poles)), order_(0) {
  for (const Complex& p : poles_) {
    first_.push_back(order_);
    order_ += p.imag() == 0.0 ? 1 : 2;
  }
  const VectorX at_rest = functions(0.0).real().transpose();
  const MatrixX Q = Eigen::HouseholderQR<MatrixX>(at_rest).householderQ();
  zero_at_rest_ = Q.rightCols(order_ - 1);
}

Eigen::RowVectorXcd PoleBasis::functions(Complex s) const {
  Eigen::RowVectorXcd f(order_);
  const Complex i(0.0, 1.0);
  for (std::size_t k = 0; k < poles_.size(); ++k) {
    const Complex a = 1.0 / (s - poles_[k]);
    if (poles_[k].imag() == 0.0) {
      f(first_[k]) = a;
    } else {
      const Complex b = 1.0 / (s - std::conj(poles_[k]));
      f(first_[k]) = a + b;
      f(first_[k] + 1) = i * (a - b);
    }
  }
  return f;
}

Complex PoleBasis::residue(const VectorX& parameters, int k) const {
  return {parameters(first_[k]), poles_[k].imag() == 0.0 ? 0.0 : parameters(first_[k] + 1)};
}

std::vector<Complex> fit_poles(const TransferSamples& samples, int order) {
  if (order < 2 || order >= static_cast<int>(samples.frequency.size()))
    throw std::invalid_argument("fit_poles: order must be at least 2 and below the number of frequencies");
  std::vector<Complex> poles = starting_poles(samples, order), best = poles;
  make_admissible(best, samples);
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0; n < kIterations; ++n) {
    const std::vector<Complex> next = relocated(poles, samples);
    if (count(next) != order) break;  // an eigenvalue was not finite
    const double error = fit_error(PoleBasis(next), samples);
    if (error < least) {
      least = error;
      best = next;
    }
    double change = next.size() == poles.size() ? 0.0 : 1.0;
    for (std::size_t k = 0; change < 1.0 && k < next.size(); ++k)
      change = std::max(change, std::abs(next[k] - poles[k]) / std::abs(next[k]));
    poles = next;
    if (change < kSettled) break;
  }
  return best;
}

}  // namespace stillhook
