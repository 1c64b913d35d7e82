// Retardation functions from a table of radiation damping (Ogilvie 1964):
//
//   K(t) = (2 / pi) int_0^inf B(w) cos(w t) dw
//
// Between the table's frequencies B is the monotone cubic of Fritsch and Carlson (SIAM J. Numer. Anal. 17, 1980), from
// B(0) = 0 on. Above the last frequency W it falls as a power: B_ij(w) = B_ij(W) (W / w)^((n_i + n_j) / 2), n_i the
// slope of ln B_ii between the last two frequencies, held within 3..10; so B stays positive semidefinite where it was
// at W. How well K stands for the table is what the Kramers-Kronig self-check measures.
#pragma once

#include <vector>

#include "sim/hull/coefficients/coefficients.h"

namespace stillhook {

struct RetardationOptions {
  double duration = 60.0;  // s; a table in steps of d rad/s says nothing beyond pi / d
  double interval = 0.1;   // s
};

/// Kernels of all pairs whose B is not zero throughout. `table` ascending, at least three frequencies > 0. Throws
/// std::invalid_argument with the rule that is broken.
RetardationFunctions retardation_from_damping(const std::vector<FrequencyCoefficients>& table,
                                              const RetardationOptions& options = {});

/// A and B of the retardation functions at frequencies > 0, for formats that have no K.
std::vector<FrequencyCoefficients> sampled(const HydrodynamicCoefficients& coefficients,
                                           const std::vector<double>& frequencies);

}  // namespace stillhook
