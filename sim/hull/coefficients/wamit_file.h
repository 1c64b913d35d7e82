// Hydrodynamic coefficients in the numeric output files of WAMIT (WAMIT User Manual 7, chapters 3 and 5), which many
// panel codes write and many tools read. Plain columns, one file a quantity, nothing but numbers:
//
//   <base>.1    PER  I  J  A  B              A_ij = A rho L^k      B_ij = B rho w L^k
//   <base>.3    PER  BETA  I  Mod Pha Re Im  X_i  = (Re + i Im) rho g L^m    (.2, of Haskind's relation, is the same)
//   <base>.hst  I  J  C                      C_ij = C rho g L^n
//
//   k = 3 + r_i + r_j,  m = 2 + r_i,  n = 2 + r_i + r_j;  r = 0 for translations, 1 for rotations;  L = ULEN, per unit
//   amplitude. PER is a period in s, where 0 means infinite frequency and a negative number zero frequency (both
//   without B); or, when the run was told so, a frequency in rad/s, where 0 means zero and a negative number infinite
//   frequency. BETA: deg, direction towards, from +x counter-clockwise. Pha: deg, of exp(+i w t): a lead. Modes 7..12
//   are those of the second body. Forces and moments about the origin of each body (XBODY), which need not be that of
//   the case's body frame; phases at the origin of the global frame, in whose z = 0 the calm water lies; the axes of
//   the bodies are parallel to it. A first line of text is a heading.
//
// The files name neither ULEN nor rho nor g; volumes are not in them, the area of the water plane is C_33.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "sim/hull/coefficients/database_frame.h"

namespace stillhook {

/// What the numbers of a WAMIT run are multiples of.
struct WamitUnits {
  enum class Column { period, frequency };
  double ulen = 1.0;                                       // m
  double density = 0.0;                                    // kg/m3
  double gravity = 0.0;                                    // m/s2
  Column column = Column::period;                          // what PER is
  double depth = std::numeric_limits<double>::infinity();  // m
  std::vector<Vector3> reference;  // XBODY of each hull, m, global frame; empty: the hulls' origins
};

/// Reads <base>.1 and, where they exist, <base>.3 (else <base>.2) and <base>.hst. frame.bodies must give the volumes.
/// Retardation functions are computed from B. Numbers as Fortran writes them (1.0D+03, 1.234-100) are understood; pairs
/// that are not listed at any frequency are zero; without a row of infinite frequency the added mass there is computed
/// (infinite_frequency.h) and remarked on. Throws SpecificationError("<path>:<line>") with the rule broken:
/// lines cut short, rows that come twice, a frequency that lacks a pair others have, Mod
/// and Pha that contradict Re and Im (but for forces that are rounding noise beside the largest of the file), modes of
/// more or fewer hulls than `frame` has. Does not run the self-checks.
HydrodynamicCoefficients read_wamit(const std::string& base, const WamitUnits& units, const DatabaseFrame& frame);

/// The file with that ending (".1") as it is on the disk: some systems write endings in capitals.
std::string wamit_path(const std::string& base, const std::string& ending);

/// Writes <base>.1, <base>.3 where the set has an excitation, and <base>.hst where `stiffness` has the restoring
/// matrix of each hull about its reference point (N/m, N, N m). Retardation functions are left out: the format has
/// none. 9 significant digits. Each file appears under its name only when complete. Throws SpecificationError(base)
/// when the set has no table of A and B (`sampled` makes one), numbers do not fit together, or a file cannot be
/// written.
void write_wamit(const std::string& base, const HydrodynamicCoefficients& coefficients, const WamitUnits& units,
                 const DatabaseFrame& frame, const std::vector<Matrix6>& stiffness = {});

}  // namespace stillhook
