#include "sim/hull/froude_krylov_kernel.h"

#include <cmath>

namespace stillhook {

void sum_phases(const double* x, const double* y, const double* const weight[6], int points, double kx, double ky,
                double real[6], double imag[6]) {
  constexpr int kBlock = 256;
  alignas(64) double c[kBlock], s[kBlock];
  for (int m = 0; m < 6; ++m) real[m] = imag[m] = 0.0;
  for (int first = 0; first < points; first += kBlock) {
    const int count = points - first < kBlock ? points - first : kBlock;
#pragma omp simd
    for (int j = 0; j < count; ++j) {
      const double angle = kx * x[first + j] + ky * y[first + j];
      c[j] = std::cos(angle);
      s[j] = std::sin(angle);
    }
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
