// Waves of one frequency in the panel problem: phi_F = N q + R v with the free surface condition
//
//   q = kappa phi_F,   kappa = (w + i nu(s))^2 / g        (time factor exp(-i w t))
//   nu(s) = nu0 (s/L)^2,  nu0/w = strength 2 k c_g/w
//
// which follows from eta_t = q - 2 nu eta + (nu^2/g) phi, phi_t = -g eta (Cha, Nam & Ha 2018, Eq. 9). As an equation
// for the potential of the surface,
//
//   (1 - N kappa) phi_F = R v,      phi_H = C kappa phi_F + hull_response v,
//
// it is of the second kind: N smooths, so GMRES (Saad & Schultz 1986) needs about as many iterations as waves fit on
// the surface. Frequencies and their columns of v advance together, so that each pass through N serves all of them, as
// many as kColumnsAtOnce: what GMRES keeps of each is what limits their number.
#pragma once

#include <complex>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "sim/hull/rankine/boundary_problem.h"

namespace stillhook::rankine {

using MatrixXc = Eigen::MatrixXcd;

inline constexpr int kColumnsAtOnce = 64;

struct Beach {
  double width = 0.0;     // m, L
  double strength = 0.9;  // 1, nu0/w in deep water: the strength that suits each frequency (see docs/validation.md)
  double depth = std::numeric_limits<double>::infinity();  // m
  double gap = 0.0;       // 1, nu/w between two hulls, where potential theory lets the water swing without loss
};

/// 2 k c_g/w: the speed of the energy of waves over that in deep water for the same wave and frequency, 1 to 2. The
/// beach must be as much stronger to take as much from a wave before it is through.
double energy_speed(double frequency, double gravity, double depth);

struct FrequencyResponse {
  double frequency = 0.0;  // rad/s
  MatrixXc hull;           // H x columns of v: phi_H, m2/s for v in m/s
  MatrixXc surface;        // F x columns: phi_F
  // columns x columns, m4/s: of unit v, the part of Im(kappa) that the gap's damping makes times phi_F conj phi_F over the
  // surface, real part; empty where no cell is in a gap
  MatrixX taken_by_gap;
  int iterations = 0;      // of GMRES, the most of its columns
};

/// Responses to the columns of v (H x columns, complex; one entry a frequency) at each frequency (> 0). `tolerance`: of
/// the residual, relative to R v. Throws std::runtime_error naming the frequency when GMRES does not converge.
std::vector<FrequencyResponse> frequency_responses(const BoundaryClass& problem, const SurfacePanels& surface,
                                                   const Beach& beach, double gravity,
                                                   std::span<const double> frequencies, std::span<const MatrixXc> v,
                                                   double tolerance = 1e-5);

}  // namespace stillhook::rankine
