// The linear potential problem of hulls in still water, zero speed, deep water or over a flat bed, as matrices.
//
// Green's second identity for the potential phi on the hulls H and the water surface F (n into the water, unit source
// 1/r; Kring 1994, ch. 3; Cha, Nam & Ha 2018, Eq. 6-8), with the kernel G+ = 1/r + 1/r' that has an image about z = 0:
//
//   on H   2 pi phi   = int_H (phi dG+/dn - G+ v) dS + int_F G+ q dS       v = phi_n, q = phi_z
//   on F   2 pi phi   = int_H (phi d(1/r)/dn - v/r) dS + int_F q/r dS
//
// With constant strengths on the panels, H = 2 pi - D+ and the potential on the hull eliminated,
//
//   phi_H = C q - H^-1 S+ v,   C = 2 H^-1 S_HF            phi_F = N q + R v,
//   N = (S_FF + D_FH C)/2 pi,  R = -(D_FH H^-1 S+ + S_FH)/2 pi.
//
// N is the map from the vertical velocity of the water surface to its potential. No wave frequency is in it: with the
// free surface condition phi_F = q/kappa it gives the frequency response (frequency_response.h), and its inverse
// marches in time (panel_march.h). Outside F the surface is closed, q = 0; the beach lets no wave get there.
//
// With the kernel G- = 1/r - 1/r', which vanishes on z = 0, the hulls alone give the limit of high frequency,
//
//   2 pi psi = int_H (psi dG-/dn - G- v) dS,     A_inf,ij = -rho int psi_j n_i dS
//
// and with G+ and q = 0 that of low frequency, A(0).
//
// Over a flat bed at z = -h both kernels are sums over images in both planes (bed_images.h); on F the two halves of G+
// are the same again, and half of G+ stands for 1/r. Everything else is as in deep water.
//
// Symmetry: with planes x = 0 and y = 0 everything splits into classes of potentials that are even or odd about each;
// each class has matrices of its own, of the size of the part that is panelled.
#pragma once

#include <array>
#include <vector>

#include "sim/hull/rankine/bed_images.h"
#include "sim/hull/rankine/free_surface.h"

namespace stillhook::rankine {

/// Even (+1) or odd (-1) about x = 0 and y = 0; +1 about a plane that is not one of symmetry.
struct Parity {
  int x = 1, y = 1;
  bool operator==(const Parity&) const = default;
};

/// All parities a symmetry has: one, two or four.
std::vector<Parity> parities(const Symmetry& symmetry);

/// Normal velocity of the panels for unit velocity of mode `mode` (0..5, of the hull with reference point (x, y, z_ref),
/// axes turned by yaw): n_1..3 and (r x n)_1..3. Zero on other hulls.
struct ReferencePoint {
  double x = 0.0, y = 0.0, z = 0.0;  // m, in the panel problem's coordinates
  double yaw = 0.0;                  // rad
};
VectorX mode_normal(const HullPanels& hulls, int hull, int mode, const ReferencePoint& reference);
/// The parity of a mode of a lone hull on the planes of symmetry.
Parity mode_parity(const Symmetry& symmetry, int mode);

/// The class of one parity.
struct BoundaryClass {
  Parity parity;
  MatrixX N;              // F x F, m
  MatrixX C;              // H x F: phi_H by q, m
  MatrixX hull_response;  // H x H, -H^-1 S+: phi_H by v, m
  MatrixX R;              // F x H: phi_F by v, m
  MatrixX local;          // H x H: psi by v with phi = 0 on z = 0, m
};

struct BoundarySizes {
  int hull = 0, surface = 0, classes = 0;
  double bytes = 0.0;  // of all classes
};
BoundarySizes sizes_of(const HullPanels& hulls, const SurfacePanels& surface);

/// Only what the limits of the frequency need: hull_response and local; N, C and R are empty.
std::vector<BoundaryClass> limit_problem(const HullPanels& hulls, const Bed& bed = {});

/// Everything. Classes in the order of parities().
std::vector<BoundaryClass> boundary_problem(const HullPanels& hulls, const SurfacePanels& surface, const Bed& bed = {});

}  // namespace stillhook::rankine
