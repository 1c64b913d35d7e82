// Hydrodynamic coefficients of hulls by the Rankine panel method: from the geometry to added mass, radiation damping
// and excitation over a band of frequencies.
//
// The linear problem at zero speed, in deep water or over a flat bed, about the hulls upright at their mean drafts
// (rankine/boundary_problem.h, rankine/frequency_response.h). The band is divided; each part has a water surface of its
// own whose cells are a share of its shortest wave and whose beach is as wide as its longest one, so that long and
// short waves cost the same. A(0) and A_inf are exact limits of the same panels.
//
//   A - A_inf and B from the discrete system at each frequency; B of a lone hull from the energy of its waves,
//   B_ij = k/(8 pi rho g c_g) int Re(X_i conj X_j) db       c_g = dw/dk; in deep water w^3/(4 pi rho g^3)  (Newman
//   1962) X = X_FK + X_D,  X_D,i = i w rho int phi_i d(phi_I)/dn dS     (Haskind 1957; Newman 1962), phi_I of a unit
//   wave
//
// X turns with the phase of the wave along the hull and needs more frequencies than the potentials do: between the
// computed ones the potentials are interpolated (cubic), the wave is not. Haskind's relation is checked against the
// diffraction problem solved for itself, v = -d(phi_I)/dn.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "sim/hull/coefficients/coefficients.h"
#include "sim/hull/mesh/mesh.h"
#include "sim/hull/rankine/hull_panels.h"

namespace stillhook {

/// A hull in still water, upright.
struct PanelHull {
  std::string name;
  Mesh mesh;                              // closed, in B
  Vector3 box_size = Vector3::Zero();     // m, of a box that is the whole hull; zero: the mesh's own panels are used
  Vector3 box_centre = Vector3::Zero();   // m, in B
  double waterline = 0.0;                 // m, height of the still water plane above Bo
  double x = 0.0, y = 0.0, yaw = 0.0;     // m, m, rad: Bo and heading in the world; they matter for several hulls only
};

struct PanelMethodOptions {
  double density = 1025.0, gravity = 9.80665;  // kg/m3, m/s2
  double depth = std::numeric_limits<double>::infinity();  // m, of the water
  double lowest = 0.2, highest = 2.0;          // rad/s, > 0: the band; highest 0 = automatic (rankine/frequencies.h)
  double sea_highest = 0.0;                    // rad/s, what an automatic band should reach for the seas
  int frequencies = 32;                        // >= 4, spaced evenly in the logarithm; 0 = automatic
  std::vector<double> chosen;                  // rad/s, ascending, > 0: these instead; empty = as above
  int headings = 0;                            // >= 4, evenly around the circle; 0 = as many as the waves need
  double refinement = 1.0;                     // > 0: every panel and cell is divided by it; 2 halves them all
  double panel_length = 0.0;                   // m, longest panel of the hulls; 0 = automatic
  double gap_damping = 0.015;                  // 1, >= 0, nu/w of the water between two hulls (frequency_response.h)
  double memory = 0.0;                         // bytes that it may take; 0 = any
};
/// Rise of the water between hulls over the motion of a hull from which on it is called a resonance.
inline constexpr double kGapResonance = 3.0;

/// One part of the band.
struct PanelBand {
  double from = 0.0, to = 0.0;            // rad/s
  std::vector<double> frequencies;        // rad/s
  double near = 0.0, far = 0.0, width = 0.0;  // m, cells and beach (rankine/free_surface.h)
  double middle = 0.0, reach = 0.0;       // m, largest cell up to that distance; 0 = far everywhere
  double panel_length = 0.0;              // m, of the hulls
  int hull_panels = 0, surface_panels = 0, classes = 0;
  double bytes = 0.0;                     // estimate of the memory it takes
  int iterations = 0;                     // of GMRES, most
};

struct PanelMethodReport {
  std::vector<PanelBand> bands;
  // Two hulls: the water between them rises `gap_rise` times the motion of the hull that moves, at most, at gap_frequency
  // (rad/s). More than kGapResonance times is a resonance of the gap, whose height potential theory exaggerates.
  double gap_rise = 0.0, gap_frequency = 0.0;
  // One hull: largest difference between the damping of the pressure and that of the radiated energy, as the self-check
  // "haskind" measures it, 1. The set has the latter.
  double energy_balance = 0.0;
  double asymmetry = 0.0;         // largest |A_ij - A_ji| / sqrt(A_ii A_jj) before both are replaced by their mean
};

/// What a computation would take, without doing it: panels of each band and memory.
/// Throws like panel_method().
std::vector<PanelBand> planned_bands(const std::vector<PanelHull>& hulls, const PanelMethodOptions& options);

/// Iterations that GMRES usually needs, and the columns it solves: the modes of a symmetry class at every frequency of
/// the part.
inline constexpr double kUsualIterations = 60.0;
double columns_of(const PanelBand& band, int hulls);
/// Most memory of one part, with what GMRES keeps.
double bytes_at_most(const PanelBand& band, int hulls);

/// Computes the set. `progress`: share done, from 0 to 1, and what is being done; returning false ends the computation
/// with Interrupted. Throws SpecificationError("bodies.<name>") for a hull that cannot be used:
/// not in the water or wholly in it, a lid in the water plane, hulls that overlap, a hull too small for its waves, and
/// before anything is computed for one whose panels would take more memory than options.memory.
HydrodynamicCoefficients panel_method(const std::vector<PanelHull>& hulls, const PanelMethodOptions& options,
                                      PanelMethodReport* report = nullptr,
                                      const std::function<bool(double, const std::string&)>& progress = {});

/// X_D by the diffraction problem itself, modes x headings, each about its hull's Bo and with the phase of the crest
/// at it: the independent check of Haskind's relation, and of the symmetry decomposition.
Eigen::MatrixXcd diffraction_by_solution(const std::vector<PanelHull>& hulls, const PanelMethodOptions& options,
                                         double frequency, const std::vector<double>& headings);

}  // namespace stillhook
