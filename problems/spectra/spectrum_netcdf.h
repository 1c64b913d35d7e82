// 2-D spectra in NetCDF files: of the wavespectra library, of WAVEWATCH III, of ECMWF's ERA5, and of SWAN.
//
//   wavespectra   efth      m2 s degree-1          dir: degrees from which the waves come
//   ww3           efth      m2 s rad-1             direction: degrees towards which they travel, stored falling
//   era5          d2fd      log10 of m2 s rad-1    30 frequencies 0.03453 x 1.1^i Hz, 24 directions 7.5 + 15 j deg
//   towards,
//                                                  by index alone; a missing value is no energy
//   swan          density   m2 s rad-1             direction in radians; whether from (nautical) or towards, from east
//                                                  counter-clockwise (cartesian), stands in Directional_convention
//
// Attributes `units` and `standard_name` win over what a format says; where `format` is named and they contradict it,
// the file is refused. (ECMWF, "2D wave spectra"; readers and sample files of wavespectra, MIT licence)
#pragma once

#include "problems/spectra/raw_spectrum.h"

namespace stillhook {

/// Throws FileError for a file that is damaged or that does not say what its numbers mean.
RawSpectrum read_netcdf_spectrum(const SpectrumFileSpec& spec);

}  // namespace stillhook
