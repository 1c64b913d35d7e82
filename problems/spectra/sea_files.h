// The files that the seas and the wind of a case name.
#pragma once

#include "sim/environment/wind_spec.h"
#include "sim/sea/sea_spec.h"

namespace stillhook {

/// The spectrum that a file holds, in the world; the format by the file where spec.format leaves it open. density kg/m3
/// and gravity m/s2: of the case. Throws FileError.
DirectionalSpectrum read_spectrum_file(const SpectrumFileSpec& spec, double density, double gravity);

/// Reads what the state has in a file, if it has, into state.spectrum or state.record; not that of its parts. What was
/// read once is kept while the file does not change. Throws FileError.
void read_sea_file(SeaStateSpec& state, double density, double gravity);

/// Reads wind.record, if the wind has one. Kept in the same way. Throws FileError.
void read_wind_record(WindSpec& wind);

}  // namespace stillhook
