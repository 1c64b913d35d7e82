// Modes in which a hull makes no waves: the yaw of a body of revolution, the surge of a thin disc.
//
// What a code leaves of their A and B is rounding or the noise of its panels: it has no symmetry, no sign and no
// Kramers-Kronig relation, and no state space fits it. Relative to the inertia m (kg; kg m2) of the displaced water,
//
//   B_ii <= e w m  and  |A_ii - A_inf,ii| <= e m  at all frequencies,  e = 1e-5
//
// changes an oscillation by e a radian: such a mode has no radiation, neither its own nor shared with others.
#pragma once

#include "sim/hull/coefficients/coefficients.h"

namespace stillhook {

/// kg or kg m2, of the water that the hull of a mode displaces: rho V, and rho V (L/4)^2 for turns. In yaw, where
/// the water plane is known, rho V ((L/4)^2 + B^2/12) with the mean breadth B: more than half of it in a square barge.
double displaced_inertia(const HydrodynamicCoefficients& c, int mode);

/// For each mode.
std::vector<bool> silent_modes(const HydrodynamicCoefficients& c);

/// The set with A = A_inf, B = 0 and K = 0 in its silent modes; there A_inf and X too are zero where they are noise.
HydrodynamicCoefficients without_noise(HydrodynamicCoefficients c);

}  // namespace stillhook
