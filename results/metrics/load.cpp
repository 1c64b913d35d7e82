// Where the load is in each phase.
#include <cmath>

#include "results/metrics/channel_set.h"
#include "results/metrics/metric_row.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

using LoadChannel = ChannelKind<BodySpec>;

std::string channel_of_load(const MetricRun& run, const LoadChannel& kind) {
  return kind.of(run.specification().operation.load);
}

MetricRow load_row(const char* stem, const LoadChannel& kind, Quantity quantity, const char* description) {
  MetricRow row;
  row.name = std::string(stem) + "_" + kind.quantity + ".%";
  row.quantity = quantity;
  row.element = MetricElement::phase;
  row.description = description;
  row.channels = [](ChannelSet& channels, const std::string&) {
    channels.add_pose(channels.specification().operation.load);
  };
  return row;
}

MetricRow range_row(const LoadChannel& kind, Quantity quantity, const char* description) {
  MetricRow row = load_row("range", kind, quantity, description);
  row.value = [kind](MetricRun& run, const std::string&, const Phases& phases) {
    const std::string channel = channel_of_load(run, kind);
    return Peak{run.view().maximum(channel, phases).value - run.view().minimum(channel, phases).value, kNaN};
  };
  return row;
}

MetricRow mean_row(const LoadChannel& kind, const char* description) {
  MetricRow row = load_row("mean", kind, Quantity::length, description);
  row.value = [kind](MetricRun& run, const std::string&, const Phases& phases) {
    const auto values = run.view().series(channel_of_load(run, kind));
    if (values.empty()) return Peak{};
    return Peak{run.view().mean(run.view().samples(phases.front()), [&](std::size_t i) { return values[i]; }), kNaN};
  };
  return row;
}

/// Rms of the horizontal distance from the static path over the hanging ones of some phases.
Peak rms_motion(MetricRun& run, const std::string&, const Phases& phases) {
  const RunView& view = run.view();
  const std::string x = channel_of_load(run, body_channels::x), y = channel_of_load(run, body_channels::y);
  const auto xs = view.series(x), ys = view.series(y);
  if (xs.empty() || ys.empty()) return {};
  double sum = 0.0, time = 0.0;
  for (const std::size_t p : with_stage(view, phases, {PhaseSpec::Stage::hanging})) {
    const RunView::Range range = view.samples(p);
    if (range.last < range.first + 2) continue;
    const StaticPath static_x = view.static_path(p, x), static_y = view.static_path(p, y);
    sum += view.integral(range, [&](std::size_t i) {
      const double progress = view.progress(p, view.run().time[i]);
      return std::pow(xs[i] - static_x.at(progress), 2) + std::pow(ys[i] - static_y.at(progress), 2);
    });
    time += view.run().time[range.last - 1] - view.run().time[range.first];
  }
  return time > 0.0 ? Peak{std::sqrt(sum / time), kNaN} : Peak{};
}

MetricRow motion_row() {
  MetricRow row =
      load_row("motion", body_channels::x, Quantity::length,
               "rms horizontal motion of the load in the world about its static path, over the hanging phases; "
               "sway_rms is that relative to the boom tips");
  row.name = "load_motion_rms";
  row.element = MetricElement::none;
  row.value = rms_motion;
  return row;
}

}  // namespace

std::vector<MetricRow> load_metrics() {
  return {motion_row(),
          range_row(body_channels::x, Quantity::length, "peak-to-peak position of the load fore and aft in a phase"),
          range_row(body_channels::y, Quantity::length, "peak-to-peak position of the load athwart in a phase"),
          range_row(body_channels::z, Quantity::length, "peak-to-peak height of the load in a phase"),
          range_row(body_channels::roll, Quantity::angle, "peak-to-peak roll of the load in a phase"),
          range_row(body_channels::pitch, Quantity::angle, "peak-to-peak pitch of the load in a phase"),
          range_row(body_channels::yaw, Quantity::angle, "peak-to-peak yaw of the load in a phase"),
          mean_row(body_channels::x, "mean position x of the load in a phase"),
          mean_row(body_channels::y, "mean position y of the load in a phase"),
          mean_row(body_channels::z, "mean height of the load in a phase")};
}

}  // namespace stillhook
