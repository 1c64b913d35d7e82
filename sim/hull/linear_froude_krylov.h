// The Froude-Krylov force of linear theory: the pressure of the undisturbed wave on the mean wetted surface.
//
//   X_i = -int_S rho g C(z) exp(i k (x cos b + y sin b)) n_i dS,   w^2 = g k tanh kh,  n out of the hull,
//   C(z) = cosh k(z + h) / cosh kh,  in deep water exp(k z);   n_4..6 = x_B x n, moments about Bo;
//   force = Re[ X a exp(i th) ]  as in coefficients.h
//
// S: the hull mesh below the calm water plane, x_B from Bo. (Faltinsen 1990, ch. 3; Newman 1977, ch. 6)
//
// Waves much shorter than the hull are thrown back by the sides they meet and leave the water behind the hull calm: the
// pressure is twice that of the incident wave on the lit side and none on the side in the shadow (Kirchhoff's
// approximation; Faltinsen 1990, ch. 5). What this adds to the Froude-Krylov force is the limit of the diffraction force
//
//   X_D,i -> -int_S s rho g C(z) exp(i k (x cos b + y sin b)) n_i dS,   s = -1 .. 1 from lee to weather side.
#pragma once

#include <complex>
#include <limits>
#include <vector>

#include "sim/hull/mesh/mesh.h"

namespace stillhook {

/// Integrals over the water plane that a hull cuts out, x and y from Bo, and of the volume below it.
struct WaterplaneIntegrals {
  double area = 0.0;                       // m2
  double x = 0.0, y = 0.0;                 // m3, of x and y
  double xx = 0.0, xy = 0.0, yy = 0.0;     // m4
  double volume = 0.0;                     // m3
  double depth = 0.0;                      // m4, of z from the water plane over the volume: <= 0
};

class LinearFroudeKrylov {
 public:
  /// The part of `hull` (B, m) below z_B = waterline (m). density kg/m3, gravity m/s2; depth: of the water, m. Throws
  /// MeshError when nothing is below.
  LinearFroudeKrylov(const Mesh& hull, double waterline, double density, double gravity,
                     double depth = std::numeric_limits<double>::infinity());

  /// X per unit amplitude, N/m and N m/m. frequency rad/s, heading rad relative to B's x axis.
  Eigen::Matrix<std::complex<double>, 6, 1> excitation(double frequency, double heading) const;
  /// The same for several headings at once, one a column: what does not depend on the heading is computed once.
  Eigen::Matrix<std::complex<double>, 6, Eigen::Dynamic> excitations(double frequency,
                                                                     const std::vector<double>& headings) const;

  /// X_D in the limit of short waves, N/m and N m/m. Hulls that lie in each other's shadow are taken to be alone.
  Eigen::Matrix<std::complex<double>, 6, 1> short_wave_diffraction(double frequency, double heading) const;

  /// m3, enclosed by S and the water plane.
  double volume() const { return volume_; }
  double gravity() const { return gravity_; }  // m/s2
  double depth() const { return depth_; }      // m
  WaterplaneIntegrals waterplane() const;

 private:
  struct Triangle {
    Vector3 a, b, c;  // m; z from the water plane
  };
  /// The integral with each triangle's pressure times factor(outward unit normal).
  template <class Factor>
  Eigen::Matrix<std::complex<double>, 6, Eigen::Dynamic> integral(double frequency, const std::vector<double>& headings,
                                                                  Factor factor) const;

  std::vector<Triangle> wetted_;
  double waterline_, density_, gravity_, depth_, volume_ = 0.0;
};

}  // namespace stillhook
