// Radiation by retardation functions: F(t) = -int_0^inf K(s) V(t - s) ds, for steps of any length.
//
// The history is kept on the kernels' own grid (nodes t_g = t_0 + g * interval), whatever the steps are, because a
// convolution over steps that vary would need its weights anew each time. With V linear between nodes and K linear
// between samples the convolution at a node is a sum with constant weights. Between nodes the force has three parts:
//
//   history up to the last node t_g   I_q(g) = int K(q interval + s) V(t_g - s) ds at shifts q = 0, 1, ...; linear
//                                     interpolation in the shift (t - t_g)/interval. I_0 and I_1 are kept; I_0 at the
//                                     next node is the old I_1 plus one cell, so each node costs one convolution,
//                                     however many steps lie between two nodes.
//   from t_g to the start of the step int V ds and int V (s - t_g) ds, summed exactly, against K linear in between
//   the step itself                   int_0^h K(s) [V_n s/h + V_new (1 - s/h)] ds, exact; its V_new part is the D of
//                                     the interface
//
// Each part is exact for V constant and second order in interval and h. Steps may be shorter or longer than interval.
// A motion that starts with a velocity is taken to have gained it evenly over the interval before its start.
#pragma once

#include <vector>

#include "sim/hull/coefficients/coefficients.h"
#include "sim/hull/radiation/radiation.h"

namespace stillhook {

class RadiationMemory final : public Radiation {
 public:
  /// Kernels as they are to be used (see truncated()); modes = 6 per hull. At least one kernel, interval > 0.
  RadiationMemory(const RetardationFunctions& kernels, int modes);

  bool same_as(const Radiation& other) const override {
    const auto* o = dynamic_cast<const RadiationMemory*>(&other);
    return o && o->interval_ == interval_ && o->pairs_ == pairs_;
  }
  bool linear_in_state() const override { return true; }
  int clock_size() const override { return 2; }
  int state_size() const override { return layout_.size; }
  void start(std::span<const double> V, Memory m) const override;
  void begin_step(double h, Memory m, std::span<double> past, std::span<double> D) const override;
  void end_step(std::span<const double> V, double h, Memory m) const override;
  void force(std::span<const double> V, Memory m, std::span<double> F) const override;
  void instantaneous_damping(std::span<double> D) const override;

 private:
  struct Pair {
    int i, j;
    std::vector<double> K;        // samples, newest first
    std::vector<double> weights;  // of I_1, oldest first: weights.back() belongs to the node t_g
    double cell_new, cell_old;    // int over one interval of K against the falling and the rising line
    bool operator==(const Pair&) const = default;
  };
  /// Where things lie in the state. Forces, at_node and at_next, are kept as multiples of force_unit_, so that all of
  /// it is of the order of a motion and small differences of states can be taken with one width.
  struct Layout {
    int head, offset, sum, moment, at_node, at_next, velocity, ring, size;
  };

  double kernel(const Pair& pair, double time) const;
  double sample(const Pair& pair, int m) const;
  void cell_integrals(const Pair& pair, double h, double& of_new, double& of_old) const;
  double convolve(const Pair& pair, const double* state) const;
  double convolve_shifted(const Pair& pair, const double* state, int shift) const;
  /// I_f of mode i, f in 0 .. 1, from the two that are kept.
  double stored_force(const double* state, int i, double f) const;
  double history_far_ahead(const Pair& pair, const double* state, double u) const;
  void add_node(const double* V, double* state) const;

  double interval_;
  int capacity_;                    // nodes in the ring
  std::vector<double> force_unit_;  // N/m ..., the largest K of a mode
  std::vector<Pair> pairs_;
  Layout layout_;
};

}  // namespace stillhook
