// The swing of the load: mean over the hoist wires of their horizontal offset less its static value.
#include <algorithm>
#include <cmath>

#include "results/metrics/channel_set.h"
#include "results/metrics/metric_row.h"
#include "results/metrics/smooth_tools.h"
#include "sim/crane_parts.h"
#include "sim/lifting/wire.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

using Stage = PhaseSpec::Stage;

/// The swing of the load at every sample of a phase: (x, y) relative to the static offset, m.
struct Swing {
  RunView::Range range;
  std::vector<double> x, y;  // by sample, from range.first
  bool valid = false;
};

Swing swing_in(const RunView& view, std::size_t phase) {
  Swing swing;
  swing.range = view.samples(phase);
  const std::size_t n = swing.range.empty() ? 0 : swing.range.last - swing.range.first;
  swing.x.assign(n, 0.0);
  swing.y.assign(n, 0.0);
  int wires = 0;
  for (const std::string& wire : hoist_wires(view.specification())) {
    const std::string name_x = wire_channels::offset_x.of(wire), name_y = wire_channels::offset_y.of(wire);
    const auto x = view.series(name_x), y = view.series(name_y);
    if (x.empty() || y.empty()) continue;
    ++wires;
    const StaticPath static_x = view.static_path(phase, name_x), static_y = view.static_path(phase, name_y);
    for (std::size_t i = 0; i < n; ++i) {
      const double progress = view.progress(phase, view.run().time[swing.range.first + i]);
      swing.x[i] += x[swing.range.first + i] - static_x.at(progress);
      swing.y[i] += y[swing.range.first + i] - static_y.at(progress);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    swing.x[i] /= std::max(1, wires);
    swing.y[i] /= std::max(1, wires);
  }
  swing.valid = wires > 0 && n > 1;
  return swing;
}

const Swing& swing_once(MetricRun& run, std::size_t phase) {
  return run.once("swing " + std::to_string(phase), [&] { return swing_in(run.view(), phase); });
}

enum class Part { both, x, y };

Peak rms(MetricRun& run, const Phases& phases, Part part) {
  double time = 0.0, sum_x = 0.0, sum_y = 0.0;
  for (const std::size_t p : phases) {
    const Swing& swing = swing_once(run, p);
    if (!swing.valid) continue;
    const std::size_t first = swing.range.first;
    const auto square = [first](const std::vector<double>& values) {
      return [&values, first](std::size_t i) { return std::pow(values[i - first], 2); };
    };
    sum_x += run.view().integral(swing.range, square(swing.x));
    sum_y += run.view().integral(swing.range, square(swing.y));
    time += run.view().run().time[swing.range.last - 1] - run.view().run().time[first];
  }
  if (time <= 0.0) return {};
  const double sum = part == Part::x ? sum_x : part == Part::y ? sum_y : sum_x + sum_y;
  return {std::sqrt(sum / time), kNaN};
}

Peak largest_swing(MetricRun& run, const Phases& phases) {
  Peak peak;
  for (const std::size_t p : phases) {
    const Swing& swing = swing_once(run, p);
    if (!swing.valid) continue;
    for (std::size_t i = 0; i < swing.x.size(); ++i)
      peak.take_larger(std::hypot(swing.x[i], swing.y[i]), run.view().run().time[swing.range.first + i]);
  }
  return peak;
}

/// Smooth: swing relative to the static offset by phase and sample, m.
Tables swing_table(const RunView& view, const Phases& phases, const ChannelKind<WireSpec>& offset) {
  struct Line {
    std::span<const double> offset;
    StaticPath at_rest;
  };
  const std::vector<std::string> hoist = hoist_wires(view.specification());
  Tables all(view.run().phases.size());
  for (const std::size_t phase : phases) {
    std::vector<Line> lines;
    for (const std::string& wire : hoist)
      lines.push_back({view.series(offset.of(wire)), view.static_path(phase, offset.of(wire))});
    all[phase] = std::move(tabulated(view, {phase}, [&](std::size_t p, std::size_t i) {
      const double progress = view.progress(p, view.run().time[i]);
      double sum = 0.0;
      for (const Line& line : lines) sum += line.offset[i] - line.at_rest.at(progress);
      return sum / static_cast<double>(lines.size());
    })[phase]);
  }
  return all;
}

std::optional<double> smooth_swing(const RunView& view, const Phases& phases, Part part, bool peak,
                                   const SmoothOptions& options) {
  if (phases.empty()) return std::nullopt;
  const Tables x = part == Part::y ? Tables{} : swing_table(view, phases, wire_channels::offset_x);
  const Tables y = part == Part::x ? Tables{} : swing_table(view, phases, wire_channels::offset_y);
  const auto square = [&](std::size_t p, std::size_t i) {
    return (x.empty() ? 0.0 : x[p][i] * x[p][i]) + (y.empty() ? 0.0 : y[p][i] * y[p][i]);
  };
  const double whole = peak ? soft_peak(view, phases, options.sharpness, square) : window_mean(view, phases, square);
  if (std::isnan(whole)) return std::nullopt;  // the load hangs at neither end of a phase
  return std::sqrt(std::max(0.0, whole));
}

Phases hanging(const RunView& view, const Phases& phases) { return with_stage(view, phases, {Stage::hanging}); }

/// The phase of that name, if the load hangs in it or is set down.
Phases swinging_phase(const RunView& view, const std::string& name) {
  Phases found;
  for (const std::size_t p : with_stage(view, view.all_phases(), {Stage::hanging, Stage::set_down}))
    if (view.run().phases[p].name == name) found.push_back(p);
  return found;
}

MetricRow sway_row(const char* name, Part part, bool peak, const char* description) {
  MetricRow row;
  row.name = name;
  row.quantity = Quantity::length;
  row.description = description;
  row.channels = [](ChannelSet& channels, const std::string&) {
    channels.add_hoist_wires({wire_channels::offset_x, wire_channels::offset_y});
  };
  row.value = [part, peak](MetricRun& run, const std::string&, const Phases& phases) {
    const Phases some = hanging(run.view(), phases);
    return peak ? largest_swing(run, some) : rms(run, some, part);
  };
  row.smooth = [part, peak](const RunView& view, const std::string&, const SmoothOptions& options) {
    return smooth_swing(view, hanging(view, view.all_phases()), part, peak, options);
  };
  return row;
}

MetricRow sway_of_phase_row(const char* name, bool peak, const char* description) {
  MetricRow row = sway_row(name, Part::both, peak, description);
  row.element = MetricElement::phase;
  row.value = [peak](MetricRun& run, const std::string&, const Phases& phases) {
    const Phases some = with_stage(run.view(), phases, {Stage::hanging, Stage::set_down});
    return peak ? largest_swing(run, some) : rms(run, some, Part::both);
  };
  row.smooth = [peak](const RunView& view, const std::string& phase, const SmoothOptions& options) {
    return smooth_swing(view, swinging_phase(view, phase), Part::both, peak, options);
  };
  return row;
}

}  // namespace

std::vector<MetricRow> sway_metrics() {
  return {
      sway_row("sway_rms", Part::both, false,
               "rms horizontal swing of the load relative to the boom tips, over the hanging phases"),
      sway_row("sway_x_rms", Part::x, false, "the fore-and-aft part of sway_rms"),
      sway_row("sway_y_rms", Part::y, false, "the athwart part of sway_rms"),
      sway_row("sway_peak", Part::both, true,
               "largest horizontal swing of the load relative to the boom tips, over the hanging phases"),
      sway_of_phase_row("sway_rms.%", false, "rms swing in one hanging or set-down phase"),
      sway_of_phase_row("sway_peak.%", true, "largest swing in one hanging or set-down phase"),
  };
}

}  // namespace stillhook
