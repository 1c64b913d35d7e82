#include "results/smooth_metrics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "results/load_path.h"
#include "results/run_view.h"
#include "sim/crane_parts.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

using Stage = PhaseSpec::Stage;

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

double length_of(const RunView& view, const std::vector<std::size_t>& phases) {
  double sum = 0.0;
  for (const std::size_t p : phases) sum += view.run().phases[p].end - view.run().phases[p].start;
  return sum;
}

/// Mean over the phases.
double window_mean(const RunView& view, const std::vector<std::size_t>& phases,
                   const std::function<double(std::size_t phase, std::size_t sample)>& f) {
  double sum = 0.0;
  for (const std::size_t p : phases) sum += window_integral(view, p, [&](std::size_t i) { return f(p, i); });
  const double length = length_of(view, phases);
  return length > 0.0 ? sum / length : kNaN;
}

/// The log-sum-exp of f over the phases.
double soft_peak(const RunView& view, const std::vector<std::size_t>& phases, double sharpness,
                 const std::function<double(std::size_t phase, std::size_t sample)>& f) {
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

struct HoistWires {
  std::vector<std::string> names;
  explicit HoistWires(const Specification& s) {
    for (const WireSpec& w : s.wires)
      if (w.role == WireSpec::Role::hoist) names.push_back(w.name);
  }
};

/// By sample, computed once: f is asked for again and again.
std::vector<double> tabulated(const RunView& view, std::size_t phase,
                              const std::function<double(std::size_t sample)>& f) {
  std::vector<double> values(view.run().time.size(), 0.0);
  RunView::Range range = view.samples(phase);
  // One sample beyond either end: the window may end between samples.
  if (range.first > 0) --range.first;
  range.last = std::min(range.last + 1, values.size());
  for (std::size_t i = range.first; i < range.last; ++i) values[i] = f(i);
  return values;
}

using Tables = std::vector<std::vector<double>>;  // [phase][sample]

Tables tables(const RunView& view, const std::vector<std::size_t>& phases,
              const std::function<double(std::size_t phase, std::size_t sample)>& f) {
  Tables all(view.run().phases.size());
  for (const std::size_t p : phases) all[p] = tabulated(view, p, [&](std::size_t i) { return f(p, i); });
  return all;
}

/// Swing relative to the static offset, mean of the hoist wires, m.
Tables swing(const RunView& view, const std::vector<std::size_t>& phases, const char* axis) {
  const HoistWires hoist(view.specification());
  return tables(view, phases, [&](std::size_t p, std::size_t i) {
    double sum = 0.0;
    for (const std::string& wire : hoist.names)
      sum += view.series(wire + axis)[i] - view.static_at(p, view.run().time[i], wire + axis);
    return sum / static_cast<double>(hoist.names.size());
  });
}

std::optional<double> smooth_sway(const RunView& view, const std::string& name, const SmoothOptions& options) {
  const std::size_t dot = name.find('.');
  std::vector<std::size_t> phases = view.phases_of({Stage::hanging});
  if (dot != std::string::npos) {
    phases.clear();
    for (std::size_t p = 0; p < view.run().phases.size(); ++p)
      if (const PhaseRecord& phase = view.run().phases[p];
          phase.name == name.substr(dot + 1) && (phase.stage == Stage::hanging || phase.stage == Stage::set_down))
        phases.push_back(p);
  }
  if (phases.empty()) return std::nullopt;
  const std::string stem = name.substr(0, dot);
  const bool peak = stem == "sway_peak";
  const Tables x = stem == "sway_y_rms" ? Tables{} : swing(view, phases, ".offset_x");
  const Tables y = stem == "sway_x_rms" ? Tables{} : swing(view, phases, ".offset_y");
  const auto square = [&](std::size_t p, std::size_t i) {
    return (x.empty() ? 0.0 : x[p][i] * x[p][i]) + (y.empty() ? 0.0 : y[p][i] * y[p][i]);
  };
  const double whole = peak ? soft_peak(view, phases, options.sharpness, square) : window_mean(view, phases, square);
  if (std::isnan(whole)) return std::nullopt;  // the load hangs at neither end of a phase
  return std::sqrt(std::max(0.0, whole));
}

/// Soft peak of (sum of tensions) / (static load) over the hanging phases. Where a wire takes up or lets go of the load
/// the ratio runs from 0 to 1, which is no scale for a peak a few parts in a hundred above 1: what is larger there
/// counts as it is. NaN for wires that at rest hold nothing at any time.
double soft_ratio(const RunView& view, const std::vector<std::string>& wires, const SmoothOptions& options) {
  const std::vector<std::size_t> phases = view.phases_of({Stage::hanging});
  std::vector<std::string> channels;
  for (const std::string& wire : wires) channels.push_back(wire + ".tension");
  const Tables ratio = tables(view, phases, [&](std::size_t p, std::size_t i) {
    double tension = 0.0;
    for (const std::string& channel : channels) tension += view.series(channel)[i];
    const double at_rest = static_load(view, p, view.run().time[i], channels);
    return at_rest > 0.0 ? tension / at_rest : 0.0;  // as the metric, which passes over such a moment
  });
  const double soft =
      soft_peak(view, phases, options.sharpness, [&](std::size_t p, std::size_t i) { return ratio[p][i]; });
  const Peak elsewhere = largest_amplification(
      view, channels, view.phases_of({Stage::on_barge, Stage::transfer, Stage::set_down, Stage::landed}));
  if (!(soft > 0.0)) return elsewhere.value;
  return elsewhere.value > soft ? elsewhere.value : soft;
}

/// A value of the search, empty for one that is not there.
std::optional<double> if_any(double value) { return std::isnan(value) ? std::nullopt : std::optional(value); }

/// The wire of that name, or else the hoist wires of the crane of that name.
std::vector<std::string> wires_named(const Specification& s, const std::string& element) {
  for (const WireSpec& wire : s.wires)
    if (wire.name == element) return {element};
  return hoist_wires_of(s, element);
}

std::optional<double> smooth_daf(const RunView& view, const std::string& name, const SmoothOptions& options) {
  const HoistWires hoist(view.specification());
  if (view.phases_of({Stage::hanging}).empty() || hoist.names.empty()) return std::nullopt;
  if (name == "daf_total") return if_any(soft_ratio(view, hoist.names, options));
  if (name.starts_with("daf."))
    return if_any(soft_ratio(view, wires_named(view.specification(), name.substr(4)), options));
  // The larger of the wires, smoothly: they swing together, so the root mean of high powers. It lies below the largest
  // by at most ln(wires) / power of it, so the power grows with the sharpness: 64 for the usual one of 20.
  const double power = 3.2 * options.sharpness;
  std::vector<double> ratios;
  for (const std::string& wire : hoist.names)
    if (const double ratio = soft_ratio(view, {wire}, options); ratio > 0.0) ratios.push_back(ratio);
  if (ratios.empty()) return std::nullopt;
  const double largest = *std::max_element(ratios.begin(), ratios.end());
  double sum = 0.0;
  for (const double ratio : ratios) sum += std::pow(ratio / largest, power);  // at most one each: no overflow
  const double together = largest * std::pow(sum / static_cast<double>(ratios.size()), 1.0 / power);
  return name == "daf_excess" ? together - 1.0 : together;
}

/// x for x > w, 0 for x < -w, a parabola in between.
double soft_positive(double x, double w) {
  if (x <= -w) return 0.0;
  if (x >= w) return x;
  return (x + w) * (x + w) / (4.0 * w);
}

std::optional<double> smooth_rehits(const RunView& view, const SmoothOptions& options) {
  const Specification& s = view.specification();
  std::vector<std::size_t> lifting = view.phases_of({Stage::transfer});
  if (lifting.empty()) lifting = view.phases_of({Stage::hanging});
  if (lifting.empty()) return std::nullopt;
  double mass = 0.0, sum = 0.0;
  for (const BodySpec& b : s.bodies)
    if (b.name == s.operation.load) mass = b.mass;
  for (const ContactSpec& contact : s.contacts) {
    if (contact.role != ContactSpec::Role::pickup) continue;
    const auto gap = view.series(contact.name + ".gap");
    const std::vector<double>& time = view.run().time;
    bool clear = false;
    double before = 0.0;
    for (std::size_t i = 0; i < gap.size(); ++i) {
      if (time[i] < view.run().phases[lifting.front()].start) continue;
      const double now = contact.stiffness * soft_positive(-gap[i], options.gap_width);
      if (clear) sum += 0.5 * (before + now) * (time[i] - time[i - 1]);
      clear = clear || gap[i] > options.gap_width;
      before = now;
    }
  }
  return mass > 0.0 ? std::optional(sum / (mass * options.rehit_speed)) : std::nullopt;
}

std::optional<double> smooth_saturation(const RunView& view, const SmoothOptions& options) {
  double sum = 0.0;
  int lines = 0;
  for (const TaglineSpec& line : view.specification().taglines) {
    if (!line.active) continue;
    const auto speed = view.series(line.name + ".line_speed"), command = view.series(line.name + ".command");
    if (speed.empty() || command.empty()) return std::nullopt;
    const auto share = [&](double value, double limit) {
      return limit > 0.0 ? 1.0 / (1.0 + std::exp((1.0 - std::abs(value) / limit) / options.saturation_width)) : 0.0;
    };
    sum += window_mean(view, view.all_phases(), [&](std::size_t, std::size_t i) {
      const double a = share(speed[i], line.speed_max), b = share(command[i], line.tension_max);
      // At the limit the logistic is one half.
      return std::min(1.0, 2.0 * (a + b - a * b));
    });
    ++lines;
  }
  return lines > 0 ? std::optional(sum / lines) : std::nullopt;
}

}  // namespace

std::optional<double> smooth_metric(const Specification& specification, const Trajectory& run, const std::string& name,
                                    const SmoothOptions& options) {
  if (run.phases.empty() || run.time.empty()) return std::nullopt;
  const RunView view(specification, run);
  if (name == "duration") return run.phases.back().end - run.phases.front().start;
  if (name.starts_with("sway_")) return smooth_sway(view, name, options);
  if (name.starts_with("daf")) return smooth_daf(view, name, options);
  if (name == "rehits") return smooth_rehits(view, options);
  if (name == "tagline_saturated") return smooth_saturation(view, options);
  return std::nullopt;
}

}  // namespace stillhook
