// How the load comes down on its target.
#include <algorithm>
#include <cmath>

#include "results/load_path.h"
#include "results/metrics/channel_set.h"
#include "results/metrics/metric_row.h"
#include "sim/crane_parts.h"
#include "sim/lifting/wire.h"
#include "sim/spatial/constants.h"
#include "sim/spatial/pose.h"

namespace stillhook {
namespace {

using Stage = PhaseSpec::Stage;

/// The load's reference point less the target, in W, by sample of a range; empty where the load is not recorded.
std::vector<Vector3> reference_offsets(const RunView& view, RunView::Range range) {
  const OperationSpec& operation = view.specification().operation;
  std::array<std::span<const double>, 6> pose;
  for (std::size_t i = 0; i < pose.size(); ++i) {
    pose[i] = view.series(body_channels::pose[i].of(operation.load));
    if (pose[i].empty()) return {};
  }
  std::vector<Vector3> offsets;
  for (std::size_t i = range.first; i < range.last; ++i) {
    const Pose X_WB{rotation_from({pose[3][i], pose[4][i], pose[5][i]}), {pose[0][i], pose[1][i], pose[2][i]}};
    offsets.push_back(X_WB * operation.load_reference - operation.target);
  }
  return offsets;
}

/// The offsets in a set-down phase; empty in every other.
const std::vector<Vector3>& offsets_once(MetricRun& run, std::size_t phase) {
  return run.once("set-down offsets " + std::to_string(phase), [&] {
    const RunView& view = run.view();
    if (view.run().phases[phase].stage != Stage::set_down) return std::vector<Vector3>{};
    return reference_offsets(view, view.samples(phase));
  });
}

/// Largest of |f(sample in the run, offset)| in a set-down phase.
template <class F>
Peak largest_offset(MetricRun& run, const Phases& phases, F f) {
  Peak peak;
  const std::vector<Vector3>& offsets = offsets_once(run, phases.front());
  const std::size_t first = run.view().samples(phases.front()).first;
  for (std::size_t i = 0; i < offsets.size(); ++i)
    peak.take_larger(std::abs(f(first + i, offsets[i])), run.view().run().time[first + i]);
  return peak;
}

Peak departure_x(MetricRun& run, const std::string&, const Phases& phases) {
  return largest_offset(run, phases, [](std::size_t, const Vector3& offset) { return offset.x(); });
}

Peak departure_y(MetricRun& run, const std::string&, const Phases& phases) {
  return largest_offset(run, phases, [](std::size_t, const Vector3& offset) { return offset.y(); });
}

/// The angle of the load's z axis from the vertical: cos(tilt) = cos(roll) cos(pitch) for ZYX angles.
Peak largest_tilt(MetricRun& run, const std::string&, const Phases& phases) {
  const std::string& load = run.specification().operation.load;
  const auto roll = run.view().series(body_channels::roll.of(load)),
             pitch = run.view().series(body_channels::pitch.of(load));
  return largest_offset(run, phases, [&](std::size_t i, const Vector3&) {
    return std::acos(std::clamp(std::cos(roll[i]) * std::cos(pitch[i]), -1.0, 1.0));
  });
}

/// Largest departure in z from the planned descent until the load lands: height of the reference point against its
/// static height at the start of the phase minus the mean wire paid out since.
Peak departure_z(MetricRun& run, const std::string&, const Phases& phases) {
  const RunView& view = run.view();
  const Specification& s = view.specification();
  const std::size_t phase = phases.front();
  const std::vector<Vector3>& offsets = offsets_once(run, phase);
  Peak peak;
  std::vector<std::pair<std::span<const double>, double>> lengths;  // unstretched length and its static start
  for (const std::string& wire : hoist_wires(s)) {
    const std::string channel = wire_channels::unstretched.of(wire);
    if (const auto length = view.series(channel); !length.empty())
      lengths.emplace_back(length, view.static_value(phase, channel));
  }
  if (offsets.empty() || lengths.empty() || phase >= view.run().static_poses.size()) return peak;
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

Peak largest_turn(MetricRun& run, const std::string&, const Phases& phases) {
  const RunView& view = run.view();
  const std::string yaw = body_channels::yaw.of(view.specification().operation.load);
  const std::size_t last_pose = view.run().static_poses.empty() ? 0 : view.run().static_poses.size() - 1;
  const double landed = view.static_value(last_pose, yaw);
  Peak turn;
  if (offsets_once(run, phases.front()).empty() || std::isnan(landed)) return turn;
  for (const Peak& extreme : {view.maximum(yaw, phases), view.minimum(yaw, phases)})
    turn.take_larger(std::abs(std::remainder(extreme.value - landed, kTwoPi)), extreme.time);
  return turn;
}

Peak final_offset(MetricRun& run, const std::string&, const Phases&) {
  const RunView& view = run.view();
  if (view.phases_of({Stage::set_down}).empty() || view.run().status != RunStatus::completed || view.run().time.empty())
    return {};
  const std::size_t n = view.run().time.size();
  const std::vector<Vector3> end = reference_offsets(view, {n - 1, n});
  return end.empty() ? Peak{} : Peak{end[0].head<2>().norm(), view.run().time.back()};
}

using Value = Peak (*)(MetricRun&, const std::string&, const Phases&);

MetricRow set_down_row(const char* name, Quantity quantity, const char* description, Value value) {
  MetricRow row;
  row.name = name;
  row.quantity = quantity;
  row.description = description;
  row.over = OverPhases::largest;
  row.channels = [](ChannelSet& channels, const std::string&) {
    channels.add_pose(channels.specification().operation.load);
  };
  row.value = value;
  return row;
}

}  // namespace

std::vector<MetricRow> set_down_metrics() {
  std::vector<MetricRow> rows = {
      set_down_row("setdown_offset", Quantity::length,
                   "horizontal distance of the load's reference point from the target at the end", final_offset),
      set_down_row("setdown_movement_x", Quantity::length, "largest distance from the target in x while setting down",
                   departure_x),
      set_down_row("setdown_movement_y", Quantity::length, "largest distance from the target in y while setting down",
                   departure_y),
      set_down_row("setdown_movement_z", Quantity::length,
                   "largest departure from the planned descent, until the first contact with the target", departure_z),
      set_down_row("load_tilt_max", Quantity::angle, "largest tilt of the load from the vertical while setting down",
                   largest_tilt),
      set_down_row("load_yaw_max", Quantity::angle,
                   "largest plan rotation of the load from its landed heading while setting down", largest_turn),
  };
  rows[0].over = OverPhases::all_at_once;
  rows[0].by_phase = false;
  rows[3].channels = [](ChannelSet& channels, const std::string&) {
    channels.add_pose(channels.specification().operation.load);
    channels.add_hoist_wires({wire_channels::unstretched});
  };
  return rows;
}

}  // namespace stillhook
