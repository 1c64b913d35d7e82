// What an error of added mass or damping does to a hull's motion: the least that the self-checks compare it with.
#pragma once

#include "sim/hull/coefficients/coefficients.h"

namespace stillhook {

/// No spring holds the hull in this mode.
bool is_free(int mode);

/// N s/m, N m s: the least that an error of B_ii is compared with, by what it does to the motion; A is A_ii there.
double least_damping_scale(const HydrodynamicCoefficients& c, int mode, double w, double A);

/// kg, kg m2: the least that an error of A_ii is compared with, by what it does to the motion; A is A_ii there.
double least_inertia_scale(const HydrodynamicCoefficients& c, int mode, double w, double A);

}  // namespace stillhook
