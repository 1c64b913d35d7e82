// Radiation by a fitted state space: F(t) = -int_0^inf K(s) V(t - s) ds with K a sum of poles (state_space_fit.h).
//
//   z_k' = p_k z_k + V        F = -sum_k 2 Re(R_k z_k)        one complex vector z_k a pair of poles and block
//
// Each step is exact for V linear in the step, of whatever length h:
//
//   z(t + h) = e z(t) + g0 V(t) + g1 V(t + h),   e = exp(p h),  g1 = h phi2(p h),  g0 = h phi1(p h) - g1
//   phi1(x) = (exp(x) - 1)/x,   phi2(x) = (exp(x) - 1 - x)/x^2
//
// so the forces do not depend on how a motion of straight pieces is cut into steps, and the energy the model takes up,
// -int F.V dt, is that of the passive K itself: never negative after a start from rest. For equal steps the sampled
// model is passive too: its transfer matrix at w is sum_q K(i(w + 2 pi q/h)) sinc^2((w + 2 pi q/h) h/2), whose real
// part is positive semidefinite, so that sum_n F_n.V_n <= 0.
//
// Cost: some tens of states of two or three multiplications each. e, g0, g1 and D are kept in the scratch memory for
// the last h, which must therefore be this element's own (zeros at first); a new h costs one exponential a pole.
#pragma once

#include <vector>

#include "sim/hull/radiation/radiation.h"
#include "sim/hull/radiation/state_space_fit.h"

namespace stillhook {

class StateSpaceRadiation final : public Radiation {
 public:
  explicit StateSpaceRadiation(const StateSpaceFit& fit);

  bool same_as(const Radiation& other) const override;
  bool linear_in_state() const override { return true; }
  int state_size() const override { return state_size_; }
  int scratch_size() const override { return scratch_size_; }
  void start(std::span<const double> V, Memory m) const override;
  void begin_step(double h, Memory m, std::span<double> past, std::span<double> D) const override;
  void end_step(std::span<const double> V, double h, Memory m) const override;
  void force(std::span<const double> V, Memory m, std::span<double> F) const override;
  void instantaneous_damping(std::span<double> D) const override;

 private:
  /// Indices are into the flat arrays; everything of a block lies together.
  struct Block {
    int first_mode, size;   // into modes_
    int first_pole, poles;  // into poles_ and the propagators
    int state;              // z: for each pole the real parts of all modes, then the imaginary parts
    int residue;            // into residues_: for each pole Re (size x size), then Im; pairs doubled
    int D;                  // into the scratch: size x size
  };

  void prepare(double h, double* scratch) const;

  std::vector<Block> blocks_;
  std::vector<int> modes_;
  std::vector<Complex> poles_;
  std::vector<double> residues_;
  int state_size_, scratch_size_;
};

}  // namespace stillhook
