#include "sim/hull/coefficients.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "sim/specification.h"

namespace stillhook {
namespace {

// What a set computed by a converged panel method leaves well inside, and a wrong sign, unit or reference point does
// not: two codes agree to 1 %, truncated and interpolated kernels add up to 3 %.
constexpr double kSymmetryLimit = 0.02;
constexpr double kNegativeDampingLimit = 0.02;
constexpr double kKramersKronigLimit = 0.06;
constexpr double kTailLimit = 0.02;

std::string pair_name(const char* matrix, int i, int j) {
  std::ostringstream out;
  out << matrix << '(' << i + 1 << ',' << j + 1 << ')';
  return out.str();
}

std::string at_frequency(double w) {
  std::ostringstream out;
  out << "at " << w << " rad/s";
  return out.str();
}

std::string at_frequency(const char* matrix, int i, int j, double w) {
  return pair_name(matrix, i, j).append(" ").append(at_frequency(w));
}

/// X_ij / sqrt(s_i s_j) with s the diagonal of `scale`; rows of modes without scale are left as they are.
MatrixX normalised(const MatrixX& X, const VectorX& scale) {
  VectorX d(scale.size());
  for (int i = 0; i < d.size(); ++i) d(i) = scale(i) > 0.0 ? 1.0 / std::sqrt(scale(i)) : 1.0;
  return d.asDiagonal() * X * d.asDiagonal();
}

/// Keeps the worst of several deviations.
void worsen(SelfCheck& check, double value, const std::string& detail) {
  if (!(value <= check.value)) {  // also true for NaN, which then fails the check
    check.value = value;
    check.detail = detail;
  }
}

void worsen_symmetry(SelfCheck& check, const MatrixX& X, const char* matrix, const std::string& where) {
  const MatrixX n = normalised(X, X.diagonal().cwiseMax(0.0));
  for (int i = 0; i < n.rows(); ++i)
    for (int j = 0; j < i; ++j) worsen(check, std::abs(n(i, j) - n(j, i)), pair_name(matrix, i, j).append(where));
}

double smallest_eigenvalue(const MatrixX& X) {
  return Eigen::SelfAdjointEigenSolver<MatrixX>(0.5 * (X + X.transpose()), Eigen::EigenvaluesOnly).eigenvalues()(0);
}

/// Largest B_ii over all frequencies: what damping is compared with.
VectorX largest_diagonal(const HydrodynamicCoefficients& c) {
  VectorX largest = VectorX::Zero(c.modes());
  for (const FrequencyCoefficients& f : c.frequency) largest = largest.cwiseMax(f.B.diagonal());
  return largest;
}

/// int_0^T K exp(i w t) dt of one kernel.
Complex transform(const std::vector<double>& K, double interval, double w) {
  // Cell integrals int_0^1 (1 - u) e^{i q u} du and int_0^1 u e^{i q u} du; by series for small q, where the closed
  // form cancels.
  const double q = w * interval;
  const Complex i(0.0, 1.0);
  Complex left, right;
  if (q < 1e-2) {
    left = Complex(0.5 - q * q / 24.0, q / 6.0 - q * q * q / 120.0);
    right = Complex(0.5 - q * q / 8.0, q / 3.0 - q * q * q / 30.0);
  } else {
    const Complex e = std::exp(i * q);
    right = e / (i * q) + (e - 1.0) / (q * q);
    left = (e - 1.0) / (i * q) - right;
  }
  Complex sum = 0.0;
  for (std::size_t m = 0; m < K.size(); ++m) {
    const double next = m + 1 < K.size() ? K[m + 1] : 0.0;
    sum += (left * K[m] + right * next) * std::exp(i * (q * static_cast<double>(m)));
  }
  return interval * sum;
}

SelfCheck check_finite(const HydrodynamicCoefficients& c) {
  SelfCheck check{"all numbers are finite", "", 0.0, 0.0};
  if (!c.A_inf.allFinite()) worsen(check, 1.0, "A_inf");
  for (const FrequencyCoefficients& f : c.frequency)
    if (!f.A.allFinite() || !f.B.allFinite()) worsen(check, 1.0, at_frequency(f.frequency));
  for (const RetardationKernel& k : c.retardation.kernels)
    for (double v : k.value)
      if (!std::isfinite(v)) worsen(check, 1.0, pair_name("K", k.i, k.j));
  for (const Complex& x : c.excitation.value)
    if (!std::isfinite(std::abs(x))) worsen(check, 1.0, "X");
  return check;
}

SelfCheck check_kernel_damping(const HydrodynamicCoefficients& c) {
  SelfCheck check{"B(w) >= 0 of the retardation functions", "", 0.0, kNegativeDampingLimit};
  // Up to 2.5 rad/s: the sea has no energy above, and panel methods little to say there.
  const int points = 50;
  const double highest = 2.5;
  std::vector<MatrixX> B;
  VectorX largest = VectorX::Zero(c.modes());
  for (int n = 1; n <= points; ++n) {
    B.push_back(damping_from_kernels(c.retardation, c.modes(), highest * n / points));
    largest = largest.cwiseMax(B.back().diagonal());
  }
  for (int n = 1; n <= points; ++n)
    worsen(check, -smallest_eigenvalue(normalised(B[n - 1], largest)), at_frequency(highest * n / points));
  return check;
}

SelfCheck check_kramers_kronig(const HydrodynamicCoefficients& c) {
  SelfCheck check{"Kramers-Kronig: A(w), B(w) of the table against the retardation functions", "", 0.0,
                  kKramersKronigLimit};
  const VectorX B_scale = largest_diagonal(c);
  for (const FrequencyCoefficients& f : c.frequency) {
    if (f.frequency <= 0.0) continue;
    const MatrixX A = added_mass_from_kernels(c.A_inf, c.retardation, f.frequency);
    const MatrixX B = damping_from_kernels(c.retardation, c.modes(), f.frequency);
    const MatrixX dA = normalised(A - f.A, f.A.diagonal().cwiseMax(0.0));
    const MatrixX dB = normalised(B - f.B, B_scale);
    for (int i = 0; i < c.modes(); ++i)
      for (int j = 0; j < c.modes(); ++j) {
        worsen(check, std::abs(dA(i, j)), at_frequency("A", i, j, f.frequency));
        worsen(check, std::abs(dB(i, j)), at_frequency("B", i, j, f.frequency));
      }
  }
  return check;
}

SelfCheck check_tails(const RetardationFunctions& K) {
  SelfCheck check{"retardation functions have died out at their end", "", 0.0, kTailLimit};
  for (const RetardationKernel& kernel : K.kernels) {
    double peak = 0.0, tail = 0.0;
    for (std::size_t m = 0; m < kernel.value.size(); ++m) {
      peak = std::max(peak, std::abs(kernel.value[m]));
      if (10 * m >= 9 * kernel.value.size()) tail = std::max(tail, std::abs(kernel.value[m]));
    }
    if (peak > 0.0) worsen(check, tail / peak, pair_name("K", kernel.i, kernel.j));
  }
  return check;
}

}  // namespace

double RetardationFunctions::duration() const {
  std::size_t samples = 0;
  for (const RetardationKernel& kernel : kernels) samples = std::max(samples, kernel.value.size());
  return interval * static_cast<double>(samples);
}

MatrixX damping_from_kernels(const RetardationFunctions& K, int modes, double frequency) {
  MatrixX B = MatrixX::Zero(modes, modes);
  for (const RetardationKernel& kernel : K.kernels)
    B(kernel.i, kernel.j) += transform(kernel.value, K.interval, frequency).real();
  return B;
}

MatrixX added_mass_from_kernels(const MatrixX& A_inf, const RetardationFunctions& K, double frequency) {
  MatrixX A = A_inf;
  for (const RetardationKernel& kernel : K.kernels)
    A(kernel.i, kernel.j) -= transform(kernel.value, K.interval, frequency).imag() / frequency;
  return A;
}

RetardationFunctions truncated(const RetardationFunctions& K, double tolerance) {
  RetardationFunctions result = K;
  for (RetardationKernel& kernel : result.kernels) {
    double total = 0.0, tail = 0.0, lost = 0.0;
    for (double k : kernel.value) total += std::abs(k);
    std::size_t keep = kernel.value.size();
    while (keep > 1 && tail + std::abs(kernel.value[keep - 1]) <= tolerance * total) {
      tail += std::abs(kernel.value[--keep]);
      lost += kernel.value[keep];
    }
    kernel.value.resize(keep);
    // sin^2 over the kept length: its mean is 1/2.
    for (std::size_t m = 0; m < keep; ++m) {
      const double s = std::sin(std::numbers::pi * static_cast<double>(m) / static_cast<double>(keep));
      kernel.value[m] += lost * 2.0 / static_cast<double>(keep) * s * s;
    }
  }
  return result;
}

Matrix6 about_point(const Matrix6& about_origin, const Vector3& c) {
  // v_Bo = v_P + c x w
  Matrix6 T = Matrix6::Identity();
  T.topRightCorner<3, 3>() = cross_matrix(c);
  return T.transpose() * about_origin * T;
}

std::vector<SelfCheck> self_checks(const HydrodynamicCoefficients& c) {
  std::vector<SelfCheck> checks = {check_finite(c)};
  if (!checks[0].passed()) return checks;  // the others would say nothing
  SelfCheck symmetry{"symmetry of A_inf", "", 0.0, kSymmetryLimit};
  worsen_symmetry(symmetry, c.A_inf, "A_inf", "");
  checks.push_back(symmetry);
  SelfCheck positive{"A_inf is positive semidefinite", "", 0.0, 1e-6};
  worsen(positive, -smallest_eigenvalue(normalised(c.A_inf, c.A_inf.diagonal().cwiseMax(0.0))), "");
  checks.push_back(positive);
  if (!c.frequency.empty()) {
    SelfCheck table_symmetry{"symmetry of A(w) and B(w)", "", 0.0, kSymmetryLimit};
    SelfCheck damping{"B(w) >= 0", "", 0.0, kNegativeDampingLimit};
    const VectorX B_scale = largest_diagonal(c);
    for (const FrequencyCoefficients& f : c.frequency) {
      worsen_symmetry(table_symmetry, f.A, "A", std::string(" ").append(at_frequency(f.frequency)));
      const MatrixX B = normalised(f.B, B_scale);
      worsen(table_symmetry, (B - B.transpose()).cwiseAbs().maxCoeff(), at_frequency(f.frequency));
      worsen(damping, -smallest_eigenvalue(B), at_frequency(f.frequency));
    }
    checks.push_back(table_symmetry);
    checks.push_back(damping);
  }
  if (!c.retardation.empty()) {
    checks.push_back(check_kernel_damping(c));
    checks.push_back(check_tails(c.retardation));
    if (!c.frequency.empty()) checks.push_back(check_kramers_kronig(c));
  }
  return checks;
}

void require_self_checks(const HydrodynamicCoefficients& coefficients) {
  for (const SelfCheck& check : self_checks(coefficients)) {
    if (check.passed()) continue;
    std::ostringstream sentence;
    sentence << "the coefficients fail \"" << check.name << "\" " << check.detail << ": deviation " << check.value
             << ", allowed " << check.limit;
    throw SpecificationError(coefficients.source, "", sentence.str());
  }
}

}  // namespace stillhook
