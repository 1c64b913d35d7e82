// Added mass at infinite frequency of databases that do not have it.
//
//   A_inf = A(w) + (1/w) int_0^inf K(t) sin(w t) dt      at every w (Ogilvie 1964),  K from B (damping_transform.h)
//
// Where the band of the table ends before B has died out, what lies beyond adds nearly the same to A at all lower w:
// the middle value over the lower part of the band is the A_inf that fits the table, which may be off the true one by
// that.
#pragma once

#include "sim/hull/coefficients/coefficients.h"

namespace stillhook {

/// The median of the relation over the frequencies > 0 up to 0.6 of the highest, entry by entry. Throws
/// std::invalid_argument as retardation_from_damping does.
MatrixX infinite_added_mass(const std::vector<FrequencyCoefficients>& table);

}  // namespace stillhook
