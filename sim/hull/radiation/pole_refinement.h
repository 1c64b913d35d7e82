// Poles whose passive model is nearest to the data.
//
// Vector fitting finds poles for the residues that fit best, and those of a small order often give energy away at rest
// or far above the band; held to passivity, the residues then fit worse than need be. Here the poles move, by
// Levenberg & Marquardt's method, on the error that is left with passive residues (variable projection, Golub & Pereyra
// 1973, under the constraint).
#pragma once

#include <vector>

#include "sim/hull/radiation/pole_residue.h"

namespace stillhook {

/// Improves `poles` (same numbers of real poles and pairs) for an m x m matrix; w0 and floor as in passivity.h.
std::vector<std::complex<double>> refine_poles(const std::vector<std::complex<double>>& poles,
                                               const TransferSamples& samples, int m, double w0, double floor);

}  // namespace stillhook
