// Tensions, hook loads, amplifications and slack of the wires.
#include <algorithm>
#include <cmath>

#include "results/load_path.h"
#include "results/metrics/channel_set.h"
#include "results/metrics/metric_row.h"
#include "results/metrics/smooth_tools.h"
#include "sim/crane_parts.h"
#include "sim/lifting/wire.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

using Stage = PhaseSpec::Stage;

/// The wire of that name, or else the hoist wires of the crane of that name.
std::vector<std::string> wires_named(const Specification& s, const std::string& element) {
  for (const WireSpec& wire : s.wires)
    if (wire.name == element) return {element};
  return hoist_wires_of(s, element);
}

/// Their tension channels, those that the run has.
std::vector<std::string> tensions_of(const RunView& view, const std::vector<std::string>& wires) {
  std::vector<std::string> names;
  for (const std::string& wire : wires)
    if (view.channel(wire_channels::tension.of(wire)) >= 0) names.push_back(wire_channels::tension.of(wire));
  return names;
}

Peak largest_sum(const RunView& view, const std::vector<std::string>& channels, std::size_t phase) {
  if (channels.size() == 1) return view.maximum(channels[0], {phase});
  Peak peak;
  std::vector<std::span<const double>> series;
  for (const std::string& name : channels) series.push_back(view.series(name));
  if (series.empty() || std::any_of(series.begin(), series.end(), [](const auto& s) { return s.empty(); })) return peak;
  const RunView::Range range = view.samples(phase);
  for (std::size_t i = range.first; i < range.last; ++i) {
    double sum = 0.0;
    for (const auto& values : series) sum += values[i];
    peak.take_larger(sum, view.run().time[i]);
  }
  return peak;
}

Peak amplification(const RunView& view, const std::vector<std::string>& wires, const Phases& phases) {
  const std::vector<std::string> channels = tensions_of(view, wires);
  return channels.empty() ? Peak{} : largest_amplification(view, channels, phases);
}

/// Soft peak of (sum of tensions) / (static load) over the hanging phases. Where a wire takes up or lets go of the load
/// the ratio runs from 0 to 1, which is no scale for a peak a few parts in a hundred above 1: what is larger there
/// counts as it is. NaN for wires that at rest hold nothing at any time.
double soft_ratio(const RunView& view, const std::vector<std::string>& wires, const SmoothOptions& options) {
  const Phases phases = view.phases_of({Stage::hanging});
  std::vector<std::string> channels;
  std::vector<std::span<const double>> tensions;
  for (const std::string& wire : wires) {
    channels.push_back(wire_channels::tension.of(wire));
    tensions.push_back(view.series(channels.back()));
    if (tensions.back().empty()) return kNaN;
  }
  Tables ratio(view.run().phases.size());
  for (const std::size_t phase : phases) {
    const StaticLoad static_load(view, phase, channels);
    ratio[phase] = std::move(tabulated(view, {phase}, [&](std::size_t, std::size_t i) {
      double tension = 0.0;
      for (const auto& values : tensions) tension += values[i];
      const double at_rest = static_load.at(view.run().time[i]);
      return at_rest > 0.0 ? tension / at_rest : 0.0;  // as the metric, which passes over such a moment
    })[phase]);
  }
  const double soft =
      soft_peak(view, phases, options.sharpness, [&](std::size_t p, std::size_t i) { return ratio[p][i]; });
  const Peak elsewhere = largest_amplification(
      view, channels, view.phases_of({Stage::on_barge, Stage::transfer, Stage::set_down, Stage::landed}));
  if (!(soft > 0.0)) return elsewhere.value;
  return elsewhere.value > soft ? elsewhere.value : soft;
}

std::optional<double> smooth_ratio(const RunView& view, const std::vector<std::string>& wires,
                                   const SmoothOptions& options) {
  if (view.phases_of({Stage::hanging}).empty() || hoist_wires(view.specification()).empty()) return std::nullopt;
  return if_any(soft_ratio(view, wires, options));
}

/// The larger of the wires, smoothly: they swing together, so the root mean of high powers. It lies below the largest
/// by at most ln(wires) / power of it, so the power grows with the sharpness: 64 for the usual one of 20.
std::optional<double> smooth_largest_ratio(const RunView& view, const SmoothOptions& options) {
  const std::vector<std::string> hoist = hoist_wires(view.specification());
  if (view.phases_of({Stage::hanging}).empty() || hoist.empty()) return std::nullopt;
  const double power = 3.2 * options.sharpness;
  std::vector<double> ratios;
  for (const std::string& wire : hoist)
    if (const double ratio = soft_ratio(view, {wire}, options); ratio > 0.0) ratios.push_back(ratio);
  if (ratios.empty()) return std::nullopt;
  const double largest = *std::max_element(ratios.begin(), ratios.end());
  double sum = 0.0;
  for (const double ratio : ratios) sum += std::pow(ratio / largest, power);  // at most one each: no overflow
  return largest * std::pow(sum / static_cast<double>(ratios.size()), 1.0 / power);
}

void hoist_tensions(ChannelSet& channels, const std::string&) { channels.add_hoist_wires({wire_channels::tension}); }
void wire_tensions(ChannelSet& channels, const std::string&) { channels.add_wires({wire_channels::tension}); }

std::vector<MetricRow> amplification_rows() {
  return {
      {.name = "daf_total",
       .description = "largest total hook load / static load, lift-off and set-down included",
       .over = OverPhases::largest,
       .channels = hoist_tensions,
       .value =
           [](MetricRun& run, const std::string&, const Phases& phases) {
             return amplification(run.view(), hoist_wires(run.specification()), phases);
           },
       .smooth =
           [](const RunView& view, const std::string&, const SmoothOptions& options) {
             return smooth_ratio(view, hoist_wires(view.specification()), options);
           }},
      {.name = "daf_max",
       .description = "largest tension / static load of any hoist wire, lift-off and set-down included",
       .over = OverPhases::largest,
       .channels = hoist_tensions,
       .value = [](MetricRun& run, const std::string&,
                   const Phases& phases) { return run.largest_of("daf.%", hoist_wires(run.specification()), phases); },
       .smooth = [](const RunView& view, const std::string&,
                    const SmoothOptions& options) { return smooth_largest_ratio(view, options); }},
      {.name = "daf_excess",
       .description = "daf_max - 1: what the dynamics add to the static load",
       .over = OverPhases::largest,
       .channels = hoist_tensions,
       .value =
           [](MetricRun& run, const std::string&, const Phases& phases) {
             Peak peak = run.largest_of("daf.%", hoist_wires(run.specification()), phases);
             peak.value -= 1.0;
             return peak;
           },
       .smooth =
           [](const RunView& view, const std::string&, const SmoothOptions& options) {
             const std::optional<double> largest = smooth_largest_ratio(view, options);
             return largest ? std::optional(*largest - 1.0) : largest;
           }},
      {.name = "daf.%",
       .element = MetricElement::wire_or_crane,
       .description =
           "largest tension / static load of a wire, or of the hoist wires of a boom or of all booms of a vessel "
           "together; lift-off and set-down included",
       .over = OverPhases::largest,
       .channels = wire_tensions,
       .value =
           [](MetricRun& run, const std::string& element, const Phases& phases) {
             return amplification(run.view(), wires_named(run.specification(), element), phases);
           },
       .smooth =
           [](const RunView& view, const std::string& element, const SmoothOptions& options) {
             return smooth_ratio(view, wires_named(view.specification(), element), options);
           }},
      {.name = "slack_ratio_min",
       .description = "smallest tension / static load of any hoist wire while the load hangs free",
       .over = OverPhases::smallest,
       .better_when_larger = true,
       .channels = hoist_tensions,
       .value =
           [](MetricRun& run, const std::string&, const Phases& phases) {
             return run.smallest_of("slack_ratio_min.%", hoist_wires(run.specification()), phases);
           }},
      {.name = "slack_ratio_min.%",
       .element = MetricElement::hoist_wire,
       .description = "smallest tension / static load of a hoist wire while the load hangs free",
       .over = OverPhases::smallest,
       .better_when_larger = true,
       .channels = hoist_tensions,
       .value =
           [](MetricRun& run, const std::string& wire, const Phases& phases) {
             const std::string channel = wire_channels::tension.of(wire);
             return run.view().channel(channel) < 0 ? Peak{} : smallest_share(run.view(), channel, phases.front());
           }},
  };
}

std::vector<MetricRow> tension_rows() {
  return {
      {.name = "tension_max.%",
       .quantity = Quantity::force,
       .element = MetricElement::wire,
       .description = "largest tension of a wire",
       .over = OverPhases::largest,
       .channels = wire_tensions,
       .value = [](MetricRun& run, const std::string& wire,
                   const Phases& phases) { return run.view().maximum(wire_channels::tension.of(wire), phases); }},
      {.name = "hook_load_max",
       .quantity = Quantity::force,
       .description = "largest total tension of the hoist wires",
       .over = OverPhases::largest,
       .channels = hoist_tensions,
       .value =
           [](MetricRun& run, const std::string&, const Phases& phases) {
             return largest_sum(run.view(), tensions_of(run.view(), hoist_wires(run.specification())), phases.front());
           }},
      {.name = "hook_load_max.%",
       .quantity = Quantity::force,
       .element = MetricElement::crane,
       .description = "largest total tension of the hoist wires of a boom, or of all booms of a vessel",
       .over = OverPhases::largest,
       .channels = hoist_tensions,
       .value =
           [](MetricRun& run, const std::string& crane, const Phases& phases) {
             return largest_sum(run.view(), tensions_of(run.view(), hoist_wires_of(run.specification(), crane)),
                                phases.front());
           }},
      {.name = "wire_utilisation_max",
       .description = "largest tension / breaking load of the wires that give one",
       .over = OverPhases::largest,
       .channels = wire_tensions,
       .value =
           [](MetricRun& run, const std::string&, const Phases& phases) {
             Peak use;
             for (const WireSpec& wire : run.specification().wires) {
               if (!(wire.breaking_load > 0.0)) continue;
               const Peak tension = run.over(metric_row("tension_max.%"), wire.name, phases);
               use.take_larger(tension.value / wire.breaking_load, tension.time);
             }
             return use;
           }},
  };
}

}  // namespace

std::vector<MetricRow> wire_metrics() {
  std::vector<MetricRow> rows = amplification_rows();
  for (MetricRow& row : tension_rows()) rows.push_back(std::move(row));
  return rows;
}

}  // namespace stillhook
