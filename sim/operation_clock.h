// Runs through the phases of an operation: which phase it is, and where every drive stands.
#pragma once

#include <vector>

#include "sim/operation.h"
#include "sim/recorder.h"

namespace stillhook {

/// Phases follow one another without a gap, at times that need not be steps; only a phase that waits for an event
/// starts at the step that saw it.
class OperationClock {
 public:
  OperationClock(const Operation& operation, int drives);

  /// Starts every phase that is due at time t (s). Opens them in the recorder.
  void advance(double t, Recorder& recorder);
  /// Drive positions and rates at time t, for the moves started so far.
  void drives_at(double t, std::span<DriveState> out) const;

  /// Index of the running phase (the last one while a phase waits).
  int phase() const { return phase_; }
  /// True from the end of the last phase on.
  bool finished(double t) const;
  /// When the operation will end if no further event is waited for, s.
  double expected_end(double t) const;

 private:
  struct Running {
    const Move* move;
    double start;  // s
  };
  bool due(const Phase& next, double t, const Recorder& recorder, double& start, bool& timed_out) const;

  const Operation& operation_;
  std::vector<double> base_;  // positions reached by the moves that are over
  std::vector<Running> running_;
  int phase_ = -1;
  double phase_end_ = 0.0;    // s
};

}  // namespace stillhook
