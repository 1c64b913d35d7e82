// The pressure on the wet part of a triangle.
//
// Depth below the surface d is interpolated linearly between the corners; the wet part is where d > 0. The pressure
// head h is linear between its values at the wet corners and zero on the line d = 0. With barycentric coordinates
// l_i and area A,
//
//   m_i = (1/A) integral over the wet part of h l_i dA      (m)
//
// holds all that is needed: the force is -rho g (sum m_i) A n, its moment -rho g (sum m_i r_i) x A n. For h = d (calm
// water) the integrals are exact, also over cut triangles. The moments are continuous in d and h.
#pragma once

namespace stillhook {

namespace clipped_panel {

/// Adds the moments of the wet tip at corner i when j and k are dry.
template <typename T>
void add_tip(const T* d, const T* h, int i, int j, int k, T* m) {
  const T to_j = d[i] / (d[i] - d[j]), to_k = d[i] / (d[i] - d[k]);  // where d = 0 on the edges, as a share from i
  const T share = to_j * to_k * h[i] / 12.0;
  m[i] += share * (4.0 - to_j - to_k);
  m[j] += share * to_j;
  m[k] += share * to_k;
}

/// Adds the moments of the wet quadrilateral when only k is dry. It is divided along both diagonals and averaged, so
/// that a mirrored triangle gives the mirrored result.
template <typename T>
void add_quadrilateral(const T* d, const T* h, int i, int j, int k, T* m) {
  const T on_i = d[i] / (d[i] - d[k]), on_j = d[j] / (d[j] - d[k]);  // the surface at A on i-k and B on j-k
  // Shares of the parts, over 24: (i, j, B) and (i, B, A); (i, j, A) and (j, B, A).
  const T ijB = on_j / 24.0, ijA = on_i / 24.0, both = on_i * on_j / 24.0;
  const T iBA = ijA - both, jBA = ijB - both;
  const T sum = h[i] + h[j], with_i = sum + h[i], with_j = sum + h[j];
  const T at_i = (ijB + ijA) * with_i + 2.0 * iBA * h[i];
  const T at_j = (ijB + ijA) * with_j + 2.0 * jBA * h[j];
  const T thin = iBA * h[i] + jBA * h[j];
  const T at_A = ijA * sum + thin, at_B = ijB * sum + thin;
  m[i] += at_i + (1.0 - on_i) * at_A;
  m[j] += at_j + (1.0 - on_j) * at_B;
  m[k] += on_i * at_A + on_j * at_B;
}

/// Bit i is set when corner i is below the surface: 0 = dry, 7 = wet.
inline int wet_corners(const double* d) { return (d[0] > 0.0) | (d[1] > 0.0) << 1 | (d[2] > 0.0) << 2; }

/// m[3] (m) from depths d[3] and heads h[3] (m) of a triangle with the given wet corners (1 to 7). Heads of dry corners
/// are not looked at. T is double or a dual number.
template <typename T>
void moments(int wet, const T* d, const T* h, T* m) {
  if (wet == 7) {
    const T sum = h[0] + h[1] + h[2];
    for (int i = 0; i < 3; ++i) m[i] = (sum + h[i]) / 12.0;
    return;
  }
  m[0] = m[1] = m[2] = T(0.0);
  switch (wet) {
    case 1:
      return add_tip(d, h, 0, 1, 2, m);
    case 2:
      return add_tip(d, h, 1, 2, 0, m);
    case 4:
      return add_tip(d, h, 2, 0, 1, m);
    default:
      break;
  }
  const int k = wet == 6 ? 0 : wet == 5 ? 1 : 2, i = (k + 1) % 3, j = (k + 2) % 3;
  add_quadrilateral(d, h, i, j, k, m);
}

}  // namespace clipped_panel

}  // namespace stillhook
