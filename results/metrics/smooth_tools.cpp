#include "results/metrics/smooth_tools.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

/// Integral of f(sample) over a phase from start to end, the ends between samples by linear interpolation.
double window_integral(const RunView& view, std::size_t phase, const std::function<double(std::size_t)>& f) {
  const std::vector<double>& time = view.run().time;
  const PhaseRecord& record = view.run().phases[phase];
  double sum = 0.0;
  for (std::size_t i = 1; i < time.size(); ++i) {
    // A run whose end is moved by a gradient may end a little after its last sample.
    const double last = i + 1 == time.size() ? record.end : time[i];
    const double a = std::max(time[i - 1], record.start), b = std::min(last, record.end);
    if (!(b > a)) continue;
    const double length = time[i] - time[i - 1], f0 = f(i - 1), f1 = f(i);
    const double sa = (a - time[i - 1]) / length, sb = (b - time[i - 1]) / length;
    sum += (b - a) * (f0 + 0.5 * (sa + sb) * (f1 - f0));
  }
  return sum;
}

double length_together(const RunView& view, const Phases& phases) {
  double sum = 0.0;
  for (const std::size_t p : phases) sum += view.run().phases[p].end - view.run().phases[p].start;
  return sum;
}

/// By sample, with one sample beyond either end: the window may end between samples.
std::vector<double> tabulated_phase(const RunView& view, std::size_t phase, const ValueInPhase& f) {
  std::vector<double> values(view.run().time.size(), 0.0);
  RunView::Range range = view.samples(phase);
  if (range.first > 0) --range.first;
  range.last = std::min(range.last + 1, values.size());
  for (std::size_t i = range.first; i < range.last; ++i) values[i] = f(phase, i);
  return values;
}

}  // namespace

double window_mean(const RunView& view, const Phases& phases, const ValueInPhase& f) {
  double sum = 0.0;
  for (const std::size_t p : phases) sum += window_integral(view, p, [&](std::size_t i) { return f(p, i); });
  const double length = length_together(view, phases);
  return length > 0.0 ? sum / length : kNaN;
}

double soft_peak(const RunView& view, const Phases& phases, double sharpness, const ValueInPhase& f) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::size_t p : phases) {
    const RunView::Range range = view.samples(p);
    for (std::size_t i = range.first; i < range.last; ++i) {
      low = std::min(low, f(p, i));
      high = std::max(high, f(p, i));
    }
  }
  if (!(high > low)) return high;
  // The scale is rounded to a power of two, so that a small change of the run does not change it. So is the shift, to a
  // multiple of it: no more than one above the peak, or all exponentials of a peak with a small range would be zero.
  const double scale = std::exp2(std::ceil(std::log2(high - low))), s = sharpness / scale;
  const double shift = std::ceil(high / scale) * scale;
  const double mean =
      window_mean(view, phases, [&](std::size_t p, std::size_t i) { return std::exp(s * (f(p, i) - shift)); });
  return shift + std::log(mean) / s;
}

Tables tabulated(const RunView& view, const Phases& phases, const ValueInPhase& f) {
  Tables all(view.run().phases.size());
  for (const std::size_t p : phases) all[p] = tabulated_phase(view, p, f);
  return all;
}

double soft_positive(double x, double w) {
  if (x <= -w) return 0.0;
  if (x >= w) return x;
  return (x + w) * (x + w) / (4.0 * w);
}

std::optional<double> if_any(double value) { return std::isnan(value) ? std::nullopt : std::optional(value); }

}  // namespace stillhook
