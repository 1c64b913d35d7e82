#include "results/crane_use.h"

#include <algorithm>
#include <array>

#include "results/metrics/channel_set.h"
#include "sim/lifting/wire.h"
#include "sim/run_channels.h"
#include "sim/spatial/pose.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

/// The mean of several points along a run; empty if one of their bodies was not recorded.
std::vector<Vector3> mean_path(const RunView& view, const std::vector<PlaceOnBody>& places) {
  std::vector<Vector3> mean;
  for (const PlaceOnBody& place : places) {
    const std::vector<Vector3> path = path_of(view, place);
    if (path.empty()) return path;
    mean.resize(path.size(), Vector3::Zero());
    for (std::size_t i = 0; i < path.size(); ++i) mean[i] += path[i] / static_cast<double>(places.size());
  }
  return mean;
}

/// Sum of the tensions at sample i, as they are or as they would be at rest.
class HookLoad {
 public:
  HookLoad(const RunView& view, const std::vector<std::string>& wires, CraneCurveSpec::Basis basis)
      : view_(view), basis_(basis) {
    for (const std::string& wire : wires) {
      channels_.push_back(wire_channels::tension.of(wire));
      series_.push_back(view.series(channels_.back()));
    }
  }

  bool recorded() const {
    for (const auto& values : series_)
      if (values.empty()) return false;
    return !series_.empty();
  }

  double at(std::size_t phase, std::size_t i) const {
    double sum = 0.0;
    for (std::size_t w = 0; w < series_.size(); ++w)
      sum += basis_ == CraneCurveSpec::Basis::dynamic ? series_[w][i]
                                                      : view_.planned_at(phase, view_.run().time[i], channels_[w]);
    return sum;
  }

 private:
  const RunView& view_;
  CraneCurveSpec::Basis basis_;
  std::vector<std::string> channels_;
  std::vector<std::span<const double>> series_;
};

}  // namespace

std::vector<Vector3> path_of(const RunView& view, const PlaceOnBody& place) {
  std::vector<Vector3> path;
  if (place.body == "world") return std::vector<Vector3>(view.run().time.size(), place.point);
  std::array<std::span<const double>, 6> pose;
  for (std::size_t i = 0; i < pose.size(); ++i) {
    pose[i] = view.series(body_channels::pose[i].of(place.body));
    if (pose[i].empty()) return path;
  }
  const auto& [x, y, z, roll, pitch, yaw] = pose;
  for (std::size_t i = 0; i < x.size(); ++i)
    path.push_back(Vector3(x[i], y[i], z[i]) + rotation_from({roll[i], pitch[i], yaw[i]}) * place.point);
  return path;
}

void add_crane_channels(ChannelSet& channels, const std::string& crane) {
  const Specification& s = channels.specification();
  const CraneReach reach = crane_reach(s, crane);
  for (const auto& places : {reach.axes, reach.hooks})
    for (const PlaceOnBody& place : places) channels.add_pose(place.body);
  for (const std::string& wire : hoist_wires_of(s, crane)) channels.add(wire_channels::tension.of(wire));
}

CraneUse crane_use(const RunView& view, const std::string& crane) {
  const Specification& s = view.specification();
  CraneUse out;
  out.curve = curve_of(s, crane);
  if (!out.curve) return out;
  const CraneReach reach = crane_reach(s, crane);
  const std::vector<Vector3> axis = mean_path(view, reach.axes), hook = mean_path(view, reach.hooks);
  const HookLoad load(view, hoist_wires_of(s, crane), out.curve->basis);
  if (axis.empty() || hook.empty() || !load.recorded()) return out;
  for (std::size_t p = 0; p < view.run().phases.size(); ++p) {
    const RunView::Range range = view.samples(p);
    for (std::size_t i = std::max(range.first, out.radius.size()); i < range.last; ++i) {
      out.radius.push_back((hook[i] - axis[i]).head<2>().norm());
      out.load.push_back(load.at(p, i));
      out.use.push_back(out.load.back() / nearest_capacity(*out.curve, out.radius.back()));
    }
  }
  return out;
}

}  // namespace stillhook
