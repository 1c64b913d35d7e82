#include "sim/operation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/statics.h"

namespace stillhook {
namespace {

std::string entry_of(const PhaseSpec& phase) { return "operation.phases." + phase.name; }

void check_limits_of(const DriveSpec& drive, const RateProfile& profile, const std::string& entry) {
  constexpr double kSlack = 1.0 + 1e-9;  // a profile may use its drive's limits to the full
  if (drive.speed_max > 0.0 && profile.peak_rate() > drive.speed_max * kSlack)
    throw SpecificationError(entry, "speed",
                             "drive '" + drive.name + "' is limited to " + std::to_string(drive.speed_max) +
                                 " per s, the profile needs " + std::to_string(profile.peak_rate()));
  if (drive.acceleration_max > 0.0 && profile.peak_acceleration() > drive.acceleration_max * kSlack)
    throw SpecificationError(entry, "ramp",
                             "drive '" + drive.name + "' is limited to " + std::to_string(drive.acceleration_max) +
                                 " per s2, the profile needs " + std::to_string(profile.peak_acceleration()) +
                                 ": a longer ramp or a lower speed is needed");
}

Vector3 point_in_world(const Model& model, const StaticPose& pose, const std::string& body, const Vector3& p_B) {
  const int i = model.body_index(body);
  return i == kWorld ? p_B : pose.bodies[static_cast<std::size_t>(i)] * p_B;
}

/// Mean length of the hoist falls in a static pose, m; 0 if there are none.
double fall_length(const Model& model, const StaticPose& pose) {
  double sum = 0.0;
  int count = 0;
  for (const WireSpec& wire : model.specification().wires) {
    if (wire.role != WireSpec::Role::hoist) continue;
    sum +=
        (point_in_world(model, pose, wire.from, wire.point_from) - point_in_world(model, pose, wire.to, wire.point_to))
            .norm();
    ++count;
  }
  return count ? sum / count : 0.0;
}

/// The move's profile with the period of its shaper worked out if it is not given: of the pendulum on the hoist falls,
/// as long as they are on average before and after the move.
ProfileSpec with_period(const Model& model, ProfileSpec spec, const StaticPose& before, const StaticPose& after,
                        const std::string& entry) {
  if (spec.shaper == ProfileSpec::Shaper::none || spec.shaper_period > 0.0) return spec;
  const double length = 0.5 * (fall_length(model, before) + fall_length(model, after));
  if (!(length > 0.0))
    throw SpecificationError(entry, "shaper_period",
                             "must be > 0 s, got 0: there is no hoist wire whose pendulum it could be taken from");
  spec.shaper_period = 2.0 * std::numbers::pi * std::sqrt(length / model.specification().sea.gravity);
  return spec;
}

// Moves the drives of `state` to the end of the phase and returns each move's travel.
std::vector<double> work_out_travels(const Model& model, const PhaseSpec& spec, SystemState& state) {
  std::vector<StaticGoal> goals;
  std::vector<double> before;
  for (const MoveSpec& move : spec.moves) {
    const int drive = model.drive_index(move.drive);
    before.push_back(state.drive[drive].position);
    if (move.travel) state.drive[drive].position += *move.travel;
    if (move.goal) goals.push_back({drive, *move.goal, move.goal_value});
  }
  solve_static(model, state, goals, entry_of(spec));
  std::vector<double> travels;
  for (std::size_t i = 0; i < spec.moves.size(); ++i)
    travels.push_back(spec.moves[i].travel ? *spec.moves[i].travel
                                           : state.drive[model.drive_index(spec.moves[i].drive)].position - before[i]);
  return travels;
}

}  // namespace

double Operation::planned_duration() const {
  double sum = 0.0;
  for (const Phase& phase : phases) sum += phase.duration;
  return sum;
}

namespace {

// The phase with its moves, whose travels are known, as are the poses that it starts from and ends in.
Phase timed_phase(const Model& model, const PhaseSpec& spec, const std::vector<double>& travels,
                  const StaticPose& before, const StaticPose& after) {
  Phase phase;
  phase.name = spec.name;
  phase.stage = spec.stage;
  phase.wait_for = spec.wait_for;
  if (spec.wait_for.type == EventSpec::Type::clear_of_contact) {
    phase.wait_contact = model.element_index(spec.wait_for.contact);
    if (phase.wait_contact < 0)
      throw SpecificationError(entry_of(spec), "wait_for", "there is no contact '" + spec.wait_for.contact + "'");
  }
  phase.duration = spec.duration;
  for (std::size_t i = 0; i < spec.moves.size(); ++i) {
    const MoveSpec& move = spec.moves[i];
    const std::string entry = entry_of(spec) + ".moves." + move.drive;
    Move m;
    m.drive = model.drive_index(move.drive);
    m.delay = move.delay;
    m.background = move.background;
    if (std::abs(travels[i]) > 0.0)
      m.profile = RateProfile(with_period(model, move.profile, before, after, entry), travels[i], move.speed);
    check_limits_of(model.specification().drives[m.drive], m.profile, entry);
    if (!m.background) phase.duration = std::max(phase.duration, m.delay + m.profile.duration());
    phase.moves.push_back(std::move(m));
  }
  return phase;
}

bool same_target(const CoordinateSpec& a, const CoordinateSpec& b) {
  return a.body == b.body && a.point == b.point && a.axis == b.axis && a.relative_to == b.relative_to &&
         a.joint == b.joint && a.wire == b.wire;
}

bool same_end(const MoveSpec& a, const MoveSpec& b) {
  return a.drive == b.drive && a.travel == b.travel && a.goal.has_value() == b.goal.has_value() &&
         (!a.goal || (same_target(*a.goal, *b.goal) && a.goal_value == b.goal_value));
}

}  // namespace

Operation build_operation(const Model& model) {
  Operation operation;
  SystemState state = model.initial_state();
  operation.static_poses.push_back(static_pose(model, state, "start"));
  for (const PhaseSpec& spec : model.specification().operation.phases) {
    state.phase = static_cast<int>(operation.phases.size());
    const std::vector<double> travels =
        spec.moves.empty() ? std::vector<double>{} : work_out_travels(model, spec, state);
    operation.static_poses.push_back(static_pose(model, state, spec.name));
    const auto after = operation.static_poses.end() - 1, before = after - 1;
    operation.phases.push_back(timed_phase(model, spec, travels, *before, *after));
  }
  return operation;
}

bool same_poses(const OperationSpec& a, const OperationSpec& b) {
  if (a.phases.size() != b.phases.size()) return false;
  for (std::size_t i = 0; i < a.phases.size(); ++i) {
    const auto &p = a.phases[i].moves, &q = b.phases[i].moves;
    if (p.size() != q.size() || !std::equal(p.begin(), p.end(), q.begin(), same_end)) return false;
  }
  return true;
}

Operation retimed_operation(const Model& model, const OperationSpec& spec, const Operation& like) {
  Operation operation;
  operation.static_poses = like.static_poses;
  for (std::size_t i = 0; i < spec.phases.size(); ++i) {
    std::vector<double> travels;
    for (const Move& move : like.phases[i].moves) travels.push_back(move.profile.travel());
    operation.phases.push_back(
        timed_phase(model, spec.phases[i], travels, like.static_poses[i], like.static_poses[i + 1]));
  }
  return operation;
}

std::vector<StaticPose> solve_poses(const Model& model) {
  std::vector<StaticPose> poses;
  for (const PoseSpec& spec : model.specification().poses) {
    SystemState state = model.initial_state();
    std::vector<StaticGoal> goals;
    for (const auto& setting : spec.drives) state.drive[model.drive_index(setting.drive)].position = setting.position;
    for (const auto& hold : spec.holds) {
      CoordinateSpec coordinate;
      coordinate.joint = hold.joint;
      goals.push_back({model.drive_index(hold.drive), coordinate, hold.coordinate});
    }
    for (const auto& goal : spec.goals) goals.push_back({model.drive_index(goal.drive), goal.coordinate, goal.value});
    solve_static(model, state, goals, "poses." + spec.name);
    poses.push_back(static_pose(model, state, spec.name));
  }
  return poses;
}

}  // namespace stillhook
