// Tensions, speeds and saturation of the taglines.
#include <algorithm>
#include <cmath>

#include "results/metrics/channel_set.h"
#include "results/metrics/metric_row.h"
#include "results/metrics/smooth_tools.h"
#include "sim/lifting/tagline.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

std::vector<std::string> tagline_names(const Specification& s) {
  std::vector<std::string> names;
  for (const TaglineSpec& line : s.taglines) names.push_back(line.name);
  return names;
}

void all_taglines(ChannelSet& channels, const std::string&) {
  for (const TaglineSpec& line : channels.specification().taglines)
    channels.add(line.name, {tagline_channels::tension, tagline_channels::command, tagline_channels::line_speed,
                             tagline_channels::saturated});
}

/// Share of time at a limit; without value for a line that is not active.
Peak saturated_share(MetricRun& run, const std::string& name, const Phases& phases) {
  const RunView& view = run.view();
  const auto& lines = view.specification().taglines;
  const auto line = std::find_if(lines.begin(), lines.end(), [&](const TaglineSpec& t) { return t.name == name; });
  const auto saturated = view.series(tagline_channels::saturated.of(name));
  if (saturated.empty() || line == lines.end() || !line->active) return {};
  const RunView::Range range = run.all(phases) ? RunView::Range{0, saturated.size()} : view.samples(phases.front());
  return {view.mean(range, [&](std::size_t i) { return saturated[i]; }), kNaN};
}

Peak mean_saturated_share(MetricRun& run, const std::string&, const Phases& phases) {
  double sum = 0.0;
  int active = 0;
  for (const TaglineSpec& line : run.specification().taglines) {
    const Peak share = run.over(metric_row("tagline_saturated.%"), line.name, phases);
    if (!share.valid()) continue;
    sum += share.value;
    ++active;
  }
  return active > 0 ? Peak{sum / active, kNaN} : Peak{};
}

std::optional<double> smooth_saturation(const RunView& view, const std::string&, const SmoothOptions& options) {
  double sum = 0.0;
  int lines = 0;
  for (const TaglineSpec& line : view.specification().taglines) {
    if (!line.active) continue;
    const auto speed = view.series(tagline_channels::line_speed.of(line)),
               command = view.series(tagline_channels::command.of(line));
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

/// The largest of a channel of any line, and of each.
MetricRow largest_row(const std::string& stem, Quantity quantity, const char* description) {
  MetricRow row;
  row.name = stem;
  row.quantity = quantity;
  row.description = description;
  row.over = OverPhases::largest;
  row.channels = all_taglines;
  row.value = [of_line = stem + ".%"](MetricRun& run, const std::string&, const Phases& phases) {
    return run.largest_of(of_line, tagline_names(run.specification()), phases);
  };
  return row;
}

}  // namespace

std::vector<MetricRow> tagline_metrics() {
  return {
      largest_row("tagline_tension_max", Quantity::force, "largest tension of any tagline"),
      largest_row("tagline_speed_max", Quantity::line_speed, "largest line speed of any tagline"),
      {.name = "tagline_saturated",
       .quantity = Quantity::share,
       .description = "share of time at the tension or speed limit, mean of the active taglines",
       .channels = all_taglines,
       .value = mean_saturated_share,
       .smooth = smooth_saturation},
      {.name = "tagline_tension_max.%",
       .quantity = Quantity::force,
       .element = MetricElement::entry,
       .kind = "tagline",
       .description = "largest tension of a tagline",
       .over = OverPhases::largest,
       .channels = all_taglines,
       .value = [](MetricRun& run, const std::string& line,
                   const Phases& phases) { return run.view().maximum(tagline_channels::tension.of(line), phases); }},
      {.name = "tagline_speed_max.%",
       .quantity = Quantity::line_speed,
       .element = MetricElement::entry,
       .kind = "tagline",
       .description = "largest line speed of a tagline",
       .over = OverPhases::largest,
       .channels = all_taglines,
       .value =
           [](MetricRun& run, const std::string& line, const Phases& phases) {
             return run.view().largest_magnitude(tagline_channels::line_speed.of(line), phases);
           }},
      {.name = "tagline_saturated.%",
       .quantity = Quantity::share,
       .element = MetricElement::entry,
       .kind = "tagline",
       .description = "share of time a tagline spends at its tension or speed limit",
       .channels = all_taglines,
       .value = saturated_share},
  };
}

}  // namespace stillhook
