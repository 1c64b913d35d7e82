// Samples of a run on their way out and back: a sink takes them while the run goes on, so that memory does not grow
// with its length; a source gives them back, channel by channel.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sim/trajectory.h"

namespace stillhook {

/// What is known about a run's samples before the first of them.
struct SampleForecast {
  double begin = 0.0;               // s, time of the first sample
  double interval = 0.0;            // s, from one sample to the next
  std::size_t expected = 0;         // samples, if the operation waits for no event
  std::vector<PhaseRecord> phases;  // names and stages of the phases to come; their times are not known yet
};

class SampleSink {
 public:
  virtual ~SampleSink() = default;
  /// Before the first sample; `run` has its channels and static poses.
  virtual void open(const Trajectory& run, const SampleForecast& forecast) = 0;
  /// The value of every channel at time t (s); `run` has the phases, extremes and contacts so far. May throw, which
  /// ends the run with that exception.
  virtual void add(const Trajectory& run, double t, std::span<const double> values) = 0;
};

class SampleSource {
 public:
  virtual ~SampleSource() = default;
  /// Samples of a channel, as many as the trajectory has times.
  virtual std::vector<double> series(std::size_t channel) const = 0;
};

/// Samples of a channel, wherever the trajectory has them; NaN if it has none.
std::vector<double> samples_of(const Trajectory& run, std::size_t channel);

}  // namespace stillhook
