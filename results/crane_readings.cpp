#include "results/crane_readings.h"

#include <algorithm>
#include <cmath>

#include "results/crane_use.h"
#include "results/html.h"
#include "sim/crane_parts.h"
#include "sim/lifting/wire.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr double kSameRadius = 0.25, kSameElevation = 0.5;  // m and deg: booms no further apart go together

const JointSpec* joint_below(const Specification& s, const std::string& body) {
  const auto found = std::find_if(s.joints.begin(), s.joints.end(), [&](auto& j) { return j.child == body; });
  return found == s.joints.end() ? nullptr : &*found;
}

struct Boom {
  std::string name, vessel;
  std::vector<std::string> wires;
  std::vector<double> radius, elevation;  // m, deg; empty for a boom without a hinge
};

Vector3 mean_wire_end(const Specification& s, const std::string& boom) {
  Vector3 sum = Vector3::Zero();
  int count = 0;
  for (const WireSpec& wire : s.wires)
    if (wire.role == WireSpec::Role::hoist && wire.from == boom) sum += wire.point_from, ++count;
  return count > 0 ? Vector3(sum / count) : sum;
}

Boom boom_along(const RunView& view, const std::string& name) {
  const Specification& s = view.specification();
  Boom boom{name, vessel_under(s, name), hoist_wires_of(s, name), {}, {}};
  const JointSpec* hinge = joint_below(s, name);
  if (!hinge) return boom;
  const std::optional<PlaceOnBody> axis = boom_axis(s, name);
  if (!axis) return boom;
  const std::vector<Vector3> ends = path_of(view, {name, mean_wire_end(s, name)}),
                             hinges = path_of(view, {hinge->parent, hinge->point_on_parent}),
                             axes = path_of(view, *axis);
  if (ends.empty() || hinges.size() != ends.size() || axes.size() != ends.size()) return boom;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    boom.radius.push_back((ends[i] - axes[i]).head<2>().norm());
    const Vector3 along = ends[i] - hinges[i];
    boom.elevation.push_back(std::atan2(along.z(), along.head<2>().norm()) / kDegree);
  }
  return boom;
}

bool together(const Boom& a, const Boom& b) {
  if (a.vessel != b.vessel || a.radius.size() != b.radius.size()) return false;
  for (std::size_t i = 0; i < a.radius.size(); ++i)
    if (std::abs(a.radius[i] - b.radius[i]) > kSameRadius || std::abs(a.elevation[i] - b.elevation[i]) > kSameElevation)
      return false;
  return true;
}

std::vector<double> sum_of_tensions(const RunView& view, const std::vector<std::string>& wires) {
  std::vector<double> sum;
  for (const std::string& wire : wires) {
    const auto tension = view.series(wire_channels::tension.of(wire));
    if (tension.empty()) continue;
    sum.resize(tension.size(), 0.0);
    for (std::size_t i = 0; i < tension.size(); ++i) sum[i] += tension[i] / (1000.0 * kStandardGravity);
  }
  return sum;
}

}  // namespace

std::vector<CraneReading> crane_readings(const RunView& view) {
  const Specification& s = view.specification();
  std::vector<Boom> cranes;
  std::vector<std::string> all;
  for (const std::string& name : boom_bodies(s)) {
    Boom boom = boom_along(view, name);
    all.insert(all.end(), boom.wires.begin(), boom.wires.end());
    const auto same = std::find_if(cranes.begin(), cranes.end(), [&](const Boom& c) { return together(c, boom); });
    if (same == cranes.end())
      cranes.push_back(std::move(boom));
    else
      same->wires.insert(same->wires.end(), boom.wires.begin(), boom.wires.end());
  }
  std::vector<CraneReading> out;
  const auto add = [&](std::string label, const char* unit, int decimals, std::vector<double> values) {
    if (!values.empty()) out.push_back({std::move(label), unit, decimals, std::move(values)});
  };
  const bool several = cranes.size() > 1;
  add("hook load", "t", 0, sum_of_tensions(view, all));
  for (Boom& crane : cranes) {
    // A crane is called after its vessel, unless it shares that with another.
    const auto beside = std::count_if(cranes.begin(), cranes.end(), [&](auto& c) { return c.vessel == crane.vessel; });
    const std::string of =
        several ? " " + readable_name(beside > 1 || crane.vessel == "world" ? crane.name : crane.vessel) : "";
    if (several) add("hook load" + of, "t", 0, sum_of_tensions(view, crane.wires));
    add("radius" + of, "m", 1, std::move(crane.radius));
    add("boom angle" + of, "°", 1, std::move(crane.elevation));
  }
  const std::vector<std::string> judged = cranes_with_curves(s);
  for (const std::string& crane : judged) {
    std::vector<double> use = crane_use(view, crane).use;
    for (double& share : use) share *= 100.0;
    add("crane use" + (judged.size() > 1 ? " " + readable_name(crane) : ""), "%", 0, std::move(use));
  }
  return out;
}

}  // namespace stillhook
