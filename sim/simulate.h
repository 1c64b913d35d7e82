// Runs an operation on a model.
#pragma once

#include <functional>

#include "sim/model.h"
#include "sim/operation.h"
#include "sim/samples.h"
#include "sim/trajectory.h"

namespace stillhook {

struct RunOptions {
  /// Called about every 5 s of simulated time with t and the planned end (s); returning false interrupts the run.
  std::function<bool(double t, double t_end)> progress;
  /// Keep samples (values) at specification.solver.output_interval; extremes and contacts are kept always.
  bool record = true;
  /// Takes the samples instead of the trajectory, whose `time` and `values` then stay empty.
  SampleSink* sink = nullptr;
  /// Where the run begins instead of the model's initial state, at its time; must outlive the run.
  const SystemState* from = nullptr;
  double until = 0.0;  // s, the run ends there at the latest; 0 = as the specification says
};

/// Never throws for numerical trouble: a run that diverges ends with RunStatus::diverged and says where. The same
/// model, operation and options give the same bits.
Trajectory simulate(const Model& model, const Operation& operation, const RunOptions& options = {});

}  // namespace stillhook
