// Tangent of the steps of hht.h: how a run changes when the parameters of its model, its drives or its start change.
//
// At a converged step every quantity is a function of the unknowns a1, lambda1, of what the step began with, and of
// the parameters p. With a dash for the derivative along one direction and K, C the derivatives of the forces,
//
//   M a1'/(1+al) - K xi1 - C u1 + C_q^T lambda1' = E - al/(1+al) F0' - M' a1/(1+al)        C_q xi1 = -C'
//   xi1, u1: the derivatives of the update formulas, R1 = R0 exp(turn) => theta1 = exp(-turn) theta0 + J_r(turn) turn'
//
// whose matrix is the one of Newton's method (implicit function theorem). It is assembled and factorised anew at the
// converged state and solved for all directions at once. E holds what does not go through a1: what a changed beginning
// does to elements with a history (they say so themselves, or central differences of the element alone are taken) and
// the elements' own parameters and drives: these by central differences between a pair of elements built for
// p + width/2 and p - width/2, at the same state. That difference is of one force law, not of a run: its error, of
// second order in the width, is neither amplified by the integration nor blurred by the tolerance of Newton's method.
// Both elements of a pair follow the branches that the base's own takes in the step (branches.h), as K and C do: a wire
// that is taut by less than the pair's width would else be pulled by half of its stiffness, against all of it in K.
// (Serban & Hindmarsh 2005 for the method; Bruls & Eberhard 2008 for multibody systems.)
//
// Causality saves work: a direction has a column only from the step on in which it first changes anything, such as the
// speed of a later phase, or the gain of a line that is not connected yet.
//
// The forces of wires, contacts, taglines and moorings are continuous at their kinks, so nothing jumps when the run
// passes one. Where a law does jump (at the edge of a contact's rectangle, when a line is connected) the derivative is
// that of the branch the run took, and the instant of the jump is taken not to move.
#pragma once

#include <array>

#include "sim/multibody/hht.h"

namespace stillhook {

/// One direction: a parameter p of the model, given by the systems built for p - width/2 and p + width/2 (they must
/// outlive the tangent), or by no systems: a direction of the initial state alone.
struct SystemTwin {
  std::array<const MultibodySystem*, 2> system = {nullptr, nullptr};
  double width = 1.0;  // in the parameter's unit
};

/// Derivatives of a state per unit of the parameters, a column each direction that has changed anything yet.
struct StateTangent {
  BodyChange body;
  MatrixX acceleration, jerk, F0;  // as SystemState::acceleration and the members of HhtStepper
  MatrixX lambda;
  MatrixX element_state;
};

class HhtTangent {
 public:
  /// Throws std::invalid_argument if a twin has other elements, joints or rows than the stepper's system: a change of
  /// its parameter then changes what the lift is made of.
  HhtTangent(HhtStepper& stepper, std::vector<SystemTwin> twins);

  int directions() const { return static_cast<int>(twins_.size()); }
  /// Column c belongs to direction live()[c]; the directions that are not there have changed nothing yet.
  const StateTangent& tangent() const { return now_; }
  const std::vector<int>& live() const { return live_; }
  /// Derivatives of the state, rows (xi, u, element states), a column each direction.
  MatrixX state_change() const;
  const SystemTwin& twin(int j) const { return twins_[j].of; }
  /// True if the forces of this element of direction j differ from the base's.
  bool differs(int j, int element) const;

  /// Derivative of the start: `starts` are the twins' initial states, those of one direction after the other. The
  /// stepper must have been started at `base`.
  void start(const SystemState& base, std::vector<std::array<SystemState, 2>> starts);

  /// Once before each step of the stepper.
  void begin(const SystemState& state);
  /// Once after it, with the state it reached; `drives`: where the twins' drives stand at that instant, and stood
  /// before the step, [direction][side].
  using TwinDrives = std::vector<std::array<std::vector<DriveState>, 2>>;
  void end(SystemState& state, double h, const TwinDrives& drives_before, const TwinDrives& drives);

  /// Largest change of a body, m or rad, of all directions, that of direction j times scale[j].
  double growth(const VectorX& scale) const;

  /// The state moved along direction j by `by` (in the parameter's unit): bodies, element states and lambda; drives are
  /// left.
  void displaced(const SystemState& state, int j, double by, SystemState& out) const;
  /// A length `by` for displaced() that moves no body by more than this share of a metre or radian.
  double small_step(int j) const;

 private:
  struct Twin {
    SystemTwin of;
    std::vector<int> elements;  // that differ
    bool bodies = false, joints = false, mass = false;
    std::array<std::vector<double>, 2> scratch;  // of all elements; empty if none differs
  };
  using SideDrives = std::array<std::vector<DriveState>, 2>;

  /// What changes at a step without going through the unknowns, of one direction.
  struct Explicit {
    VectorX force, constraint, state;  // E, C', of the elements' states by their own parameters
    bool any = false;                  // of them is not zero
  };
  /// Those that the base's element took in this step.
  struct Taken {
    Branches branches;
    bool known = false;
  };
  /// How the force of an element changes with its drives.
  struct ByDrives {
    struct Derivative {
      VectorX position, rate;
    };
    std::vector<Derivative> derivatives;  // in the order of its drives
    bool known = false;                   // in this step
  };

  static Twin compare(const MultibodySystem& base, const SystemTwin& twin);
  void keep_columns(const std::vector<int>& directions);
  void wake();
  void follow_mass();
  void predict(double h);
  void solve(const SystemState& middle, double h);

  void add_history(double h);
  void history_by_differences(double h);
  void add_explicit(double h, const TwinDrives& before, const TwinDrives& now);
  void add_element(int element, int j, double h, const SideDrives& before, const SideDrives& now);
  void add_drive(int element, int j, double h, const SideDrives& now);
  void step_along(const ForceElement& of, int element, double h, std::span<const DriveState> before,
                  std::span<const DriveState> now, std::vector<double>& scratch);
  void find_branches(int element, double h);
  const ByDrives& by_drives(int element, double h);
  void add_bodies(int j);
  void advance_states(double h);
  void states_by_differences(double h);
  void begin_displaced(Eigen::Index column, double by, double h);
  double differences_by(Eigen::Index column, const BodyChange& bodies) const;

  HhtStepper& stepper_;
  const MultibodySystem& system_;
  std::vector<Twin> twins_;
  const MatrixX* mass_ = nullptr;  // of phase_
  int phase_ = 0;
  double last_h_ = 0.0;  // the stepper's, before the step

  std::vector<int> live_;    // the direction of every column
  std::vector<int> column_;  // the column of every direction, -1: it is zero
  StateTangent now_;
  BodyChange from_;                 // of the bodies at the beginning of the step
  MatrixX a_start_;                 // of the acceleration that the step starts from
  std::vector<Explicit> explicit_;  // [direction]
  std::vector<ByDrives> by_drives_;  // [element]
  std::vector<Taken> taken_;        // [element]
  std::vector<int> driven_;         // elements with drives
  std::vector<DriveState> drives_;
  VectorX low_force_;              // of an element, on a twin's lower side
  std::vector<double> low_state_;  // of all elements
  MatrixX E_;                      // forces that do not go through a1
  MatrixX constraint_;             // C'
  MatrixX rhs_, y_;
  SystemState before_, middle_, displaced_;
  std::vector<BodyKinematics> to_;
  std::vector<double> scratch_;
  std::vector<bool> of_history_;  // by entry of the elements' states
  std::vector<int> differenced_;  // elements that do not offer their own tangents
  VectorX change_;
  ForceSum forces_;
};

/// The bodies moved along column j by `by`.
void displace_bodies(const BodyChange& change, Eigen::Index j, double by, std::vector<BodyKinematics>& bodies);

}  // namespace stillhook
