// Retardation functions of a computed set.
#pragma once

#include "sim/hull/coefficients/coefficients.h"

namespace stillhook {

/// K(t) of a causal, passive model that meets A(w) and B(w) with A_inf: the band ends where B has not died out, so the
/// transform of B alone would have to guess its tail; A - A_inf knows it (Kramers-Kronig). That such a model exists is
/// itself the check that A, B and A_inf belong together, and how far it is from them the self-check "kramers_kronig"
/// says. Where none is near, the transform stands in: what was computed is kept in any case.
///
/// K is sampled, and between the samples taken as linear. A part of it that dies out within the first sample, of which
/// the band sees the integral alone, would be mistaken by that; the first sample therefore has what makes the integral
/// over all of them right.
RetardationFunctions causal_kernels(const HydrodynamicCoefficients& set);

}  // namespace stillhook
