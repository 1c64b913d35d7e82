// The sea around one hull between two instants, for hulls in seas of many components.
//
// A node is an instant and the pose in which the hull is expected then; at its vertices the sea is expanded once
// (sim/sea/wave_expansion.h). Two nodes, one interval apart, serve every step, iterate and channel between them. The
// nodes are part of the element's state, so that a state that is copied or stepped back gives the same forces; the
// series are kept in the scratch and are made again when they do not belong to the nodes.
#pragma once

#include "sim/multibody/force_element.h"
#include "sim/sea/wave_expansion.h"

namespace stillhook {

class WaveWindow {
 public:
  /// For a hull of so many vertices, none further than `radius` (m) from its centre of gravity.
  WaveWindow(std::shared_ptr<const WaveField> waves, std::size_t vertices, double radius);

  /// False in calm water and in seas of few components, which are cheap as they are: then nothing below is called.
  bool used() const { return expansion_ != nullptr; }
  int state_size() const { return used() ? 2 * kNodeSize : 0; }
  int scratch_size() const;

  /// No nodes yet.
  void start(std::span<double> state) const;
  /// Moves on, or begins anew where the hull is not where it was expected, so that the nodes hold the step t to t + h.
  void begin_step(double t, double h, const BodyKinematics& body, std::span<double> state) const;
  bool holds(double t, std::span<const double> state) const;

  /// The dynamic head (without the part -z) and elevation at the first r.rows() vertices, r (m) in B about C; as
  /// WaveField::sample otherwise.
  void sample(double t, const BodyKinematics& body, const Eigen::Ref<const MatrixX>& r, bool gradients, Memory m,
              const WaveSamples& out) const;

 private:
  static constexpr int kNodeSize = 13;  // t, p_WC, R_WB
  struct Node;
  struct Slot;
  Slot slot_of(const Node& node, const double* other, const Eigen::Ref<const MatrixX>& r,
               std::span<double> scratch) const;

  std::shared_ptr<const WaveExpansion> expansion_;
  std::size_t vertices_;
  double radius_;
};

}  // namespace stillhook
