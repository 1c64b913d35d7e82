// Natural modes of a lift about a static pose, undamped.
//
//   (K - w^2 M(w)) phi = 0     K = -Z^T (dQ/dxi) Z     M(w) = Z^T (M_rigid + A(w)) Z     C_q Z = 0
//
//   K  stiffness with everything at rest: hydrostatics, weights, wires and lines, contacts that touch, what the joints
//      carry (N/m, N m/rad)        A(w)  added mass of the hulls at the mode's own frequency (Ogilvie 1964)
//      Hulls that have parted keep the frequency's share of their coupled set, beside their own A_inf of that phase.
//   Z  orthonormal basis of the motions that the joints allow        w  rad/s
//
// Each mode is iterated by itself: w gives A(w), A(w) gives the mode nearest in shape to the last one, and its w.
// Damping, waves and the retardation of the radiation force beside A(w) are left out.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/model.h"

namespace stillhook {

struct Mode {
  double frequency = 0.0;  // rad/s; 0 for a motion without restoring stiffness
  double period = 0.0;     // s; infinite with frequency 0
  VectorX shape;           // 6 per body: displacement of the centre of gravity in W, turn in B; largest entry 1
  VectorX share;           // 6 per body: share of the kinetic energy in that coordinate; they sum to 1
  bool converged = true;   // the added mass is that of the mode's own frequency
  std::string label;       // the coordinates with the largest shares: "load x, crane pitch"
};

/// The modes of one model at any of its poses.
class ModalAnalysis {
 public:
  /// The model must outlive it.
  explicit ModalAnalysis(const Model& model);

  /// All modes at a state in static equilibrium (see solve_static), in the order of falling periods. The elements see
  /// calm water and the state's phase. `with_taglines` false: their stiffness is left out. It is that of a control
  /// which pulls to one side only, no spring.
  std::vector<Mode> at(const SystemState& equilibrium, bool with_taglines = true) const;
  /// Mass matrix of a phase with the hulls' added mass at a frequency (rad/s).
  MatrixX mass_at(double frequency, int phase = 0) const;

 private:
  struct Hull {
    int body = 0;
    Matrix3 R_WH = Matrix3::Identity();
  };

  const Model& model_;
  std::vector<Hull> hulls_;
};

/// The same for one state.
std::vector<Mode> natural_modes(const Model& model, const SystemState& equilibrium);

/// The period (s) of the mode that has the largest share of its kinetic energy in coordinate 0..5 (x, y, z, turns about
/// the body's x, y, z) of a body.
double period_of(const std::vector<Mode>& modes, int body, int coordinate);

}  // namespace stillhook
