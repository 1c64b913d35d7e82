// A linear spring and damper in all six motions between a body and the world, about a point P of the body.
//
//   x = (R_WH^T (p_P - p_0), R_WH^T R_WR phi)      phi = log(R_WR^T R_WB)     the motion from rest, in the axes H
//   V = (R_WH^T v_P, R_WH^T R_WB w_B)              its velocity
//   F = F_0 + R_WH (-K x - D V)_1..3   at P
//   M = J_r(phi)^-T R_WR^T R_WH (-K x)_4..6 + R_WB^T R_WH (-D V)_4..6          about P, in B
//
//   p_0, R_WR  where P is at rest and the attitude there      F_0  force at rest, N      K, D  6 x 6, symmetric
//
// phi is the rotation vector from rest, so a turn about one axis by an angle a gives the moment k a at any angle below
// half a turn; J_r^-T makes the moment the one that does the work of the energy U = x^T K x/2 - F_0 . (p_P - p_0).
#pragma once

#include <array>

#include "sim/channel_kind.h"
#include "sim/multibody/point.h"

namespace stillhook {

struct RestoringSpec;

/// What is recorded of every entry, in the order in which measure() writes it.
namespace restoring_channels {
inline constexpr ChannelKind<RestoringSpec> force_x{"force_x", "N", "force on the body at the point, world axes"};
inline constexpr ChannelKind<RestoringSpec> force_y{"force_y", "N", "force on the body at the point, world axes"};
inline constexpr ChannelKind<RestoringSpec> force_z{"force_z", "N", "force on the body at the point, world axes"};
inline constexpr ChannelKind<RestoringSpec> moment_x{"moment_x", "N m",
                                                     "moment on the body about the point, world axes"};
inline constexpr ChannelKind<RestoringSpec> moment_y{"moment_y", "N m",
                                                     "moment on the body about the point, world axes"};
inline constexpr ChannelKind<RestoringSpec> moment_z{"moment_z", "N m",
                                                     "moment on the body about the point, world axes"};
inline constexpr std::array all = {force_x, force_y, force_z, moment_x, moment_y, moment_z};
}  // namespace restoring_channels

struct RestoringOptions {
  std::string name;
  BodyPoint point;
  Vector3 rest_point = Vector3::Zero();     // m, in W
  Matrix3 rest_R_WB = Matrix3::Identity();  // R_WR
  Matrix3 axes = Matrix3::Identity();       // R_WH
  Matrix6 stiffness = Matrix6::Zero();      // N/m, N, N m/rad
  Matrix6 damping = Matrix6::Zero();        // N s/m, N s, N m s/rad
  Vector3 force_at_rest = Vector3::Zero();  // N, in W

  bool operator==(const RestoringOptions&) const = default;
};

class Restoring final : public ForceElement {
 public:
  /// Throws SpecificationError when K is not symmetric or D not symmetric and positive semidefinite.
  explicit Restoring(RestoringOptions options);

  const RestoringOptions& options() const { return options_; }

  bool same_as(const ForceElement& other) const override;
  void add_forces(const Instant& now, double h, Memory m, ForceSum& out) const override;
  void add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const override;
  double potential_energy(const Instant& now, Memory m) const override;
  double dissipated_power(const Instant& now, Memory m) const override;
  std::vector<Channel> channels() const override;
  void measure(const Instant& now, Memory m, std::span<double> out) const override;

 private:
  /// Everything at one instant.
  struct Motion {
    Matrix3 R_WB;
    Vector3 phi;                          // rad, in B
    Vector6 x, V;                         // in the axes
    Vector6 spring, damper;               // -K x, -D V
    Vector3 force_W, moment_B, couple_R;  // at P; couple_R: the spring's couple in the axes of the body at rest
  };
  Motion motion(const Instant& now) const;

  RestoringOptions options_;
};

}  // namespace stillhook
