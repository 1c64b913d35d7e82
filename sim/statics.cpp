#include "sim/statics.h"

#include "sim/lifting/wire.h"
#include "sim/multibody/drive_path.h"
#include "sim/static_goals.h"

namespace stillhook {
namespace {

constexpr double kStillWater = -1.0;  // s: before the waves start

}  // namespace

double coordinate_value(const Model& model, const SystemState& state, const CoordinateSpec& c) {
  const MultibodySystem& system = model.system();
  if (!c.joint.empty()) {
    for (const Joint& joint : system.joints)
      if (joint.name == c.joint) return joint.coordinate(state.instant());
    throw SpecificationError("coordinate", "joint", "there is no joint '" + c.joint + "'");
  }
  if (!c.wire.empty()) {
    const auto values = channel_values(model, state);
    const auto it = values.find(wire_channels::tension.of(c.wire));
    if (it == values.end()) throw SpecificationError("coordinate", "wire", "there is no wire '" + c.wire + "'");
    return it->second;
  }
  const int body = model.body_index(c.body);
  Vector3 p = pose_of(state.body[body], system.bodies[body]) * c.point;
  const int other = c.relative_to.empty() ? kWorld : model.body_index(c.relative_to);
  if (other != kWorld) p = pose_of(state.body[other], system.bodies[other]).inverse() * p;
  return p[c.axis];
}

void solve_static(const Model& model, SystemState& state, const std::vector<StaticGoal>& goals,
                  const std::string& entry, bool close) {
  const double t = state.t;
  state.t = kStillWater;
  const EquilibriumReport report = settle_stably(model.system(), state, close);
  if (!report.converged) refuse_without_equilibrium(model.system(), state, report, entry);
  reach_goals(model, state, goals, entry);
  state.t = t;
}

void move_static(const Model& model, SystemState& state, const std::vector<DriveState>& to,
                 const std::vector<StaticGoal>& goals, const std::string& entry) {
  const double t = state.t;
  state.t = kStillWater;
  const EquilibriumReport report = follow_drives(model.system(), state, to);
  if (!report.converged) refuse_without_equilibrium(model.system(), state, report, entry);
  reach_goals(model, state, goals, entry);
  state.t = t;
}

StaticPose static_pose(const Model& model, const SystemState& state, const std::string& name) {
  StaticPose pose;
  pose.name = name;
  for (std::size_t i = 0; i < state.body.size(); ++i)
    pose.bodies.push_back(pose_of(state.body[i], model.system().bodies[i]));
  for (const DriveState& d : state.drive) pose.drives.push_back(d.position);
  pose.values = channel_values(model, state);
  return pose;
}

}  // namespace stillhook
