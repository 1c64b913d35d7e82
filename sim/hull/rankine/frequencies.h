// The frequencies of a panel computation.
#pragma once

#include <vector>

#include "sim/hull/rankine/layout.h"

namespace stillhook::rankine {

/// rad/s: what the options say, or automatically kHighest, more where the seas reach beyond it, less for a hull that is
/// many such waves long.
///
/// The work of the shortest waves grows with the fourth power of the hull's size over their length, while the force of
/// waves much shorter than the hull nearly cancels along it. Above the band diffraction is that of the limit of short
/// waves (diffraction.h).
///
/// Over a bed all this is said of the wave lengths: frequencies stand for those that such waves have in deep water.
double highest_frequency(double diagonal, const PanelMethodOptions& options);

/// The same for one hull that takes as many panels as all of them together: the root of the sum of squared diagonals.
double highest_frequency(const Layout& layout, const PanelMethodOptions& options);

/// Ascending, the band's ends among them. Automatically kFrequencies, evenly in the logarithm as long as the phase of
/// the wave at the ends of the hull turns by no more than kPhase from one to the next, and evenly in it from there on:
/// A and B swing with the waves that both ends of a hull make.
std::vector<double> frequencies_of(const Layout& layout, const PanelMethodOptions& options);

/// rad/s, the frequency that waves as long as those of `frequency` in water of this depth (m) have in deep water.
double deep_frequency(double frequency, double gravity, double depth);
/// The inverse.
double frequency_over_bed(double deep, double gravity, double depth);

inline constexpr double kHighest = 2.0;     // rad/s, waves of 15 m
inline constexpr double kHighestPhase = 26.0;  // rad, k times half the hull's diagonal at an automatic band's end
inline constexpr int kFrequencies = 32;
inline constexpr double kPhase = 1.0;         // rad: three steps a swing

}  // namespace stillhook::rankine
