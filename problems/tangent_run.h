// A simulation of a case together with the derivatives of its channels with respect to case keys.
//
//   z(t; p), dz/dp_j     z  recorded channels, p_j  a numeric key of the case in its own unit
//
// The gradient of the search and the Jacobian of the fit both come from here. Any numeric key will do as long as it
// does not change what the lift is made of: the lift is built for the key a little larger and a little smaller, through
// statics and all, and tangent.h carries the difference through the run.
#pragma once

#include <optional>

#include "problems/case.h"
#include "sim/tangent.h"

namespace stillhook {

struct TangentRun;

struct TangentRequest {
  std::vector<std::string> keys;      // as in [plan.variables]; "*" moves several entries together
  std::vector<double> ranges;         // how far each key may move, in its unit; empty = max(|value|, 1)
  std::vector<std::string> channels;  // names of trajectory.h
  /// Changes a specification that was read (a scenario's sea), for the run and its twins alike; may be empty.
  std::function<Specification(const Specification&)> condition;
  /// Where the run begins instead of the model's initial state: its time is that of the run.
  std::optional<SystemState> from;
  /// Derivatives with respect to the initial state as well, as further columns after those of the keys, in the order
  /// of state_directions() (tangent.h).
  bool by_initial_state = false;
  /// Instead: how `from` changes, rows as state_directions(), a column for each key, then further columns of the
  /// derivatives. It is given the static poses and widths of the twins, and nothing else of the run.
  std::function<MatrixX(const TangentRun&)> start_change;
  double until = 0.0;         // s; 0 = as the case says
  OperationPart part;         // of the operation, from rest; the whole by default
  double growth_limit = 1e4;  // see TangentOptions
};

struct TangentRun {
  Trajectory trajectory;
  Tangents tangents;
  /// The static poses of the operation for a key half a width larger and smaller, [key][side], and the widths.
  std::vector<std::array<std::vector<StaticPose>, 2>> static_poses;
  std::vector<double> widths;
};

/// Runs the case with its keys as they stand. Throws CaseError for a key that does not exist or changes what the lift
/// is made of, SpecificationError for a channel that does not exist and when the lift cannot be built.
TangentRun run_with_tangents(const Case& c, const TangentRequest& request, const RunOptions& options = {});

}  // namespace stillhook
