// Passivity of a symmetric rational matrix K(s) with K(0) = 0, strictly proper and stable:
//
//   Re K(i w) >= 0 for all w >= 0                              no motion can draw energy from the model
//
// Re K vanishes at both ends, as w^2 at rest and as w^-2 far above, so what is looked at is
//
//   P(w) = Re K(i w) (w/w0 + w0/w)^2                           finite and, for a passive model, positive on [0,
//   infinity]
//
// Test. With x = s^2 = -w^2, P is a rational function of x: P(x) = P_inf + sum_k T_k/(x - p_k^2). Between a grid's
// points a smallest eigenvalue below a floor would go unseen; but P - floor can only lose its positive definiteness
// where it is singular, and it is singular at the eigenvalues x of a constant matrix (the half-size form of the
// Hamiltonian test for symmetric models: Semlyen & Gustavsen 2009). None on the negative real axis, with P positive
// definite at one point and at infinity, is a proof for all frequencies.
//
// Enforcement. With the poles fixed, v' P(w) v >= floor is linear in the residues. The residues nearest to the data
// are found by cutting planes: solve the least squares problem with the cuts so far, find where P falls below the
// floor, add the cut of each eigenvector there. The problem is convex, so nothing but the model's own violations is
// changed.
#pragma once

#include <vector>

#include "sim/hull/radiation/pole_residue.h"

namespace stillhook {

struct PassivityTest {
  bool passive = false;           // P(w) >= floor at all frequencies
  double least = 0.0;             // smallest eigenvalue of P found
  double frequency = 0.0;         // rad/s, where; infinity is a possible answer
  std::vector<double> crossings;  // rad/s, where an eigenvalue of P passes the floor
};

/// P(w); w >= 0, infinity allowed. K(0) = 0 is relied upon.
MatrixX weighted_real_part(const PoleResidue& model, double w0, double w);

/// Whether P(w) >= floor for all w, by the eigenvalues above. `model` in units in which its entries are of order one
/// (floor is absolute).
PassivityTest test_passivity(const PoleResidue& model, double w0, double floor);

/// Least squares residues for the poles of `basis` under K(0) = 0 and P(w) >= floor.
struct PassiveResidues {
  PoleResidue model;
  PassivityTest test;
  bool constrained = false;  // the unconstrained residues violated the floor
  int cuts = 0;              // cutting planes that were needed
};

/// samples: entries (0,0), (0,1), .. (0,m-1), (1,1), ... of an m x m matrix. Needs order >= 2; always ends with a
/// passive model (if the cuts do not settle, by adding the least multiple of a model that is strictly passive with the
/// same poles).
PassiveResidues fit_passive_residues(const PoleBasis& basis, const TransferSamples& samples, int m, double w0,
                                     double floor);

/// The same for searches over poles: cuts on a coarse grid, not certified.
PoleResidue fit_nearly_passive_residues(const PoleBasis& basis, const TransferSamples& samples, int m, double w0,
                                        double floor);

}  // namespace stillhook
