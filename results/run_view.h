// A trajectory seen through its specification: channels by name, samples by phase, extremes over chosen phases, and
// the static path that the dynamic motion is measured from.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "sim/trajectory.h"

namespace stillhook {

/// A value and when it was reached (s); NaN until there is one.
struct Peak {
  double value = std::numeric_limits<double>::quiet_NaN();
  double time = std::numeric_limits<double>::quiet_NaN();

  bool valid() const { return value == value; }
  void take_larger(double v, double t) {
    if (v == v && !(value >= v)) *this = {v, t};
  }
  void take_smaller(double v, double t) {
    if (v == v && !(value <= v)) *this = {v, t};
  }
};

/// A static value on the way from one pose to the next. Without a value at one end it is that of the other.
struct StaticPath {
  double from = std::numeric_limits<double>::quiet_NaN(), to = std::numeric_limits<double>::quiet_NaN();
  /// By how far the phase has come, 0 to 1.
  double at(double progress) const { return from != from ? to : to != to ? from : from + (to - from) * progress; }
};

class RunView {
 public:
  using Stage = PhaseSpec::Stage;
  /// Sample indices [first, last).
  struct Range {
    std::size_t first = 0, last = 0;
    bool empty() const { return first >= last; }
  };

  /// Keeps references: both arguments must outlive the view.
  RunView(const Specification& specification, const Trajectory& trajectory);

  const Specification& specification() const { return specification_; }
  const Trajectory& run() const { return run_; }

  /// Index of a channel, -1 if there is none.
  int channel(const std::string& name) const;
  /// Samples of a channel; empty if there is no such channel or nothing was recorded. Those that the trajectory does
  /// not hold are read once from its source and kept with the view.
  std::span<const double> series(const std::string& name) const;
  /// Lets go of the samples that were read from the source: spans of series() before are void then.
  void forget() const;

  const std::vector<std::size_t>& all_phases() const { return all_phases_; }
  std::vector<std::size_t> phases_of(std::initializer_list<Stage> stages) const;
  /// Samples within a phase, both ends included.
  Range samples(std::size_t phase) const;
  /// Name of the phase at time t (s); empty outside the run.
  std::string phase_at(double t) const;
  double start() const;  // s
  double end() const;    // s

  /// Extremes of a channel over phases, from every step.
  Peak maximum(const std::string& name, const std::vector<std::size_t>& phases) const;
  Peak minimum(const std::string& name, const std::vector<std::size_t>& phases) const;
  Peak largest_magnitude(const std::string& name, const std::vector<std::size_t>& phases) const;

  /// Mean over time of f(sample) on a range, by the trapezoidal rule; NaN for fewer than two samples.
  template <class F>
  double mean(Range range, F f) const;
  /// Integral over time of f(sample) on a range, by the trapezoidal rule.
  template <class F>
  double integral(Range range, F f) const;

  /// Value of a channel in static pose `pose` (0 = start, i + 1 = end of phase i); NaN if there is none.
  double static_value(std::size_t pose, const std::string& name) const;
  /// Static value during a phase at time t (s) for a hanging load, see metrics.h; NaN if there is none.
  double static_at(std::size_t phase, double t, const std::string& name) const;
  /// The same over the whole phase, for many instants.
  StaticPath static_path(std::size_t phase, const std::string& name) const;
  /// True if the load hangs in static pose `pose`: it rests on no pickup and no target.
  bool hangs(std::size_t pose) const;
  /// Static value on the way from one pose to the next, resting or not; NaN if there is none.
  double planned_at(std::size_t phase, double t, const std::string& name) const;
  /// How far the drives of a phase have come at time t, 0 to 1.
  double progress(std::size_t phase, double t) const;

 private:
  double sample_at(std::span<const double> values, double t) const;

  const Specification& specification_;
  const Trajectory& run_;
  std::unordered_map<std::string, int> index_;
  mutable std::unordered_map<int, std::vector<double>> read_;  // from the source, by channel
  std::unordered_map<int, std::vector<double>> kept_;          // of these, what the view itself needs throughout
  std::vector<std::size_t> all_phases_;
  struct MovingDrive {
    std::span<const double> position;
    double from = 0.0, to = 0.0;
  };
  std::vector<std::vector<MovingDrive>> moving_;  // by phase
  std::vector<bool> hangs_;                       // by static pose
};

template <class F>
double RunView::integral(Range range, F f) const {
  double sum = 0.0;
  if (range.empty()) return sum;
  double before = f(range.first);
  for (std::size_t i = range.first + 1; i < range.last; ++i) {
    const double now = f(i);
    sum += 0.5 * (before + now) * (run_.time[i] - run_.time[i - 1]);
    before = now;
  }
  return sum;
}

template <class F>
double RunView::mean(Range range, F f) const {
  if (range.last < range.first + 2) return std::numeric_limits<double>::quiet_NaN();
  const double span = run_.time[range.last - 1] - run_.time[range.first];
  return span > 0.0 ? integral(range, f) / span : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace stillhook
