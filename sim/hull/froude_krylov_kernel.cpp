#include "sim/hull/froude_krylov_kernel.h"

#include <cmath>

namespace stillhook {

void sum_phases(const double* x, const double* y, const double* const weight[6], int points, double kx, double ky,
                double real[6], double imag[6]) {
  constexpr int kBlock = 256;
  alignas(64) double angle[kBlock], c[kBlock], s[kBlock];
  for (int m = 0; m < 6; ++m) real[m] = imag[m] = 0.0;
  for (int first = 0; first < points; first += kBlock) {
    const int count = points - first < kBlock ? points - first : kBlock;
    for (int j = 0; j < count; ++j) angle[j] = kx * x[first + j] + ky * y[first + j];
    // Apart: sine and cosine of one angle in one loop become a call that has no vector form, four times as slow.
#pragma omp simd
    for (int j = 0; j < count; ++j) c[j] = std::cos(angle[j]);
#pragma omp simd
    for (int j = 0; j < count; ++j) s[j] = std::sin(angle[j]);
    for (int m = 0; m < 6; ++m) {
      const double* w = weight[m] + first;
      double a = 0.0, b = 0.0;
#pragma omp simd reduction(+ : a, b)
      for (int j = 0; j < count; ++j) {
        a += w[j] * c[j];
        b += w[j] * s[j];
      }
      real[m] += a;
      imag[m] += b;
    }
  }
}

}  // namespace stillhook
