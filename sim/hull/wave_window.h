// The sea around one hull in a step: depth and pressure head at its vertices, linear in the hull's place.
//
// A step begins by choosing the pose that the hull is expected to reach; at its vertices the sea is looked up once,
// with its slopes, and serves every iterate and channel of the step:
//
//   h(x) = h(x0) + grad h(x0) (x - x0)        wrong by (k d)^2 / 2 of a wave, d = |x - x0|: micrometres
//
// By x0, and so by what the step began with, h changes by (k d) of its slope: that is left out of the tangent of a run.
// A hull further off than near_ takes the sea where it is.
//
// In seas of many components what is looked up are series (sim/sea/wave_expansion.h) at three instants one interval
// apart, each at the pose in which the hull was expected then. Poses and instants are part of the element's state, so
// that a state that is copied or stepped back gives the same forces; what was computed for them is kept in the scratch
// and made again when it does not belong to them.
#pragma once

#include "sim/multibody/force_element.h"
#include "sim/sea/wave_expansion.h"

namespace stillhook {

class WaveWindow {
 public:
  /// For a hull of so many vertices, none further than `radius` (m) from its centre of gravity.
  WaveWindow(std::shared_ptr<const WaveField> waves, std::size_t vertices, double radius);

  int state_size() const { return 2 * kMotionSize + (1 + (expansion_ ? kNodes : 0)) * kNodeSize; }
  int scratch_size() const;

  /// No poses yet.
  void start(std::span<double> state) const;
  /// Chooses the pose of the step from t to t + h; moves on with the instants of the series, or begins anew where the
  /// hull is not where it was expected.
  void begin_step(double t, double h, const BodyKinematics& body, std::span<double> state) const;

  /// Depth zeta - z into out.elevation and head into out.head (m) at the first r.rows() vertices, r (m) in B about C;
  /// with the head's slopes, and those of the elevation, when `gradients`. An empty out.head means that only the depth
  /// is wanted.
  /// Returns the largest elevation, up or down (m), at the vertices that were looked up.
  double sample(double t, const BodyKinematics& body, const Eigen::Ref<const MatrixX>& r, bool gradients, Memory m,
                const WaveSamples& out) const;

 private:
  // The state: the step's node, those of the series, the velocities at the beginning of the last two steps.
  static constexpr int kNodes = 3, kNodeSize = 13;  // t, p_WC, R_WB
  static constexpr int kMotionSize = 7;             // t, v_WC, w_B
  static constexpr int kLinear = 7;                 // values of a vertex in a step
  struct Node;
  struct Slot;
  Slot slot(double* at) const;
  Slot series_of(int node, Memory m, const Eigen::Ref<const MatrixX>& r) const;
  Slot linear_in(const double* node, Memory m, const Eigen::Ref<const MatrixX>& r) const;
  bool series_hold(double t, std::span<const double> state) const;
  void places(const Node& node, const Eigen::Ref<const MatrixX>& r, Memory m, std::span<double> (&x)[3]) const;
  double look_up(const Node& at, const Eigen::Ref<const MatrixX>& all, std::size_t first, Memory m,
                 const WaveSamples& out) const;

  std::shared_ptr<const WaveField> waves_;
  std::shared_ptr<const WaveExpansion> expansion_;  // in seas of many components
  std::size_t vertices_;
  double radius_, near_;  // m
};

}  // namespace stillhook
