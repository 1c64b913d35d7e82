#include "sim/operation_clock.h"

#include <algorithm>

namespace stillhook {

bool OperationClock::due(const Phase& next, double t, const Recorder& recorder, double& start, Cause& cause) const {
  if (t < phase_end_) return false;
  start = phase_end_;
  cause = Cause::time;
  if (next.wait_for.type == EventSpec::Type::none) return true;
  const double clear_from = recorder.parted_at(next.wait_contact) + next.wait_for.hold;
  if (clear_from <= t) {
    if (clear_from > phase_end_) {
      start = clear_from;
      cause = Cause::event;
    }
    return true;
  }
  start = phase_end_ + next.wait_for.timeout;
  cause = Cause::timeout;
  return t >= start;
}

int OperationClock::awaited_contact() const {
  const std::size_t next = static_cast<std::size_t>(phase_ + 1);
  if (next >= operation_.phases.size()) return -1;
  const Phase& phase = operation_.phases[next];
  return phase.wait_for.type == EventSpec::Type::none ? -1 : phase.wait_contact;
}

void OperationClock::open_next(double start, Cause cause) {
  const Phase& next = operation_.phases[static_cast<std::size_t>(++phase_)];
  openings_.push_back({start, cause});
  phase_end_ = start + next.duration;
  for (const Move& move : next.moves) running_.push_back({&move, start + move.delay});
}

void OperationClock::record(Recorder& recorder) {
  for (; recorded_ < openings_.size(); ++recorded_) {
    const Phase& phase = operation_.phases[recorded_];
    const Opening& opening = openings_[recorded_];
    recorder.open_phase(phase.name, phase.stage, opening.start, opening.cause == Cause::timeout);
  }
}

void OperationClock::advance(double t, Recorder& recorder) {
  record(recorder);
  while (phase_ + 1 < static_cast<int>(operation_.phases.size())) {
    const Phase& next = operation_.phases[phase_ + 1];
    double start = 0.0;
    Cause cause = Cause::time;
    if (!due(next, t, recorder, start, cause)) return;
    open_next(start, cause);
    record(recorder);
  }
}

void OperationClock::foresee(double t) {
  while (phase_ + 1 < static_cast<int>(operation_.phases.size()) && awaited_contact() < 0 && t >= phase_end_)
    open_next(phase_end_);
}

void OperationClock::drives_at(double t, std::span<DriveState> out) const {
  for (DriveState& d : out) d = {0.0, 0.0};
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
