// A simulation of a case together with the derivatives of its channels with respect to case keys.
//
//   z(t; p), dz/dp_j     z  recorded channels, p_j  a numeric key of the case in its own unit
//
// The gradient of the search and the Jacobian of the fit both come from here.
#pragma once

#include <optional>

#include "problems/case.h"
#include "sim/multibody/system.h"
#include "sim/simulate.h"

namespace stillhook {

struct TangentRequest {
  std::vector<std::string> keys;      // as in [plan.variables]; "*" moves several entries together
  std::vector<std::string> channels;  // names of trajectory.h
  /// Where the run begins instead of the model's initial state, and what it is: its time is that of the run.
  std::optional<SystemState> from;
  /// Derivatives with respect to the initial state as well, as further columns after those of the keys: 6 bodies of xi,
  /// 6 bodies of u, then the elements' states (see force_element.h).
  bool by_initial_state = false;
  double until = 0.0;  // s; 0 = as the case says
};

struct TangentRun {
  Trajectory trajectory;
  /// By channel of the request: samples (as trajectory.time) x columns.
  std::vector<Eigen::MatrixXd> tangent;
  SystemState end;              // the state that the run ended in
  Eigen::MatrixXd end_tangent;  // its change: rows as the columns of by_initial_state
  bool valid = false;           // false: the run failed, or its derivatives grew beyond use (slack and snap: chaos)
  double growth = 0.0;          // largest change of a body per range of a variable, m or rad; says why not valid
};

/// Runs the case with its keys as they stand. Throws CaseError for a key or channel that does not exist, and when the
/// lift cannot be built.
TangentRun run_with_tangents(const Case& c, const TangentRequest& request, const RunOptions& options = {});

}  // namespace stillhook
