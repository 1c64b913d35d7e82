// Linear frequency response of a lift about a static pose: response amplitude operators.
//
//   Z^T [ -w^2 (M + T^T A(w) T) - i w (D + T^T B(w) T) + K ] Z y = Z^T T^T X(w, b),    xi = Z y,    C_q Z = 0
//
//   xi     complex displacement of each centre of gravity (W) and turn (B) in a wave of unit amplitude,
//          Re[xi exp(-i w t)]; the crest passes the origin of W at t = 0            m/m, rad/m
//   M      rigid bodies        K = -dQ/dxi, D = -dQ/du of everything at rest: hydrostatics, weights, wires, lines,
//          contacts that touch, constant damping, the linear part of viscous damping; constraint forces in K
//   A, B   added mass and radiation damping of the hulls; X total first-order excitation (coefficients.h), about each
//          hull's reference point in its heading frame, T: heading_frame.h
//
// A vessel that moves by displacement RAOs (rao_table.h) answers with those: xi = Z y + x_p with the motion x_p of all
// bodies that its joints carry along, and Z^T [...] x_p on the right.
//
// Waves and X_FK are those of the case's depth, A, B and X_D those of the depth of the coefficient set; of X_D of a set
// of deep water where waves feel the bed see diffraction.h.
//
// A hull without a coefficient set is excited by the linear Froude-Krylov force alone. Quadratic damping, wires that
// go slack, friction and the lag of tagline winches are left out. A phase is a lag: a motion with phase p peaks p/w
// after the crest has passed. (Newman 1977, ch. 6; Faltinsen 1990, ch. 3)
#pragma once

#include <memory>
#include <vector>

#include "sim/hull/diffraction.h"
#include "sim/model.h"

namespace stillhook {

/// The answer to one wave of unit amplitude.
struct ResponseAmplitude {
  using Vector6c = Eigen::Matrix<Complex, 6, 1>;

  double frequency = 0.0;      // rad/s
  double heading = 0.0;        // rad, the waves travel towards it, in W
  std::vector<Vector6c> body;  // by body index: displacement of C in W (m/m), turn in B (rad/m); crest at W's origin
};

class LinearResponse {
 public:
  /// About `equilibrium`, a state in static equilibrium (see solve_static); the elements see calm water and the state's
  /// phase. The model must outlive this. Throws SpecificationError for a set whose headings do not go round.
  LinearResponse(const Model& model, const SystemState& equilibrium);
  explicit LinearResponse(const Model& model) : LinearResponse(model, model.initial_state()) {}
  ~LinearResponse();
  LinearResponse(LinearResponse&&) noexcept;

  /// Where all hulls have coefficients, rad/s: {0, infinity} when none has a set.
  double lowest_frequency() const { return lowest_; }
  double highest_frequency() const { return highest_; }
  /// The sets know a wave of this frequency (rad/s) and heading (rad, W).
  bool resolves(double frequency, double heading) const;

  /// Throws std::invalid_argument for a wave that is not resolved.
  ResponseAmplitude at(double frequency, double heading) const;

  /// Surge, sway, heave (m/m) and roll, pitch, yaw (rad/m) of the point p_B (m, in B) of a body, along the axes of the
  /// body's heading frame. The crest passes the point's mean position at t = 0.
  ResponseAmplitude::Vector6c motion(const ResponseAmplitude& response, int body, const Vector3& p_B) const;

 private:
  struct Group;
  struct SeaMoved;

  void add_sea_moved();
  MatrixX potential_mass(double frequency) const;     // T^T A T of all
  MatrixX potential_damping(double frequency) const;  // T^T B T of the sets
  Eigen::VectorXcd excitation(double frequency, double heading) const;
  Eigen::VectorXcd carried(double frequency, double heading) const;  // x_p

  const Model& model_;
  SystemState state_;
  std::vector<Group> groups_;
  std::vector<SeaMoved> moved_;
  MatrixX mass_, damping_, stiffness_, Z_, C_q_;
  double gravity_ = 0.0, depth_ = 0.0, lowest_ = 0.0, highest_ = 0.0;
};

}  // namespace stillhook
