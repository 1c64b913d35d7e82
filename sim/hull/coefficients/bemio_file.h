// Hydrodynamic coefficients in the HDF5 files of BEMIO, the pre-processor of WEC-Sim, which turns the output of WAMIT,
// NEMOH, AQWA and Capytaine into them. Source of the layout: WEC-Sim, functions writeBEMIOH5, readBEMIOH5,
// normalizeBEM, radiationIRF, and the WEC-Sim theory manual, "Numerical Methods" and "Terminology".
//
//   /simulation_parameters/  rho (kg/m3)  g (m/s2)  w (rad/s)  T (s)  wave_dir (deg)  scaled  water_depth (m,
//   "infinite") /bodyN/properties/       name  body_number  disp_vol (m3)  cg  cb (m)  dof  dof_start  dof_end
//   /bodyN/hydro_coeffs/     added_mass/all [6][modes][w]       A / rho         added_mass/inf_freq [6][modes]
//                            radiation_damping/all              B / (rho w)
//                            radiation_damping/impulse_response_fun/ K [6][modes][t]  K / rho,  t (s)
//                            excitation/ re im mag phase (rad) [6][wave_dir][w]       X / (rho g), per unit amplitude
//                            linear_restoring_stiffness [6][6]  C / (rho g)
//
// Shapes are those HDF5 reports, last index fastest (MATLAB shows them in reverse). Modes are those of all bodies, 6
// each. With scaled != 0 the numbers have been multiplied out (kg, N, ...). Forces and moments about each body's centre
// of gravity cg, which is given in the global frame, whose z = 0 is the calm water plane; axes parallel to it. Phases:
// the force is Re[(re + i im) a exp(i w t)] in the wave whose crest passes the origin of the global frame at t = 0;
// wave_dir is the direction towards, counter-clockwise from +x. K(t) = (2 / pi) int B cos(w t) dw.
#pragma once

#include <string>
#include <vector>

#include "sim/hull/coefficients/database_frame.h"

namespace stillhook {

/// Reads all bodies of a file, which must be as many as frame.bodies, or frame.chosen. `scaled` is 0, and T not compared,
/// where they are missing; excitation may be given as mag and phase alone, A and B be missing beside K. Volumes come
/// from the file where the frame gives none, the water planes from the restoring in heave, retardation functions from
/// the file or else from B. Frequencies may stand in any order; excitation at w = 0 is left out. Throws
/// SpecificationError(path) when it is no HDF5 file, is damaged, lacks another dataset, a dataset has another shape,
/// bodies have other than six modes, numbers are not finite, w and T contradict each other, or times are uneven. Does
/// not run the self-checks.
HydrodynamicCoefficients read_bemio(const std::string& path, const DatabaseFrame& frame);

/// What WEC-Sim wants to know of a body beyond its coefficients.
struct BemioBody {
  std::string name;
  Vector3 cg = Vector3::Zero(), cb = Vector3::Zero();  // m, global frame
  Matrix6 stiffness = Matrix6::Zero();                 // hydrostatic restoring about cg, N/m, N, N m
};

/// Writes such a file (scaled = 0), which appears under its name only when complete. One list of frequencies serves
/// all: those of X; A and B there are the table's, or those of the retardation functions. Throws
/// SpecificationError(path) when the set has no excitation, A and B cannot be had at its frequencies, or the file
/// cannot be written.
void write_bemio(const std::string& path, const HydrodynamicCoefficients& coefficients, const DatabaseFrame& frame,
                 const std::vector<BemioBody>& bodies);

}  // namespace stillhook
