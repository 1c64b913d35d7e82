// What is usually said about a sea in numbers: heights, periods, mean direction, spread.
//
//   m_n = int w^n S(w) dw,   Hs = 4 sqrt(m0),   T01 = 2 pi m0/m1,   Tz = 2 pi sqrt(m0/m2),   Tp at the peak of S
//   a1 = |int int S exp(i b)| / m0,   circular spread = sqrt(2 (1 - a1))                     (Kuik et al. 1988)
//
// Of the spectrum itself, untruncated, not of the waves drawn from it.
#pragma once

#include <string>
#include <vector>

#include "sim/sea/sea_spec.h"

namespace stillhook {

struct SeaStatistics {
  std::string name;
  double significant_height = 0.0;  // m
  double peak_period = 0.0;         // s
  double long_period = 0.0;  // s, of the longest waves that matter: the peak's or, in a spectrum or record from a
                             // file, where it is longer, the one beyond which a twentieth of the energy lies
  double mean_period = 0.0;  // s, T01
  double zero_crossing_period = 0.0;  // s, Tz
  double heading = 0.0;               // rad, the mean direction travels towards it, in W
  double spread = 0.0;                // rad, circular
};

/// Of each part of a sum and last of the whole; of another sea one entry. Empty for calm water. The state must be one
/// that build_wave_field() takes.
std::vector<SeaStatistics> sea_statistics(const SeaStateSpec& state);

/// Circular spread of cos^n within 90 degrees of the main direction, and of cos^2s of half the angle over the whole
/// circle, rad.
double circular_spread_cos_n(double n);
double circular_spread_cos_2s(double s);

}  // namespace stillhook
