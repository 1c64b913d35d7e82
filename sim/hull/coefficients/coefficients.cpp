#include "sim/hull/coefficients/coefficients.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/sea/dispersion.h"

namespace stillhook {
namespace {

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

double radiated_share(double frequency, double gravity, double depth) {
  if (std::isinf(depth)) return std::pow(frequency / gravity, 3);
  return 0.5 * wave_number(frequency, gravity, depth) / (gravity * group_velocity(frequency, gravity, depth));
}

Matrix6 about_point(const Matrix6& about_origin, const Vector3& c) {
  // v_Bo = v_P + c x w
  Matrix6 T = Matrix6::Identity();
  T.topRightCorner<3, 3>() = cross_matrix(c);
  return T.transpose() * about_origin * T;
}

}  // namespace stillhook
