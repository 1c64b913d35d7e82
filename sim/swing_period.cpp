#include "sim/swing_period.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/lifting/contact.h"
#include "sim/modes.h"
#include "sim/statics.h"

namespace stillhook {
namespace {

constexpr double kNoWay = 1e-3;  // m: a load that a move takes no further swings either way

Vector3 wire_end(const Model& model, const SystemState& state, const std::string& body, const Vector3& p_B) {
  const int i = model.body_index(body);
  if (i == kWorld) return p_B;
  const BodyKinematics& b = state.body[static_cast<std::size_t>(i)];
  return b.p_WC + b.R_WB * (p_B - model.system().bodies[static_cast<std::size_t>(i)].cog);
}

/// Mean length of the hoist wires, m; 0 if there are none.
double fall_length(const Model& model, const SystemState& state) {
  double sum = 0.0;
  int count = 0;
  for (const WireSpec& wire : model.specification().wires) {
    if (wire.role != WireSpec::Role::hoist) continue;
    sum += (wire_end(model, state, wire.from, wire.point_from) - wire_end(model, state, wire.to, wire.point_to)).norm();
    ++count;
  }
  return count ? sum / count : 0.0;
}

/// Whether the load, in an equilibrium, touches nothing that it could stand on.
bool hangs(const Model& model, const SystemState& state) {
  const StaticPose pose = static_pose(model, state, "");
  for (const ContactSpec& contact : model.specification().contacts)
    if (contact.body == model.specification().operation.load) {
      const auto force = pose.values.find(contact_channels::force.of(contact));
      if (force != pose.values.end() && force->second > 0.0) return false;
    }
  return true;
}

/// Of the load's modes in an equilibrium, for displacements along `way` (horizontal shares of x and y); 0 without one.
double modal_period(const ModalAnalysis& modes, const SystemState& state, int load, const Eigen::Vector2d& way) {
  const std::vector<Mode> all = modes.at(state, false);
  double period = 0.0;
  for (int axis = 0; axis < 2; ++axis) {
    if (way[axis] == 0.0 || all.empty()) continue;
    const double of_axis = period_of(all, load, axis);
    if (!std::isfinite(of_axis)) return 0.0;
    period += way[axis] * of_axis;
  }
  return period;
}

}  // namespace

double swing_period(const Model& model, const SystemState& before, const SystemState& after) {
  const double length = 0.5 * (fall_length(model, before) + fall_length(model, after));
  if (!(length > 0.0)) return 0.0;
  const double of_falls = 2.0 * std::numbers::pi * std::sqrt(length / model.specification().sea.gravity);
  if (model.specification().operation.load.empty()) return of_falls;
  const int load = model.body_index(model.specification().operation.load);
  const std::size_t i = static_cast<std::size_t>(load);
  const Vector3 moved = after.body[i].p_WC - before.body[i].p_WC;
  const Eigen::Vector2d squares = moved.head<2>().cwiseAbs2();
  const Eigen::Vector2d way =
      squares.sum() > kNoWay * kNoWay ? Eigen::Vector2d(squares / squares.sum()) : Eigen::Vector2d(0.5, 0.5);
  const ModalAnalysis modes(model);
  double sum = 0.0;
  int count = 0;
  for (const SystemState* state : {&before, &after}) {
    if (!hangs(model, *state)) continue;
    const double period = modal_period(modes, *state, load, way);
    if (!(period > 0.0)) continue;
    sum += period;
    ++count;
  }
  return count ? sum / count : of_falls;
}

}  // namespace stillhook
