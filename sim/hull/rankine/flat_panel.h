// Influence of a flat polygonal panel with constant strength.
//
//   S(x) = int 1/r dS'                    (m)    r = |x - x'|
//   D(x) = int d/dn' (1/r) dS' = int n.(x - x')/r^3 dS'    (1), the signed solid angle: positive on the side of n
//
// Exact by edges (Wilton et al. 1984, IEEE Trans. Antennas Propag. 32, Eq. 5; Newman 1986, J. Eng. Math. 20, 113-126
// for the same result): with edge tangent t, outward edge normal u = t x n, h = n.(x - a), p = (a - x).u, l = (v - x).t,
// R0^2 = p^2 + h^2,
//
//   S = sum_edges p ln((r2 + l2)/(r1 + l1)) - |h| W,    W = sum [atan(p l/(R0^2 + |h| r))]_1^2,    D = sign(h) W.
//
// Far away by the panel's moments up to the second: with R = x - c, area A and M = int (x'-c)(x'-c)^T dS',
//
//   S = A/R + (3 R.M R/R^5 - tr M/R^3)/2,     D = n.R [A/R^3 + (15 R.M R/R^7 - 3 tr M/R^5)/2],
//
// whose relative error falls as (reach/R)^3; it is 2e-4 at the distance at which it takes over (tested).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/spatial/pose.h"

namespace stillhook::rankine {

inline constexpr int kMaxCorners = 8;

/// A convex flat polygon, corners counter-clockwise seen from the side its normal points to.
struct FlatPanel {
  int corners = 0;
  std::array<Vector3, kMaxCorners> v;
  Vector3 centroid = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();
  double area = 0.0;   // m2
  double reach = 0.0;  // m, from the centroid to the farthest corner
  Matrix3 moment = Matrix3::Zero();  // M, m4
};

/// From 3 to kMaxCorners corners. A quadrilateral that is not flat is replaced by its projection on the plane through
/// its centroid and normal to the cross product of its diagonals (Hess & Smith 1964). The area may be zero.
FlatPanel flat_panel(std::span<const Vector3> corners);

/// The same panel mirrored about the plane axis = 0; the order of corners is reversed, so that the normal is mirrored.
FlatPanel mirrored(const FlatPanel& panel, int axis);

struct Influence {
  double S = 0.0, D = 0.0;
};

/// By edges, everywhere; on the panel itself D is the principal value, 0.
Influence exact_influence(const FlatPanel& panel, const Vector3& x);

/// By moments: for x farther than kFar reaches from the centroid.
inline constexpr double kFar = 5.0;
inline Influence far_influence(const FlatPanel& panel, const Vector3& R, double R2) {
  const double i1 = 1.0 / std::sqrt(R2), i2 = i1 * i1, i3 = i1 * i2;
  const double RMR = R.dot(panel.moment * R) * i2, trace = panel.moment.trace();
  return {panel.area * i1 + 0.5 * (3.0 * RMR - trace) * i3,
          panel.normal.dot(R) * i3 * (panel.area + 0.5 * (15.0 * RMR - 3.0 * trace) * i2)};
}

inline Influence influence(const FlatPanel& panel, const Vector3& x) {
  const Vector3 R = x - panel.centroid;
  const double R2 = R.squaredNorm();
  return R2 > kFar * kFar * panel.reach * panel.reach ? far_influence(panel, R, R2) : exact_influence(panel, x);
}

}  // namespace stillhook::rankine
