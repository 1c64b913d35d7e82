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
#include <memory>
#include <vector>

#include "sim/body_spec.h"
#include "sim/error.h"
#include "sim/hull/coefficients/coefficient_source.h"
#include "sim/hull/damping.h"
#include "sim/hull/diffraction.h"
#include "sim/hull/heading_frame.h"
#include "sim/hull/radiation/radiation.h"
#include "sim/sea/sea_spec.h"

namespace stillhook {

/// One hull of the element.
struct HydrodynamicsHull {
  std::string name;  // opens the names of its channels
  HeadingFrame frame;
  ViscousDamping viscous;
  bool operator==(const HydrodynamicsHull&) const = default;
};

class HydrodynamicsElement final : public ForceElement {
 public:
  static constexpr int kMaxHulls = 4;

  /// A_inf: 6 rows a hull, symmetric. `radiation` (same modes) and `diffraction` (same hulls) may be null.
  HydrodynamicsElement(std::string name, std::vector<HydrodynamicsHull> hulls, MatrixX A_inf,
                       std::unique_ptr<const Radiation> radiation, std::unique_ptr<const Diffraction> diffraction);

  bool same_as(const ForceElement& other) const override;
  bool has_history() const override { return radiation_ || diffraction_; }
  bool add_history_tangent(const Instant& before, const Instant& now, double h, Memory m, const BodyChange& from,
                           const Eigen::Ref<const MatrixX>& state, Eigen::Ref<MatrixX> dQ) const override;
  bool advance_state_tangent(const Instant& before, const Instant& now, double h, Memory m, const BodyChange& from,
                             const BodyChange& to, Eigen::Ref<MatrixX> state) const override;
  int state_size() const override { return radiation_ ? radiation_->state_size() : 0; }
  int scratch_size() const override;
  void start(const Instant& now, Memory m) const override;
  void begin_step(const Instant& before, double h, Memory m) const override;
  void add_forces(const Instant& now, double h, Memory m, ForceSum& out) const override;
  void add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const override;
  void end_step(const Instant& now, double h, Memory m) const override;
  void add_mass(MatrixX& M, int phase) const override;
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

/// A hull of the element to be built. `critical_damping`: the linear viscous coefficients that
/// HydrodynamicsSpec::critical_fraction resolves to (damping.h), zero if none.
struct HydrodynamicsBody {
  HullAfloat afloat;
  int index = 0;  // of the body
  Vector6 critical_damping = Vector6::Zero();
};

/// The hydrodynamic force element of one body, or of several whose hulls feel each other, named
/// "<first body>.hydrodynamics"; null when there are neither coefficients nor damping. `set`: from coefficient_set(),
/// null for the kinds that have none. Sentences that a report must carry go to `warnings`. Throws SpecificationError
/// ("bodies.<name>.hydrodynamics") for values that are not physical, a hull or water that is not the set's, a sea with
/// energy that the set does not resolve, and a set that no passive state space fits.
std::unique_ptr<ForceElement> build_hydrodynamics(const std::vector<HydrodynamicsBody>& bodies,
                                                  std::shared_ptr<const HydrodynamicCoefficients> set,
                                                  std::shared_ptr<const WaveField> waves, const SeaSpec& sea,
                                                  const PanelMethodSpec& method, std::vector<std::string>& warnings,
                                                  const HydrodynamicsOptions& options = {});

/// Square roots S of a factor of each hull, a number a mode: S M S scales what a hull does to itself by its factor and
/// what two do to each other by the geometric mean, and keeps M symmetric and passive.
VectorX mode_factors(const std::vector<const BodySpec*>& bodies, double HydrodynamicsSpec::* factor);

/// Every body once, by index: alone, or with the one it is coupled with. Throws SpecificationError
/// ("bodies.<name>.hydrodynamics") for a partner that does not exist or is taken.
std::vector<std::vector<std::size_t>> coupled_hulls(const std::vector<BodySpec>& bodies);

/// Added mass of one hull of a set about the point c (m, in H from its reference point) at a frequency (rad/s; infinity
/// for A_inf), axes of H: from the retardation functions, else from the table.
Matrix6 added_mass_at(const HydrodynamicCoefficients& set, int hull, const Vector3& c, double frequency);

}  // namespace stillhook
