// The project's own text file of hydrodynamic coefficients, self-describing. Comma separated; lines that start with #
// and empty lines are comments. Conventions are those of coefficients.h; the file states them and a file that states
// others is refused.
//
//   stillhook_coefficients,1
//   description,<free text>                  where the numbers come from
//   hulls,1                                  modes 1..6 belong to the first hull, 7..12 to the second
//   reference_point,body_origin              rows and columns are about Bo ...
//   axes,x_forward_y_port_z_up               ... along the heading frame H
//   waterline_m,0                            height of the calm water plane above Bo
//   volume_m3,20240                          displaced volume, one number a hull
//   waterplane_m2,5060                       optional: area of the water plane, one number a hull
//   depth_m,20                               optional: depth of the water; without it the water is deep
//   density_kg_m3,1025
//   gravity_m_s2,9.80665
//   length_m,110                             length scale of the hull
//   time_factor,exp(-i omega t)              with this, a positive phase is a lag
//   wave_heading,towards                     0 deg: waves travel towards +x of H; counter-clockwise
//   symmetry,port_starboard                  X at headings 0..180 is mirrored; or none: headings all around
//   quantity,i,j_or_heading_deg,omega_rad_s_or_t_s,value,phase_deg
//   Ainf,1,1,,6.05e5,                        kg, kg m, kg m2
//   K,1,1,0.0,2.77e6,                        per mode pair: uniform times from 0
//   A,1,1,0.4,2.41e6,                        optional tables; omega = 0 is allowed for A
//   B,1,1,0.4,1.19e5,
//   X,1,45,0.4,1.97e6,-92.3                  optional; every mode at every omega and heading,
//                                            headings evenly spaced
//   end,<number of rows after the column line>
//
// Ainf, K, A, B: pairs that are not listed are zero; of (i,j) and (j,i) one suffices, and if both are listed they must
// agree within 2 % of the geometric mean of the diagonals.
#pragma once

#include <string>

#include "sim/hull/coefficients/coefficients.h"

namespace stillhook {

/// Diagonal damping may be negative by this part of the largest of its mode, as panels and rounding leave it.
inline constexpr double kNegativeDamping = 0.02;

/// Reads a coefficient file. Throws SpecificationError with entry "<path>:<line>" and the rule that is broken. Does not
/// run the self-checks.
HydrodynamicCoefficients read_coefficient_file(const std::string& path);

/// Writes what read_coefficient_file reads, with 9 significant digits, headings all around and no symmetry assumed.
/// The file appears under its name only when it is complete. Both A_ij and A_ji are written where they differ. Throws
/// SpecificationError(path) when the set cannot be said in this format (no retardation functions, numbers that are not
/// finite, damping more negative than kNegativeDamping) or the file cannot be written.
void write_coefficient_file(const std::string& path, const HydrodynamicCoefficients& coefficients);

}  // namespace stillhook
