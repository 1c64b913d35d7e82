// Runs through the phases of an operation: which phase it is, and where every drive stands.
//
// A phase starts when the one before it has ended, at a time that need not be a step, or, if it waits for a contact to
// be clear, when that has been clear for the wanted time: counted from the parting, which lies between two steps as
// well. So every start is a continuous function of the operation's numbers as long as the same things happen.
#pragma once

#include <vector>

#include "sim/operation.h"
#include "sim/recorder.h"

namespace stillhook {

class OperationClock {
 public:
  explicit OperationClock(const Operation& operation) : operation_(operation) {}

  /// Starts every phase that is due at time t (s). Opens them in the recorder.
  void advance(double t, Recorder& recorder);
  /// Before a step that ends at t (s): starts the phases that begin within it whatever happens in it, so that the drives
  /// at its end move already. Phases that wait for a contact follow after the step, in advance(), which opens them all in
  /// the recorder.
  void foresee(double t);
  /// How each phase so far was started.
  enum class Cause { time, event, timeout };
  struct Opening {
    double start;  // s
    Cause cause;
  };
  const std::vector<Opening>& openings() const { return openings_; }
  double phase_end() const { return phase_end_; }  // s
  /// The contact element that the next phase waits for, -1 if none.
  int awaited_contact() const;
  /// Starts the next phase at `start` (s), whatever the rules say.
  void open_next(double start, Cause cause = Cause::time);
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
  void record(Recorder& recorder);
  bool due(const Phase& next, double t, const Recorder& recorder, double& start, Cause& cause) const;

  const Operation& operation_;
  std::vector<Running> running_;  // and those that are over, which stand at their travel
  int phase_ = -1;
  std::vector<Opening> openings_;
  std::size_t recorded_ = 0;  // of them, in the recorder
  double phase_end_ = 0.0;  // s
};

}  // namespace stillhook
