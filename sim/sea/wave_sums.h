// Sums over the components of a sea, several lanes of a vector register at a time: what a step costs in an irregular
// sea.
//
// Sines, cosines and exponentials are polynomials of this file's own (2 units in the last place; arguments up to 1e6
// rad), so that they go into the sums from registers. Like the other kernels (sim/sea/wave_kernel.h) it is compiled
// with options of its own, with AVX-512 where the machine that builds has it, and includes nothing but plain C++.
#pragma once

#include "sim/sea/wave_kernel.h"

namespace stillhook {

/// Sums of the elevation, over a cos th (the first kElevationCosines) and a sin th, and of the head, over a exp(k (z -
/// zeta)) times the same.
inline constexpr int kElevationCosines = 7, kElevationSums = 12;
inline constexpr int kHeadCosines = 11, kHeadSums = 20;
/// Sums of the head that hold one derivative by s, or three: over a bed they have sinh where the others have cosh.
inline constexpr bool kOddInDepth[kHeadSums] = {false, true, false, false, false, false, false, false, true,  true,
                                                true,  false, false, false, true,  true,  true,  false, false, false};
/// Factors of one component: those of the elevation's sums, then those of the head's.
inline constexpr int kExpansionFactors = kElevationSums + kHeadSums;

/// kWaveBlock points in (m), sums out.
struct alignas(64) ExpansionBlock {
  double x[kWaveBlock], y[kWaveBlock], z[kWaveBlock];
  double elevation[kElevationSums][kWaveBlock], head[kHeadSums][kWaveBlock];
};

/// Fills an ExpansionBlock for sim/sea/wave_expansion.h. factor[j * kExpansionFactors + i]: of component j in sum i;
/// the amplitude belongs to the factors, waves[j].a is not looked at. zeta is `ramp` times the elevation's first sum.
void sum_expansions(const FrozenWave* waves, int count, double ramp, const double* factor, ExpansionBlock& block);
/// The same over a bed `depth` (m) below the still water, with exp(k s) + exp(-k (s + 2h)) or, where kOddInDepth, the
/// difference of the two in place of exp(k s), s = h (z - zeta) / (h + zeta).
void sum_expansions_over_bed(const FrozenWave* waves, int count, double ramp, double depth, const double* factor,
                             ExpansionBlock& block);

/// Components in blocks of this many for the sums at a point. Of each block `wave` holds kx, ky, w and phase,
/// kPhaseBlock values each; the last block is filled up with waves of no weight. th = kx x + ky y - w t + phase.
inline constexpr int kPhaseBlock = 8;

/// sums[m] = sum over j of (re cos th_j - im sin th_j) for six modes, then their derivatives by x, then by y. `force`:
/// of each block re and im of mode after mode, kPhaseBlock values each.
void sum_force(const double* wave, const double* force, int blocks, double x, double y, double t, double* sums);
/// Sum over j of amplitude cos th_j; kPhaseBlock amplitudes (m) a block.
double sum_elevation(const double* wave, const double* amplitude, int blocks, double x, double y, double t);

}  // namespace stillhook
