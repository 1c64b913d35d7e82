// What a flat bed adds to the influence of panels: the images of a source in the bed and in the water plane.
//
// Between the planes z = 0 and z = -h a unit source at (x', z0) has images at the heights 2nh + z0 and 2nh - z0. With
// R the horizontal distance and
//
//   P(R, s)  = sum_n 1/sqrt(R^2 + (s - 2nh)^2) - const  = (1/h) [ln(R0/R) + 2 sum_m K0(m pi R/h) cos(m pi s/h)]
//   P-(R, s) = sum_n (-1)^n/sqrt(R^2 + (s - 2nh)^2)     = (2/h) sum_{m odd} K0(m pi R/2h) cos(m pi s/2h)
//
// (the second forms by Poisson's summation, K0 the modified Bessel function),
//
//   G+ = P(R, z - z0) + P(R, z + z0)      no flow through either plane
//   G- = P-(R, z - z0) - P-(R, z + z0)    zero on z = 0, no flow through the bed
//
// The constant makes the sum for P converge. It decides where the potential of a net flux is zero: at R = R0, the outer
// edge of the beach, where no wave is left; of water deeper than that R0 is 4 exp(-gamma) h = 2.25 h instead, where
// the constant vanishes as in water without a bed.
//
// The term n = 0 is taken from the panel itself, and so is n = +-1 unless the panel is small and far from it: a keel
// near the bed is near its own image. The sources of the rest are at least 1.5 depths away; they come from tables in
// R/h and s/h, summed over pieces of the panel of at most a depth. Beyond six depths only the logarithm is left of P
// (4e-9/h), and beyond nine nothing of P- (1e-6/h).
#pragma once

#include <limits>
#include <memory>

#include "sim/hull/rankine/flat_panel.h"

namespace stillhook::rankine {

/// The bed under a panel problem.
struct Bed {
  double depth = std::numeric_limits<double>::infinity();  // m, h
  double edge = 0.0;                                       // m, outer radius of the free surface's beach
  bool deep() const { return depth == std::numeric_limits<double>::infinity(); }
};

/// S and D of panels with all their images, over a bed of finite depth.
class BedImages {
 public:
  explicit BedImages(const Bed& bed);
  ~BedImages();

  /// Of G+ and G- at x, z = 0 to -h.
  Influence even(const FlatPanel& panel, const Vector3& x) const;
  Influence odd(const FlatPanel& panel, const Vector3& x) const;
  /// P alone, half of G+ where the point or the panel lies in z = 0.
  Influence half(const FlatPanel& panel, const Vector3& x) const;

 private:
  struct Table;
  Influence rest_of(const FlatPanel& panel, const Vector3& x, const Table& table) const;
  Influence of_plane(const FlatPanel& panel, const Vector3& from, double R) const;
  /// P-.
  Influence alternating(const FlatPanel& panel, const Vector3& x) const;

  double depth_, constant_;
  std::unique_ptr<const Table> even_, odd_, near_even_, near_odd_;
};

}  // namespace stillhook::rankine
