// The hydrodynamic force on one hull, or on several that feel each other: linear potential theory about the mean
// position, and viscous damping.
//
//   Q = T^T [ F_radiation + F_diffraction ] + F_viscous,   mass matrix + T^T A_inf T
//
// T and the frame H: heading_frame.h. Radiation: radiation.h (constant damping, retardation functions). Diffraction:
// diffraction.h. Viscous: damping.h. Hydrostatic and Froude-Krylov pressure are in the hydrostatics, not here.
// (Cha, Nam & Ha 2018, Eq. 6-10; Cummins 1962; Faltinsen 1990, ch. 3)
#pragma once

#include <functional>
#include <functional>
#include <memory>
#include <vector>

#include "sim/hull/damping.h"
#include "sim/hull/diffraction.h"
#include "sim/hull/heading_frame.h"
#include "sim/hull/radiation.h"
#include "sim/specification.h"

namespace stillhook {

/// One hull of the element.
struct HydrodynamicsHull {
  std::string name;  // opens the names of its channels
  HeadingFrame frame;
  ViscousDamping viscous;
};

class HydrodynamicsElement final : public ForceElement {
 public:
  static constexpr int kMaxHulls = 4;

  /// A_inf: 6 rows a hull, symmetric. `radiation` (same modes) and `diffraction` (same hulls) may be null.
  HydrodynamicsElement(std::string name, std::vector<HydrodynamicsHull> hulls, MatrixX A_inf,
                       std::unique_ptr<const Radiation> radiation, std::unique_ptr<const Diffraction> diffraction);

  int state_size() const override { return radiation_ ? radiation_->state_size() : 0; }
  int scratch_size() const override;
  void start(const Instant& now, Memory m) const override;
  void begin_step(const Instant& before, double h, Memory m) const override;
  void add_forces(const Instant& now, double h, Memory m, ForceSum& out) const override;
  void add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const override;
  void end_step(const Instant& now, double h, Memory m) const override;
  void add_mass(MatrixX& M) const override;
  /// Viscous damping and, for constant coefficients, radiation. The power of a radiation memory has no sign at an
  /// instant and is not counted.
  double dissipated_power(const Instant& now, Memory m) const override;
  /// For each hull "<hull>.radiation_surge" ... "_yaw" (without A_inf) and "<hull>.diffraction_surge" ... "_yaw", in
  /// H about Bo, N and N m.
  std::vector<Channel> channels() const override;
  void measure(const Instant& now, Memory m, std::span<double> out) const override;

 private:
  using Modes = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6 * kMaxHulls, 1>;  // on the stack
  /// Diffraction about the position a hull had when the step began; it is linear from there during the step.
  struct Linearised {
    double x, y;
    Vector6 F;
    Eigen::Matrix<double, 6, 2> dF;
  };

  int modes() const { return 6 * static_cast<int>(hulls_.size()); }
  Modes velocities(const Instant& now) const;
  Memory radiation_memory(Memory m) const;
  Linearised diffraction_at(int hull, double t, const Vector3& origin) const;
  Linearised diffraction_in_step(int hull, const Instant& now, double h, Memory m) const;

  std::vector<HydrodynamicsHull> hulls_;
  MatrixX A_inf_;
  std::unique_ptr<const Radiation> radiation_;
  std::unique_ptr<const Diffraction> diffraction_;
};

/// Bounds of the approximations made when an element is built from a coefficient file.
struct HydrodynamicsOptions {
  double kernel_tolerance = 0.005;  // 1, see truncated(); > 0, < 0.1
  double negligible_energy = 0.01;  // 1, share of the sea's energy that the excitation table need not resolve
  double density_tolerance = 0.01;  // 1, relative difference of density and gravity between file and sea
  double volume_tolerance = 0.02;   // 1, relative difference of displaced volume between file and mesh
};

/// The hydrodynamic force element of a body, named "<body>.hydrodynamics"; null when the body has neither coefficients
/// nor damping.
/// `body`: its index. `heading`: yaw of the body in the initial equilibrium, rad. `hull`: the body's mesh in B, needed
/// with Kind::table and excitation. `critical_damping`: the linear viscous coefficients that
/// HydrodynamicsSpec::critical_fraction resolves to (damping.h), zero if none. Throws SpecificationError
/// ("bodies.<name>") for values that are not physical, a coefficient file that cannot be read or fails its self-checks,
/// a hull or water that is not the file's, and a sea with energy that the file does not resolve.
std::unique_ptr<ForceElement> build_hydrodynamics(const BodySpec& spec, int body, double heading, const Mesh& hull,
                                                  std::shared_ptr<const WaveField> waves, const SeaSpec& sea,
                                                  const Vector6& critical_damping,
                                                  const HydrodynamicsOptions& options = {});

/// Added mass of a body about its centre of gravity as a function of frequency (rad/s; infinity for A_inf), axes of H:
/// what critical damping and natural periods need. Reads the coefficient file for Kind::table, once. Zero for
/// Kind::none. Throws SpecificationError.
std::function<Matrix6(double)> added_mass_of(const BodySpec& spec);
/// The same at one frequency.
Matrix6 added_mass_at(const BodySpec& spec, double frequency);

}  // namespace stillhook
