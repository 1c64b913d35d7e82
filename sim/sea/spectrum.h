// Wave spectra and their discretisation into components.
//
//   S(w) = (1 - 0.287 ln g) (5/16) Hs^2 wp^4 w^-5 exp(-1.25 (w/wp)^-4) g^b,   b = exp(-(w - wp)^2 / (2 s^2 wp^2))
//
// S  spectral density, m2 s/rad, one-sided in w        Hs  significant wave height, m       wp  2 pi / Tp, rad/s
// g  peakedness: 1 gives Pierson-Moskowitz             s   0.07 for w <= wp, else 0.09
// (JONSWAP in the form of DNV-RP-C205, 3.5.5; the factor 1 - 0.287 ln g keeps Hs within about 1 %, so components are
// scaled to make it exact.)
//
//   S(w) = (1/4) [((4L + 1)/4) wp^4]^L / Gamma(L)  Hs^2 / w^(4L + 1)  exp(-((4L + 1)/4) (wp/w)^4)
//
// L  shape: 1 gives Pierson-Moskowitz                                                      (Ochi & Hubble 1976)
//
// Directional spreading is cos^n(theta - theta0) within 90 degrees of the main direction, or cos^2s((theta - theta0)/2)
// over the whole circle. A 2-D spectrum has a direction for each frequency.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "sim/sea/wave_field.h"

namespace stillhook {

/// Default peakedness by DNV-RP-C205: 5 for Tp/sqrt(Hs) <= 3.6, 1 for >= 5, else exp(5.75 - 1.15 Tp/sqrt(Hs)).
/// Hs in m, Tp in s.
double default_gamma(double significant_height, double peak_period);

/// Range of Ochi & Hubble's shape: the second moment of a spectrum of shape 0.5 is infinite, 30 is a narrow swell.
inline constexpr double kFlattestLambda = 0.7, kSharpestLambda = 30.0;

/// Spectral density (m2 s/rad) at omega (rad/s) of a JONSWAP, Pierson-Moskowitz or Ochi-Hubble sea, or of a 2-D spectrum
/// over all directions. gamma = 0 in the state means the default rule; Pierson-Moskowitz has gamma 1. Zero for omega <=
/// 0 and outside the frequencies of a 2-D spectrum.
double spectral_density(const SeaStateSpec& state, double omega);

/// Uniform number in [0, 1) that depends on (seed, stream, index) alone: the same bits on every platform and in any
/// order of asking (SplitMix64 used as a hash of a counter; Steele, Lea & Flood 2014).
double portable_uniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t index);

/// rad/s, below which the share `share` of the energy of such a sea lies.
double frequency_below(const SeaStateSpec& state, double share);

/// Density of a 2-D spectrum over all directions at entry i of its frequencies, m2 s/rad.
double density_at(const DirectionalSpectrum& spectrum, std::size_t i);

/// Variance of the surface, m2: the integral by the trapezoidal rule, nothing added above the last frequency.
double variance_of(const DirectionalSpectrum& spectrum);

/// Why it is none, in a sentence; empty if it is one: at least 2 rising frequencies > 0, at least 8 headings that go
/// round the circle in even steps, densities that are numbers >= 0 and not all 0.
std::string fault_of(const DirectionalSpectrum& spectrum);

/// Peakedness of a JONSWAP or Pierson-Moskowitz sea.
double gamma_of(const SeaStateSpec& state);

/// Part i of a sum as a state of its own: its name told with the sum's, its seed.
SeaStateSpec part_of(const SeaStateSpec& sum, int i);

/// Components of equal energy, state.components x state.directions of them. Each bin of the spectrum, cut off at 4 wp,
/// is represented by the rms frequency of half of it, placed in the bin by the seed so that the sea does not repeat
/// (the last, long bin by that of the whole, which keeps its second moment); each group of `directions` neighbouring
/// frequencies gets one component in each of the equally energetic directions, in shuffled order, so no two directions
/// share a frequency (shared ones would lock their phases and make the sea uneven in space). Phases are drawn from the
/// seed. Sum a^2/2 = Hs^2/16 exactly. Of a 2-D spectrum there are state.waves, each in a direction drawn from those that
/// have the energy at its frequency. `place`: of a part in a sum; parts of equal seeds have different phases.
std::vector<WaveComponent> spectrum_components(const SeaStateSpec& state, double gravity,
                                               double depth = std::numeric_limits<double>::infinity(), int place = 0);

}  // namespace stillhook
