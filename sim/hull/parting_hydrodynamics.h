// Hulls that feel each other's waves until one of them leaves.
//
// Before the parting phase the forces are those of the coupled set, from then on those of each hull alone: radiation,
// diffraction and added mass change with it. All of them remember the motion all the time, so that each hull's own waves
// are there when its turn comes; what the other hull sent out is gone at once. That is a step in the forces, small when
// the hulls part while the load hangs free of both.
#pragma once

#include <memory>
#include <vector>

#include "sim/multibody/force_element.h"

namespace stillhook {

class PartingHydrodynamics final : public ForceElement {
 public:
  /// `together`: the coupled element; `apart`: one for each of its hulls, in its order, so that the channels of all of
  /// them in a row are those of `together`. `phase`: from which they are apart, > 0. Throws std::invalid_argument when
  /// the channels do not match.
  PartingHydrodynamics(std::unique_ptr<const ForceElement> together,
                       std::vector<std::unique_ptr<const ForceElement>> apart, int phase);

  int state_size() const override { return state_size_; }
  int scratch_size() const override { return scratch_size_; }
  void start(const Instant& now, Memory m) const override;
  void begin_step(const Instant& before, double h, Memory m) const override;
  void add_forces(const Instant& now, double h, Memory m, ForceSum& out) const override;
  void add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const override;
  void end_step(const Instant& now, double h, Memory m) const override;
  void add_mass(MatrixX& M, int phase) const override;
  std::vector<int> mass_changes() const override { return {phase_}; }
  double dissipated_power(const Instant& now, Memory m) const override;
  std::vector<Channel> channels() const override;
  void measure(const Instant& now, Memory m, std::span<double> out) const override;

 private:
  /// Of element i: 0 is `together`, the others follow.
  Memory memory(int i, Memory m) const;
  /// First and one past the last of the elements that act.
  int first(int phase) const { return phase < phase_ ? 0 : 1; }
  int end(int phase) const { return phase < phase_ ? 1 : static_cast<int>(elements_.size()); }

  std::vector<std::unique_ptr<const ForceElement>> elements_;
  std::vector<int> state_offset_, scratch_offset_;
  std::vector<std::size_t> channels_;  // how many each element has
  int state_size_ = 0, scratch_size_ = 0, phase_;
};

}  // namespace stillhook
