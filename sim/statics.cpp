#include "sim/statics.h"

#include <cmath>

#include "sim/multibody/equilibrium.h"

namespace stillhook {
namespace {

constexpr double kCalm = -1.0;  // s: before the waves start
// Drive steps for the slope of a goal, m: a small one where the drive has a grip; larger ones, either way, where it
// first has to take up slack. A slope below no_grip() is none.
constexpr double kProbes[] = {1e-3, 0.3, -0.3, 3.0, -3.0};
constexpr double kLargestStep = 3.0;  // of a drive in one iteration, m
constexpr int kMaxGoalSteps = 60;
constexpr int kHalvings = 6;  // of a step of the drives that leaves the region where an equilibrium is found

std::string describe(const CoordinateSpec& c) {
  if (!c.joint.empty()) return "coordinate of joint '" + c.joint + "'";
  if (!c.wire.empty()) return "tension of wire '" + c.wire + "'";
  return std::string(1, "xyz"[c.axis]) + " of a point of '" + c.body + "'";
}

EquilibriumReport try_to_settle(const Model& model, SystemState& state, bool close) {
  const double t = state.t;
  state.t = kCalm;
  const EquilibriumReport report = solve_equilibrium(model.system(), state, close);
  state.t = t;
  return report;
}

void settle(const Model& model, SystemState& state, const std::string& entry, bool close) {
  const EquilibriumReport report = try_to_settle(model, state, close);
  if (!report.converged)
    throw SpecificationError(entry, "",
                             "no static equilibrium found: after " + std::to_string(report.iterations) +
                                 " iterations '" + report.worst_body + "' is out of balance by " +
                                 std::to_string(report.residual) + " of the largest weight");
}

// Tolerance of a goal in its own unit, m, rad or N: two solutions are subtracted where derivatives are wanted.
double tolerance_of(const StaticGoal& goal) { return goal.coordinate.wire.empty() ? 1e-10 : 1e-3; }

// Of a drive on a coordinate, per m: rounding alone gives less than a newton of tension.
double no_grip(const StaticGoal& goal) { return goal.coordinate.wire.empty() ? 5e-3 : 10.0; }

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
    const auto it = values.find(c.wire + ".tension");
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
  settle(model, state, entry, close);
  if (goals.empty()) return;
  const int n = static_cast<int>(goals.size());
  const auto miss = [&](const SystemState& s) {
    VectorX f(n);
    for (int i = 0; i < n; ++i) f[i] = coordinate_value(model, s, goals[i].coordinate) - goals[i].value;
    return f;
  };
  VectorX f = miss(state);
  for (int iteration = 0; iteration < kMaxGoalSteps; ++iteration) {
    bool reached = true;
    for (int i = 0; i < n; ++i) reached = reached && std::abs(f[i]) < tolerance_of(goals[i]);
    if (reached) return;
    MatrixX slope = MatrixX::Zero(n, n);
    for (int j = 0; j < n; ++j) {
      for (const double by : kProbes) {
        SystemState probe = state;
        probe.drive[goals[j].drive].position += by;
        if (!try_to_settle(model, probe, close).converged) continue;
        slope.col(j) = (miss(probe) - f) / by;
        if (std::abs(slope(j, j)) > no_grip(goals[j])) break;
      }
      // A load that hangs free keeps its wires' tension however far it is lowered: on until it lands, or is off it.
      if (!goals[j].coordinate.wire.empty() && std::abs(slope(j, j)) <= no_grip(goals[j]))
        slope(j, j) = std::abs(f[j]) / kLargestStep;
    }
    VectorX step = -slope.fullPivLu().solve(f);
    if (!step.allFinite()) break;
    step *= std::min(1.0, kLargestStep / std::max(1e-12, step.cwiseAbs().maxCoeff()));
    const SystemState here = state;
    for (int halving = 0;; ++halving, step *= 0.5) {
      state = here;
      for (int j = 0; j < n; ++j) state.drive[goals[j].drive].position += step[j];
      if (halving < kHalvings && !try_to_settle(model, state, close).converged) continue;
      if (halving == kHalvings) settle(model, state, entry, close);
      break;
    }
    f = miss(state);
  }
  for (int i = 0; i < n; ++i)
    if (std::abs(f[i]) >= tolerance_of(goals[i]))
      throw SpecificationError(entry, "",
                               "cannot bring the " + describe(goals[i].coordinate) + " to " +
                                   std::to_string(goals[i].value) + " with drive '" +
                                   model.specification().drives[goals[i].drive].name + "': it ends at " +
                                   std::to_string(f[i] + goals[i].value));
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
