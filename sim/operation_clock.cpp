#include "sim/operation_clock.h"

#include <algorithm>

namespace stillhook {

OperationClock::OperationClock(const Operation& operation, int drives) : operation_(operation), base_(drives, 0.0) {}

bool OperationClock::due(const Phase& next, double t, const Recorder& recorder, double& start, bool& timed_out) const {
  if (t < phase_end_) return false;
  start = phase_end_;
  timed_out = false;
  if (next.wait_for.type == EventSpec::Type::none) return true;
  start = t;
  if (recorder.clear_for(next.wait_contact, t) >= next.wait_for.hold) return true;
  timed_out = t >= phase_end_ + next.wait_for.timeout;
  return timed_out;
}

void OperationClock::advance(double t, Recorder& recorder) {
  while (phase_ + 1 < static_cast<int>(operation_.phases.size())) {
    const Phase& next = operation_.phases[phase_ + 1];
    double start = 0.0;
    bool timed_out = false;
    if (!due(next, t, recorder, start, timed_out)) return;
    ++phase_;
    phase_end_ = start + next.duration;
    for (const Move& move : next.moves) running_.push_back({&move, start + move.delay});
    recorder.open_phase(next.name, next.stage, start, timed_out);
    std::erase_if(running_, [&](const Running& r) {
      if (r.start + r.move->profile.duration() > start) return false;
      base_[r.move->drive] += r.move->profile.travel();
      return true;
    });
  }
}

void OperationClock::drives_at(double t, std::span<DriveState> out) const {
  for (std::size_t d = 0; d < out.size(); ++d) out[d] = {base_[d], 0.0};
  for (const Running& r : running_) {
    DriveState& d = out[r.move->drive];
    d.position += r.move->profile.position(t - r.start);
    d.rate += r.move->profile.rate(t - r.start);
  }
}

bool OperationClock::finished(double t) const {
  return phase_ + 1 >= static_cast<int>(operation_.phases.size()) && t >= phase_end_;
}

double OperationClock::expected_end(double t) const {
  double end = std::max(phase_end_, t);
  for (std::size_t i = phase_ + 1; i < operation_.phases.size(); ++i) end += operation_.phases[i].duration;
  return end;
}

}  // namespace stillhook
