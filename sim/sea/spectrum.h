// Wave spectra and their discretisation into components.
//
//   S(w) = (1 - 0.287 ln g) (5/16) Hs^2 wp^4 w^-5 exp(-1.25 (w/wp)^-4) g^b,   b = exp(-(w - wp)^2 / (2 s^2 wp^2))
//
// S  spectral density, m2 s/rad, one-sided in w        Hs  significant wave height, m       wp  2 pi / Tp, rad/s
// g  peakedness: 1 gives Pierson-Moskowitz             s   0.07 for w <= wp, else 0.09
// (JONSWAP in the form of DNV-RP-C205, 3.5.5; the factor 1 - 0.287 ln g keeps Hs within about 1 %, so components are
// scaled to make it exact.) Directional spreading is cos^n(theta - theta0) within 90 degrees of the main direction.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/sea/wave_field.h"

namespace stillhook {

/// Default peakedness by DNV-RP-C205: 5 for Tp/sqrt(Hs) <= 3.6, 1 for >= 5, else exp(5.75 - 1.15 Tp/sqrt(Hs)).
/// Hs in m, Tp in s.
double default_gamma(double significant_height, double peak_period);

/// Spectral density (m2 s/rad) at omega (rad/s) of an irregular sea state. gamma = 0 in the state means the default
/// rule; Pierson-Moskowitz has gamma 1. Zero for omega <= 0.
double spectral_density(const SeaStateSpec& state, double omega);

/// Uniform number in [0, 1) that depends on (seed, stream, index) alone: the same bits on every platform and in any
/// order of asking (SplitMix64 used as a hash of a counter; Steele, Lea & Flood 2014).
double portable_uniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t index);

/// Components of equal energy, state.components x state.directions of them. Each bin of the spectrum, cut off at 4 wp,
/// is represented by the rms frequency of half of it, placed in the bin by the seed so that the sea does not repeat
/// (the last, long bin by that of the whole, which keeps its second moment); each group of `directions` neighbouring
/// frequencies gets one component in each of the equally energetic directions, in shuffled order, so no two directions
/// share a frequency (shared ones would lock their phases and make the sea uneven in space). Phases are drawn from the
/// seed. Sum a^2/2 = Hs^2/16 exactly.
std::vector<WaveComponent> spectrum_components(const SeaStateSpec& state, double gravity);

}  // namespace stillhook
