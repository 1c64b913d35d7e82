// A measured elevation as a sea: its Fourier components, which all travel in one direction by assumption.
//
//   zeta(t) = sum_n a_n cos(w_n t - f_n),   w_n = 2 pi n / T    of the record of length T less its mean, tapered by a
//                                                              cosine over 5 % of T at either end
//
// At the gauge, between the tapers, the waves are the record itself; elsewhere they are what linear theory makes of it.
// After T the sea repeats. t = 0 of the record is t = 0 of the run.
#pragma once

#include <vector>

#include "sim/sea/wave_field.h"

namespace stillhook {

/// Share of a record at either end over which it is tapered.
inline constexpr double kRecordTaper = 0.05;

/// s, after which a sea made of the record repeats.
double record_length(const ElevationRecord& record);

/// Of the record's variance, the share in waves longer than record_file.lowest or shorter than .highest, which are left
/// out.
double record_share_left_out(const SeaStateSpec& state);

/// The components of state.record within the band of state.record_file; the crests of the record pass record_file.point.
/// Throws SpecificationError("sea.states.<name>") for a record that is none, for a band that leaves out more than 5 % of
/// its variance and for more waves than a field may have.
std::vector<WaveComponent> record_components(const SeaStateSpec& state, double gravity, double depth);

}  // namespace stillhook
