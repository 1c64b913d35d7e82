// Whether a coefficient set was computed in water so shallow that its waves feel the bottom, which WAMIT's files do not
// say.
//
// In waves much longer than the hull the heave force is the same from all directions, and Haskind's relation becomes
//
//   B_33 = k |X_3|^2 / (4 rho g Vg),    Vg = dw/dk,   w^2 = g k tanh(k h)          (Newman 1977, ch. 6)
//
// so that B_33 rho g Vg / |X_3|^2 tells k / Vg, and this the depth h.
#pragma once

#include <optional>

#include "sim/hull/coefficients/coefficients.h"

namespace stillhook {

/// The depth by the longest waves of a set of one hull, m, where the next longer ones agree (10 %); nothing where they
/// are those of deep water, or there are no waves long enough (k length < 1).
std::optional<double> felt_depth(const HydrodynamicCoefficients& set);

}  // namespace stillhook
