// The inner loop of linear_froude_krylov.h: a sum of sines and cosines over points of a hull.
//
// Compiled with -ffast-math like the wave kernel (sim/sea/wave_kernel.h says why such a file includes nothing else).
#pragma once

namespace stillhook {

/// real/imag[m] = sum_j weight[m][j] cos/sin(kx x_j + ky y_j), m = 0..5.
void sum_phases(const double* x, const double* y, const double* const weight[6], int points, double kx, double ky,
                double real[6], double imag[6]);

}  // namespace stillhook
