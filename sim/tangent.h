// A simulation together with its tangent: the derivatives of what it records with respect to parameters of the model
// and the operation, or to its initial state. hht_tangent.h has the mathematics.
//
// A phase that waits for a contact to be clear moves with the time of the parting: the derivative of that time follows
// from the gap at the two steps on either side. Whether a line is connected or a contact acts is decided step by step
// by the phase, so the jump of such a switch does not move in time.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "sim/multibody/hht_tangent.h"
#include "sim/simulate.h"

namespace stillhook {

/// One parameter p: the lift built for p - width/2 and p + width/2.
struct LiftTwin {
  std::array<std::shared_ptr<const Model>, 2> model;
  std::array<std::shared_ptr<const Operation>, 2> operation;
  /// Where the run begins, of either side; null: as its model.
  std::array<std::shared_ptr<const SystemState>, 2> from;
  double width = 1.0;  // in the parameter's unit
  double range = 1.0;  // how far the parameter may move: the measure of growth
};

struct TangentOptions {
  std::vector<std::string> channels;  // names of trajectory.h
  /// Further directions after the twins: every coordinate of the initial state, in the order of state_directions().
  bool by_initial_state = false;
  /// How the given initial state changes, rows as state_directions(): a column for each twin, then further directions.
  /// Empty: it does not change. For a run that starts elsewhere than its
  /// models and twins, without by_initial_state.
  MatrixX start_change;
  /// A body that moves by more than this (m or rad) for the range of a parameter: chaos of snap loads, not a gradient.
  double growth_limit = 1e4;
};

/// Derivatives per unit of each parameter; p directions.
struct Tangents {
  std::vector<int> channels;    // indices in Trajectory::channels
  std::vector<MatrixX> values;  // [channel of the request] samples x p
  struct OfExtreme {
    VectorX min, max;  // of Extreme::min and max, p
  };
  std::vector<std::vector<OfExtreme>> extremes;  // [phase][channel of the request]
  std::vector<VectorX> phase_start, phase_end;   // [phase] p, s per unit
  SystemState end;                               // the state that the run ended in
  MatrixX end_state;                             // its change: rows as state_directions(), p columns
  bool valid = false;
  double growth = 0.0;  // largest motion of a body for the range of a parameter, m or rad
};

/// Number of coordinates of an initial state: 6 bodies of xi, 6 bodies of u, the elements' states.
int state_directions(const MultibodySystem& system);

/// As simulate(); `tangents` belongs to the trajectory that is returned, and is not valid when that is not completed.
/// Throws SpecificationError for a channel that does not exist, std::invalid_argument for a twin of another make.
Trajectory simulate_with_tangents(const Model& model, const Operation& operation, const RunOptions& options,
                                  const std::vector<LiftTwin>& twins, const TangentOptions& wanted, Tangents& tangents);

}  // namespace stillhook
