// Lift-off, re-hits, landing.
//
// Characteristic relative velocity at lift-off: 2 sigma_v, and the expected largest of N cycles sigma_v sqrt(2 ln N),
// with sigma_v the standard deviation of the rate of change of the distance between boom tip and lift point while
// the load waits on its support, waves fully grown. Cycles to clear: n = 2 r_a / (v_h T), with r_a = sqrt(2) sigma_r
// the amplitude of that distance, T its mean zero-crossing period and v_h the hoist speed in the transfer.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "results/load_path.h"
#include "results/metric_list.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

using Stage = PhaseSpec::Stage;

/// The mean distance of boom tips and lift points while the load waits, detrended, with its sample times.
struct RelativeMotion {
  std::vector<double> time, distance;
};

RelativeMotion waiting_motion(const RunView& view) {
  RelativeMotion motion;
  std::vector<std::span<const double>> lengths;
  for (const WireSpec& wire : view.specification().wires) {
    const auto length = view.series(wire.name + ".length");
    if (wire.role == WireSpec::Role::hoist && !length.empty()) lengths.push_back(length);
  }
  if (lengths.empty()) return motion;
  const double grown = view.start() + view.specification().sea.ramp;
  double mean = 0.0;
  for (std::size_t p : view.phases_of({Stage::on_barge})) {
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

}  // namespace

void add_contacts(const RunView& view, MetricList& list) {
  const double lift_off = lift_off_time(view);
  list.add("lift_off_time", {lift_off, lift_off});

  int rehits = 0;
  Peak rehit_speed{0.0, kNaN}, rehit_impulse{0.0, kNaN}, speed{0.0, kNaN}, impulse{0.0, kNaN}, force{0.0, kNaN};
  Peak landing;
  double last_rehit = kNaN;
  for (const ContactEvent& event : view.run().contacts) {
    if (event.start <= view.start()) continue;  // the load resting where it starts
    // The impulse of a load at rest only grows with time, so neither waiting for lift-off nor lying at the end counts.
    const bool passing = event.end < view.end() && !(event.start < lift_off);
    speed.take_larger(event.approach_speed, event.start);
    force.take_larger(event.peak_force, event.start);
    if (passing) impulse.take_larger(event.impulse, event.start);
    if (event.role == ContactSpec::Role::pickup && event.start > lift_off) {
      ++rehits;
      last_rehit = event.start;
      rehit_speed.take_larger(event.approach_speed, event.start);
      rehit_impulse.take_larger(event.impulse, event.start);
    }
    if (event.role == ContactSpec::Role::target && !(landing.time <= event.start))
      landing = {event.approach_speed, event.start};
  }
  if (!std::isnan(lift_off)) {
    list.add("rehits", {static_cast<double>(rehits), last_rehit});
    list.add("rehit_speed_max", rehit_speed);
    list.add("rehit_impulse_max", rehit_impulse);
  }
  if (!view.specification().contacts.empty()) {
    list.add("contact_speed_max", speed);
    list.add("contact_impulse_max", impulse);
    list.add("contact_force_max", force);
  }
  list.add("setdown_speed", landing);
}

void add_lift_off(const RunView& view, MetricList& list) {
  const RelativeMotion motion = waiting_motion(view);
  const std::size_t n = motion.time.size();
  if (n < 4) return;
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
  const double sigma_r = std::sqrt(r2 / static_cast<double>(n)), sigma_v = std::sqrt(v2 / static_cast<double>(n - 1));
  list.add("lift_off_relative_speed", 2.0 * sigma_v);
  if (upcrossings.size() < 2) return;  // fewer than one whole cycle: no period
  const double period = (upcrossings.back() - upcrossings.front()) / static_cast<double>(upcrossings.size() - 1);

  double transfer_time = 0.0, hoist_speed = 0.0;
  const std::vector<std::size_t> transfer = view.phases_of({Stage::transfer});
  for (std::size_t p : transfer) transfer_time += view.run().phases[p].end - view.run().phases[p].start;
  for (const WireSpec& wire : view.specification().wires)
    if (wire.role == WireSpec::Role::hoist && !wire.winch.empty())
      hoist_speed = std::max(hoist_speed, view.largest_magnitude(wire.winch + ".rate", transfer).value);
  const double cycles = transfer_time / period;
  if (cycles > 1.0) list.add("lift_off_relative_speed_extreme", sigma_v * std::sqrt(2.0 * std::log(cycles)));
  if (hoist_speed > 0.0) list.add("cycles_to_clear", 2.0 * std::numbers::sqrt2 * sigma_r / (hoist_speed * period));
}

}  // namespace stillhook
