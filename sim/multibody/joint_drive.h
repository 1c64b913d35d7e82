// A spring and damper in the free coordinate of a revolute or prismatic joint, with a rest position that a drive may
// move:  tau = -k (s - s0 - s_drive) - c (s' - s_drive'),  a moment about (or force along) the joint's axis. The
// stretch of a revolute joint is taken within half a turn either way.
#pragma once

#include "sim/multibody/joint.h"

namespace stillhook {

class JointDrive : public ForceElement {
 public:
  /// stiffness N m/rad or N/m, damping per rad/s or m/s, rest rad or m; drive index or -1.
  JointDrive(std::string name, Joint joint, double stiffness, double damping, double rest, int drive);

  std::span<const int> drives() const override { return drive_or_none(drive_); }
  bool same_as(const ForceElement& other) const override;
  void add_forces(const Instant& now, double h, Memory m, ForceSum& out) const override;
  /// Exact on configurations that satisfy the joint.
  void add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const override;
  double potential_energy(const Instant& now, Memory m) const override;
  double dissipated_power(const Instant& now, Memory m) const override;
  std::vector<Channel> channels() const override;
  void measure(const Instant& now, Memory m, std::span<double> out) const override;

 private:
  using Row6 = Eigen::Matrix<double, 1, 6>;

  double load(const Instant& now) const;
  double stretch(const Instant& now) const;
  double stretch_rate(const Instant& now) const;
  void add_load_jacobian(const Row6& s_p, const Row6& s_c, const Row6& r_p, const Row6& r_c, JacobianSum& out) const;
  void add_turning_jacobian(const Instant& now, JacobianSum& out) const;
  void add_sliding_jacobian(const Instant& now, JacobianSum& out) const;

  Joint joint_;
  double stiffness_, damping_, rest_;
  int drive_;
};

}  // namespace stillhook
