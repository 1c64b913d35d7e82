// Motions of the load and of the crane vessel.
#include <algorithm>
#include <cmath>

#include "results/load_path.h"
#include "results/metric_list.h"
#include "sim/crane_parts.h"
#include "sim/spatial/constants.h"
#include "sim/spatial/pose.h"

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
  for (const WireSpec& wire : view.specification().wires) {
    if (wire.role != WireSpec::Role::hoist) continue;
    const std::string name_x = wire.name + ".offset_x", name_y = wire.name + ".offset_y";
    const auto x = view.series(name_x), y = view.series(name_y);
    if (x.empty() || y.empty()) continue;
    ++wires;
    for (std::size_t i = 0; i < n; ++i) {
      const double t = view.run().time[swing.range.first + i];
      swing.x[i] += x[swing.range.first + i] - view.static_at(phase, t, name_x);
      swing.y[i] += y[swing.range.first + i] - view.static_at(phase, t, name_y);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    swing.x[i] /= std::max(1, wires);
    swing.y[i] /= std::max(1, wires);
  }
  swing.valid = wires > 0 && n > 1;
  return swing;
}

std::vector<Vector3> reference_offsets(const RunView& view, RunView::Range range) {
  const OperationSpec& operation = view.specification().operation;
  const auto s = [&](const char* quantity) { return view.series(operation.load + quantity); };
  const auto x = s(".x"), y = s(".y"), z = s(".z"), roll = s(".roll"), pitch = s(".pitch"), yaw = s(".yaw");
  std::vector<Vector3> offsets;
  if (x.empty() || y.empty() || z.empty() || roll.empty() || pitch.empty() || yaw.empty()) return offsets;
  for (std::size_t i = range.first; i < range.last; ++i) {
    const Pose X_WB{rotation_from({roll[i], pitch[i], yaw[i]}), {x[i], y[i], z[i]}};
    offsets.push_back(X_WB * operation.load_reference - operation.target);
  }
  return offsets;
}

/// Largest departure in z from the planned descent until the load lands: height of the reference point against its
/// static height at the start of the phase minus the mean wire paid out since.
Peak descent_departure(const RunView& view, std::size_t phase, const std::vector<Vector3>& offsets) {
  Peak peak;
  const Specification& s = view.specification();
  std::vector<std::pair<std::span<const double>, double>> lengths;  // unstretched length and its static start
  for (const WireSpec& wire : s.wires) {
    const auto length = view.series(wire.name + ".unstretched");
    if (wire.role == WireSpec::Role::hoist && !length.empty())
      lengths.emplace_back(length, view.static_value(phase, wire.name + ".unstretched"));
  }
  if (lengths.empty() || phase >= view.run().static_poses.size()) return peak;
  const auto body =
      std::find_if(s.bodies.begin(), s.bodies.end(), [&](const BodySpec& b) { return b.name == s.operation.load; });
  const std::size_t index = static_cast<std::size_t>(body - s.bodies.begin());
  if (index >= view.run().static_poses[phase].bodies.size()) return peak;
  const double static_z =
      (view.run().static_poses[phase].bodies[index] * s.operation.load_reference - s.operation.target).z();
  const double landing = landing_time(view);
  const RunView::Range range = view.samples(phase);
  for (std::size_t i = range.first; i < range.last && view.run().time[i] <= landing; ++i) {
    double paid_out = 0.0;
    for (const auto& [length, start] : lengths) paid_out += length[i] - start;
    const double planned = static_z - paid_out / static_cast<double>(lengths.size());
    peak.take_larger(std::abs(offsets[i - range.first].z() - planned), view.run().time[i]);
  }
  return peak;
}

}  // namespace

void add_load_motion(const RunView& view, MetricList& list) {
  const std::string& load = view.specification().operation.load;
  if (load.empty()) return;
  for (std::size_t p : view.all_phases()) {
    const PhaseRecord& phase = view.run().phases[p];
    for (const char* axis : {"x", "y", "z", "roll", "pitch", "yaw"}) {
      const std::string channel = load + "." + axis;
      const double range = view.maximum(channel, {p}).value - view.minimum(channel, {p}).value;
      list.add(std::string("range_") + axis + ".%", phase.name, range, kNaN, phase.name);
    }
    for (const char* axis : {"x", "y", "z"}) {
      const auto values = view.series(load + "." + axis);
      if (values.empty()) continue;
      const double mean = view.mean(view.samples(p), [&](std::size_t i) { return values[i]; });
      list.add(std::string("mean_") + axis + ".%", phase.name, mean, kNaN, phase.name);
    }
  }
}

void add_sway(const RunView& view, MetricList& list) {
  double time = 0.0, sum_x = 0.0, sum_y = 0.0;
  Peak peak;
  for (std::size_t p : view.phases_of({Stage::hanging, Stage::set_down})) {
    const PhaseRecord& phase = view.run().phases[p];
    const Swing swing = swing_in(view, p);
    if (!swing.valid) continue;
    const std::size_t first = swing.range.first;
    const double x2 = view.integral(swing.range, [&](std::size_t i) { return std::pow(swing.x[i - first], 2); });
    const double y2 = view.integral(swing.range, [&](std::size_t i) { return std::pow(swing.y[i - first], 2); });
    const double span = view.run().time[swing.range.last - 1] - view.run().time[first];
    Peak phase_peak;
    for (std::size_t i = 0; i < swing.x.size(); ++i)
      phase_peak.take_larger(std::hypot(swing.x[i], swing.y[i]), view.run().time[first + i]);
    list.add("sway_rms.%", phase.name, std::sqrt((x2 + y2) / span), kNaN, phase.name);
    list.add("sway_peak.%", phase.name, phase_peak.value, phase_peak.time, phase.name);
    if (phase.stage != Stage::hanging) continue;
    time += span;
    sum_x += x2;
    sum_y += y2;
    peak.take_larger(phase_peak.value, phase_peak.time);
  }
  if (time <= 0.0) return;
  list.add("sway_rms", std::sqrt((sum_x + sum_y) / time));
  list.add("sway_x_rms", std::sqrt(sum_x / time));
  list.add("sway_y_rms", std::sqrt(sum_y / time));
  list.add("sway_peak", peak);
}

void add_set_down_motion(const RunView& view, MetricList& list) {
  Peak x, y, z, tilt, yaw;
  const std::vector<std::size_t> phases = view.phases_of({Stage::set_down});
  const std::string& load = view.specification().operation.load;
  const auto roll_values = view.series(load + ".roll"), pitch_values = view.series(load + ".pitch");
  const std::size_t last_pose = view.run().static_poses.empty() ? 0 : view.run().static_poses.size() - 1;
  const double landed_yaw = view.static_value(last_pose, load + ".yaw");
  for (std::size_t p : phases) {
    const RunView::Range range = view.samples(p);
    const std::vector<Vector3> offsets = reference_offsets(view, range);
    if (offsets.empty()) continue;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      const double t = view.run().time[range.first + i];
      x.take_larger(std::abs(offsets[i].x()), t);
      y.take_larger(std::abs(offsets[i].y()), t);
      // The angle of the load's z axis from the vertical: cos(tilt) = cos(roll) cos(pitch) for ZYX angles.
      const double upright = std::cos(roll_values[range.first + i]) * std::cos(pitch_values[range.first + i]);
      tilt.take_larger(std::acos(std::clamp(upright, -1.0, 1.0)), t);
    }
    const Peak departure = descent_departure(view, p, offsets);
    z.take_larger(departure.value, departure.time);
    if (std::isnan(landed_yaw)) continue;
    for (const Peak& extreme : {view.maximum(load + ".yaw", {p}), view.minimum(load + ".yaw", {p})})
      yaw.take_larger(std::abs(std::remainder(extreme.value - landed_yaw, 2.0 * M_PI)), extreme.time);
  }
  list.add("setdown_movement_x", x);
  list.add("setdown_movement_y", y);
  list.add("setdown_movement_z", z);
  list.add("load_tilt_max", tilt);
  list.add("load_yaw_max", yaw);

  if (phases.empty() || view.run().status != RunStatus::completed || view.run().time.empty()) return;
  const std::size_t n = view.run().time.size();
  const std::vector<Vector3> end = reference_offsets(view, {n - 1, n});
  if (!end.empty()) list.add("setdown_offset", {end[0].head<2>().norm(), view.run().time.back()});
}

void add_crane_motion(const RunView& view, MetricList& list) {
  const std::vector<PhaseRecord>& phases = view.run().phases;
  Peak heel_overall, trim_overall, static_heel_overall, static_trim_overall;
  for (const std::string& vessel : crane_vessels(view.specification())) {
    const auto in_waves = [&](const char* metric, const std::string& channel, Peak& overall) {
      const Peak peak = view.largest_magnitude(channel, view.all_phases());
      list.add(std::string(metric) + ".%", vessel, peak);
      overall.take_larger(peak.value, peak.time);
    };
    const auto at_rest = [&](const char* metric, const std::string& channel, Peak& overall) {
      Peak peak;
      for (std::size_t i = 0; i < view.run().static_poses.size() && i <= phases.size(); ++i)
        peak.take_larger(std::abs(view.static_value(i, channel)), i == 0 ? phases.front().start : phases[i - 1].end);
      list.add(std::string(metric) + ".%", vessel, peak);
      overall.take_larger(peak.value, peak.time);
    };
    in_waves("heel_max", vessel + ".roll", heel_overall);
    in_waves("trim_max", vessel + ".pitch", trim_overall);
    at_rest("heel_static_max", vessel + ".roll", static_heel_overall);
    at_rest("trim_static_max", vessel + ".pitch", static_trim_overall);
  }
  list.add("heel_max", heel_overall);
  list.add("trim_max", trim_overall);
  list.add("heel_static_max", static_heel_overall);
  list.add("trim_static_max", static_trim_overall);
}

}  // namespace stillhook
