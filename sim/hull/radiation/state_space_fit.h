// Identification of the radiation memory as a small state space.
//
//   F = -K V,   K(i w) = B(w) + i w (A(w) - A_inf)                                               (Ogilvie 1964)
//   K(s) = sum over poles of residue matrices R_k/(s - p_k)                                      pole_residue.h
//
// What every hull's K has is built in: it is real in time, stable, symmetric (reciprocity), vanishes at s = 0, falls
// off as 1/s, and its real part is positive semidefinite at all frequencies (passivity.h) - also outside the band of
// the data. Modes that no entry couples form blocks with poles of their own, so a box hull has four: surge-pitch,
// sway-roll, heave, yaw. The order of a block (states per mode) is the lowest that meets the tolerance.
// (Perez & Fossen 2008 for the properties and their use in identification)
#pragma once

#include <string>
#include <vector>

#include "sim/hull/coefficients/coefficients.h"
#include "sim/hull/radiation/passivity.h"

namespace stillhook {

struct StateSpaceOptions {
  // rms over the band of |K_ij - fit| <= tolerance * sqrt(rms |K_ii| rms |K_jj|); 1
  double tolerance = 0.01;
  // Where no order meets the tolerance, the best of all is taken when it meets this; 0 = it is refused. 1
  double acceptable = 0.0;
  int lowest_order = 4;    // states per mode; >= 2
  int highest_order = 16;  // the same; no more than half the number of frequencies is ever tried
  // |K_ij| <= negligible * sqrt(max |K_ii| max |K_jj|) over the band is taken for zero; 1
  double negligible = 1e-4;
  // Floor of the damping that passivity asks for, at w0 in the middle of the band, as a share of the largest |K_ii|; 1
  double damping_floor = 2.5e-6;
  double highest_frequency = 3.0;  // rad/s, end of the band when retardation functions are fitted
  // Tables with fewer frequencies above zero cannot carry a fit; retardation functions are then used, if any.
  int fewest_frequencies = 20;
};

/// Modes that feel each other, and their transfer matrix in SI units.
struct StateSpaceBlock {
  std::vector<int> modes;
  PoleResidue K;
};

struct StateSpaceFit {
  int modes = 0;
  std::vector<StateSpaceBlock> blocks;

  int states() const;
  /// modes x modes.
  MatrixXc transfer(Complex s) const;
  MatrixX damping(double frequency) const;
  /// A(w) - A_inf; w > 0.
  MatrixX added_mass_change(double frequency) const;
  /// K(t) at t >= 0.
  MatrixX retardation(double t) const;
};

/// How well one entry is met.
struct StateSpacePair {
  int i = 0, j = 0;        // i <= j
  double error = 0.0;      // rms error over the band, relative to sqrt(rms |K_ii| rms |K_jj|)
  double r_squared = 0.0;  // of K_ij over the band, about its mean; 1 = perfect
};

struct StateSpaceBlockReport {
  std::vector<int> modes;
  int order = 0;                    // states per mode
  double passivity_margin = 0.0;    // smallest eigenvalue over all frequencies of Re K (w/w0 + w0/w)^2/4, each
                                    // K_ij over sqrt(max |K_ii| max |K_jj|); > 0 is passive
  double margin_frequency = 0.0;    // rad/s, where it is
  bool passivity_enforced = false;  // the unconstrained fit would have given energy away
  double beyond_band = 0.0;         // largest |K_ii| above the band over the largest within
};

/// What a report prints about a fit.
struct StateSpaceReport {
  std::string data;                    // "tables of A(w), B(w)" or "retardation functions"
  double lowest = 0.0, highest = 0.0;  // rad/s, the band
  int frequencies = 0;
  double tolerance = 0.0;
  int states = 0;
  double neglected = 0.0;  // largest |K_ij| set to zero, relative as above
  double asymmetry = 0.0;  // largest |K_ij - K_ji|/2 that was averaged away, relative as above
  std::vector<StateSpaceBlockReport> blocks;
  std::vector<StateSpacePair> pairs;

  double worst_r_squared() const;  // of the diagonal entries
  double worst_error() const;      // of all entries
};

struct StateSpaceModel {
  StateSpaceFit fit;
  StateSpaceReport report;
};

/// Fits the frequency tables, or the retardation functions where there are not enough of those. The coefficients should
/// have passed their self-checks. Throws SpecificationError (coefficients.source) for options out of range, when there
/// is nothing to fit, and when no order up to the highest meets the tolerance, or what is acceptable (naming the pair and its error).
StateSpaceModel fit_state_space(const HydrodynamicCoefficients& coefficients, const StateSpaceOptions& options = {});

}  // namespace stillhook
