// The motion of the boom tips relative to the load that waits.
//
// Characteristic relative velocity at lift-off: 2 sigma_v, and the expected largest of N cycles sigma_v sqrt(2 ln N),
// with sigma_v the standard deviation of the rate of change of the distance between boom tip and lift point while
// the load waits on its support, waves fully grown. Cycles to clear: n = 2 r_a / (v_h T), with r_a = sqrt(2) sigma_r
// the amplitude of that distance, T its mean zero-crossing period and v_h the hoist speed in the transfer.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "results/metrics/channel_set.h"
#include "results/metrics/metric_row.h"
#include "sim/crane_parts.h"
#include "sim/lifting/wire.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

using Stage = PhaseSpec::Stage;

/// What the mean distance of boom tips and lift points does while the load waits.
struct RelativeMotion {
  double sigma_r = kNaN, sigma_v = kNaN;  // m, m/s
  double period = kNaN;                   // s, NaN with fewer than one whole cycle
};

struct WaitingSamples {
  std::vector<double> time, distance;  // s, m, the mean taken off
};

WaitingSamples waiting_samples(const RunView& view) {
  WaitingSamples motion;
  std::vector<std::span<const double>> lengths;
  for (const std::string& wire : hoist_wires(view.specification()))
    if (const auto length = view.series(wire_channels::length.of(wire)); !length.empty()) lengths.push_back(length);
  if (lengths.empty()) return motion;
  const double grown = view.start() + view.specification().sea.ramp;
  double mean = 0.0;
  for (const std::size_t p : view.phases_of({Stage::on_barge})) {
    const RunView::Range range = view.samples(p);
    for (std::size_t i = range.first; i < range.last; ++i) {
      if (view.run().time[i] < grown) continue;
      if (!motion.time.empty() && view.run().time[i] <= motion.time.back()) continue;  // shared by two phases
      double sum = 0.0;
      for (const auto& length : lengths) sum += length[i];
      motion.time.push_back(view.run().time[i]);
      motion.distance.push_back(sum / static_cast<double>(lengths.size()));
      mean += motion.distance.back();
    }
  }
  for (double& d : motion.distance) d -= mean / static_cast<double>(motion.distance.size());
  return motion;
}

RelativeMotion relative_motion(const RunView& view) {
  const WaitingSamples motion = waiting_samples(view);
  const std::size_t n = motion.time.size();
  if (n < 4) return {};
  double v2 = 0.0, r2 = 0.0;
  std::vector<double> upcrossings;
  for (std::size_t i = 0; i < n; ++i) {
    r2 += motion.distance[i] * motion.distance[i];
    if (i == 0) continue;
    const double dt = motion.time[i] - motion.time[i - 1], rise = motion.distance[i] - motion.distance[i - 1];
    v2 += rise * rise / (dt * dt);
    if (motion.distance[i - 1] < 0.0 && motion.distance[i] >= 0.0)
      upcrossings.push_back(motion.time[i - 1] - dt * motion.distance[i - 1] / rise);
  }
  RelativeMotion out{std::sqrt(r2 / static_cast<double>(n)), std::sqrt(v2 / static_cast<double>(n - 1)), kNaN};
  if (upcrossings.size() >= 2)
    out.period = (upcrossings.back() - upcrossings.front()) / static_cast<double>(upcrossings.size() - 1);
  return out;
}

const RelativeMotion& motion_once(MetricRun& run) {
  return run.once("relative motion", [&] { return relative_motion(run.view()); });
}

Peak characteristic_speed(MetricRun& run, const std::string&, const Phases&) {
  return {2.0 * motion_once(run).sigma_v, kNaN};
}

Peak extreme_speed(MetricRun& run, const std::string&, const Phases&) {
  double transfer_time = 0.0;
  for (const std::size_t p : run.view().phases_of({Stage::transfer}))
    transfer_time += run.view().run().phases[p].end - run.view().run().phases[p].start;
  const double cycles = transfer_time / motion_once(run).period;
  if (!(cycles > 1.0)) return {};
  return {motion_once(run).sigma_v * std::sqrt(2.0 * std::log(cycles)), kNaN};
}

Peak cycles_to_clear(MetricRun& run, const std::string&, const Phases&) {
  double hoist_speed = 0.0;
  const Phases transfer = run.view().phases_of({Stage::transfer});
  for (const WireSpec& wire : run.specification().wires)
    if (wire.role == WireSpec::Role::hoist && !wire.winch.empty())
      hoist_speed =
          std::max(hoist_speed, run.view().largest_magnitude(drive_channels::rate.of(wire.winch), transfer).value);
  const RelativeMotion& motion = motion_once(run);
  if (!(hoist_speed > 0.0)) return {};
  return {2.0 * std::numbers::sqrt2 * motion.sigma_r / (hoist_speed * motion.period), kNaN};
}

using Value = Peak (*)(MetricRun&, const std::string&, const Phases&);

MetricRow lift_off_row(const char* name, Quantity quantity, const char* description, Value value) {
  MetricRow row;
  row.name = name;
  row.quantity = quantity;
  row.description = description;
  row.by_phase = false;
  row.channels = [](ChannelSet& channels, const std::string&) { channels.add_hoist_wires({wire_channels::length}); };
  row.value = value;
  return row;
}

}  // namespace

std::vector<MetricRow> lift_off_metrics() {
  return {lift_off_row("lift_off_relative_speed", Quantity::speed,
                       "characteristic speed 2 sigma_v of the boom tips relative to the waiting load",
                       characteristic_speed),
          lift_off_row("lift_off_relative_speed_extreme", Quantity::speed,
                       "expected largest relative speed, sigma_v sqrt(2 ln N), in the transfer", extreme_speed),
          lift_off_row("cycles_to_clear", Quantity::ratio,
                       "wave cycles the hoist needs to clear the relative motion, 2 r_a / (v_h T)", cycles_to_clear)};
}

}  // namespace stillhook
