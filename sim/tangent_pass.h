// What a run calls to carry its tangent along.
#pragma once

#include "sim/operation_clock.h"
#include "sim/recorder.h"
#include "sim/tangent.h"

namespace stillhook {

class TangentPass {
 public:
  TangentPass(const Model& model, HhtStepper& stepper, const std::vector<LiftTwin>& twins, const TangentOptions& wanted,
              const Trajectory& run, Tangents& out, bool started_elsewhere);

  /// The stepper has been started at `state`.
  void start(const SystemState& state);
  /// The clock may have opened phases.
  void follow(const OperationClock& clock);
  void begin_step(const SystemState& state) { hht_->begin(state); }
  void end_step(SystemState& state, double h);
  /// Everything of this instant has been recorded. Returns false when the growth is beyond use.
  bool note(SystemState& state, double h, const Recorder& recorder, const OperationClock& clock, bool sample);
  void close(const SystemState& state, bool completed);

 private:
  using Source = ChannelBoard::Source;
  struct Part {
    Source source;
    int index;
    std::vector<int> wanted;    // places in the request: rows of the slopes
    std::vector<int> channels;  // of the board, one for each
    bool due = true;            // at this instant
    Branches branches;          // of the law at the state that is differentiated
  };
  struct Lift {  // one side of a twin
    std::unique_ptr<ChannelBoard> board;
    std::unique_ptr<SystemWorkspace> work;
    std::unique_ptr<OperationClock> clock;
  };

  int directions() const { return hht_->directions(); }
  bool has_twin(int j) const { return j < static_cast<int>(twins_.size()); }
  void choose_parts(const std::vector<std::string>& channels);
  std::vector<std::array<SystemState, 2>> starts(const SystemState& base, std::vector<SystemTwin>& systems);
  std::array<SystemState, 2> moved_both_ways(const SystemState& base, const VectorX& change, double width) const;
  void drives_at(double t);
  bool depends_directly(int j, const Part& part) const;
  /// Fills `out` (rows as the parts that are due say, x directions).
  void differentiate(std::span<Part> parts, SystemState& state, MatrixX& out);
  void watch_gap(SystemState& state, double h, const Recorder& recorder, const OperationClock& clock);

  const Model& model_;
  HhtStepper& stepper_;
  const std::vector<LiftTwin>& twins_;
  const TangentOptions& wanted_;
  const Trajectory& run_;
  const bool started_elsewhere_;  // at a given state instead of the models' own
  Tangents& out_;

  std::unique_ptr<HhtTangent> hht_;
  std::vector<std::array<Lift, 2>> lifts_;  // [twin]
  HhtTangent::TwinDrives drives_before_, drives_;
  ChannelBoard board_;
  SystemWorkspace work_;
  std::vector<Part> parts_;
  MatrixX slope_, gap_slope_;
  std::vector<std::vector<double>> samples_;  // [channel] p numbers a sample
  SystemState moved_;

  std::optional<Part> gap_;  // of the contact that the next phase waits for
  double last_gap_ = 0.0;
  VectorX last_gap_slope_, parted_slope_, end_slope_;
  int phases_open_ = 0;
  VectorX range_;
};

}  // namespace stillhook
