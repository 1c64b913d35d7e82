// 2-D spectra as SWAN writes them in text (SPEC files): VaDens or EnDens over AFREQ or RFREQ and NDIR or CDIR.
//
//   NDIR: degrees clockwise from north from which the waves come; CDIR: degrees counter-clockwise from east towards
//   which they travel. FACTOR multiplies the integers of a block, ZERO is a block without energy, NODATA one without
//   data. VaDens in m2/Hz/degr, EnDens in J/m2/Hz/degr over rho g.          (SWAN user manual, "Spectral files")
#pragma once

#include "problems/spectra/raw_spectrum.h"

namespace stillhook {

/// Whether the file begins as one of SWAN's.
bool is_swan_ascii(const std::string& path);

/// density kg/m3 and gravity m/s2: of the case, for EnDens. Throws FileError "<file>:<line>: ...".
RawSpectrum read_swan_ascii(const SpectrumFileSpec& spec, double density, double gravity);

}  // namespace stillhook
