#include "results/crane_use.h"

#include <map>

#include "results/metrics/channel_set.h"
#include "sim/crane_parts.h"
#include "sim/lifting/wire.h"
#include "sim/run_channels.h"
#include "sim/spatial/pose.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

/// The bodies whose poses say the radius of a crane.
std::vector<std::string> bodies_of(const Specification& s, const std::string& crane) {
  std::vector<std::string> bodies;
  crane_radius(s, crane, [&](const std::string& body, const Vector3& point) {
    if (body != "world") bodies.push_back(body);
    return point;
  });
  return bodies;
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

void add_crane_channels(ChannelSet& channels, const std::string& crane) {
  const Specification& s = channels.specification();
  for (const std::string& body : bodies_of(s, crane)) channels.add_pose(body);
  for (const std::string& wire : hoist_wires_of(s, crane)) channels.add(wire_channels::tension.of(wire));
}

CraneUse crane_use(const RunView& view, const std::string& crane) {
  const Specification& s = view.specification();
  CraneUse out;
  out.curve = curve_of(s, crane);
  if (!out.curve) return out;
  std::map<std::string, std::array<std::span<const double>, 6>> poses;
  for (const std::string& body : bodies_of(s, crane))
    for (std::size_t i = 0; i < 6; ++i) {
      poses[body][i] = view.series(body_channels::pose[i].of(body));
      if (poses[body][i].empty()) return out;
    }
  const HookLoad load(view, hoist_wires_of(s, crane), out.curve->basis);
  if (!load.recorded()) return out;
  for (std::size_t p = 0; p < view.run().phases.size(); ++p) {
    const RunView::Range range = view.samples(p);
    for (std::size_t i = std::max(range.first, out.radius.size()); i < range.last; ++i) {
      const auto place = [&](const std::string& body, const Vector3& point) -> Vector3 {
        if (body == "world") return point;
        const auto& [x, y, z, roll, pitch, yaw] = poses.at(body);
        return Vector3(x[i], y[i], z[i]) + rotation_from({roll[i], pitch[i], yaw[i]}) * point;
      };
      out.radius.push_back(*crane_radius(s, crane, place));
      out.load.push_back(load.at(p, i));
      out.use.push_back(out.load.back() / nearest_capacity(*out.curve, out.radius.back()));
    }
  }
  return out;
}

}  // namespace stillhook
