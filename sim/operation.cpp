#include "sim/operation.h"

#include <algorithm>
#include <cmath>

#include "sim/drive_unit.h"
#include "sim/lifting/contact.h"
#include "sim/multibody/equilibrium.h"
#include "sim/number_text.h"
#include "sim/sea/wave_record.h"
#include "sim/spatial/constants.h"
#include "sim/statics.h"
#include "sim/swing_period.h"

namespace stillhook {
namespace {

std::string entry_of(const PhaseSpec& phase) { return "operation.phases." + phase.name; }

/// A rate and an acceleration of a drive in the units of its keys.
struct KeyUnits {
  double rate, acceleration;  // per SI
  const char *rate_unit, *acceleration_unit;
};

KeyUnits key_units(DriveMotion motion) {
  switch (motion) {
    case DriveMotion::angle:
      return {1.0 / kDegree, 1.0 / kDegree, " deg/s", " deg/s2"};
    case DriveMotion::share:
      return {60.0, 1.0, " share/min", " share/s2"};
    case DriveMotion::length:
      break;
  }
  return {60.0, 1.0, " m/min", " m/s2"};
}

void check_limits_of(const Model& model, const DriveSpec& drive, const RateProfile& profile, const std::string& entry) {
  constexpr double kSlack = 1.0 + 1e-9;  // a profile may use its drive's limits to the full
  const KeyUnits unit = key_units(drive_motion(model.specification(), drive));
  const auto rate = [&](double value) { return number_text(value * unit.rate) + unit.rate_unit; };
  const auto acceleration = [&](double v) { return number_text(v * unit.acceleration) + unit.acceleration_unit; };
  if (drive.speed_max > 0.0 && profile.peak_rate() > drive.speed_max * kSlack)
    throw SpecificationError(entry, "speed",
                             "drive '" + drive.name + "' is limited to " + rate(drive.speed_max) +
                                 ", the profile needs " + rate(profile.peak_rate()));
  if (drive.acceleration_max > 0.0 && profile.peak_acceleration() > drive.acceleration_max * kSlack)
    throw SpecificationError(entry, "ramp",
                             "drive '" + drive.name + "' is limited to " + acceleration(drive.acceleration_max) +
                                 ", the profile needs " + acceleration(profile.peak_acceleration()) +
                                 ": a longer ramp or a lower speed is needed");
}

/// The move's profile with the period of its shaper worked out if it is not given: of the load's swing, between an
/// equilibrium before the move and one after it.
ProfileSpec with_period(const Model& model, ProfileSpec spec, const SystemState& before, const SystemState& after,
                        const std::string& entry) {
  if (spec.shaper == ProfileSpec::Shaper::none || spec.shaper_period > 0.0) return spec;
  spec.shaper_period = swing_period(model, before, after);
  if (!(spec.shaper_period > 0.0))
    throw SpecificationError(entry, "shaper_period",
                             "must be > 0 s, got 0: there is no hoist wire whose pendulum it could be taken from");
  return spec;
}

bool same_target(const CoordinateSpec& a, const CoordinateSpec& b) {
  return a.body == b.body && a.point == b.point && a.axis == b.axis && a.relative_to == b.relative_to &&
         a.joint == b.joint && a.wire == b.wire;
}

bool same_end(const MoveSpec& a, const MoveSpec& b) {
  return a.drive == b.drive && a.travel == b.travel && a.goal.has_value() == b.goal.has_value() &&
         (!a.goal || (same_target(*a.goal, *b.goal) && a.goal_value == b.goal_value));
}

// What a phase asks of its end: drives moved by their travels, and goals.
std::vector<StaticGoal> move_drives(const Model& model, const PhaseSpec& spec, SystemState& state) {
  std::vector<StaticGoal> goals;
  for (const MoveSpec& move : spec.moves) {
    const int drive = model.drive_index(move.drive);
    if (move.travel) state.drive[drive].position += *move.travel;
    if (move.goal) goals.push_back({drive, *move.goal, move.goal_value});
  }
  return goals;
}

std::vector<double> travels_between(const Model& model, const PhaseSpec& spec, const SystemState& before,
                                    const SystemState& after) {
  std::vector<double> travels;
  std::vector<DriveState> at = before.drive;
  for (const MoveSpec& move : spec.moves) {
    DriveState& drive = at[static_cast<std::size_t>(model.drive_index(move.drive))];
    const double to = after.drive[static_cast<std::size_t>(model.drive_index(move.drive))].position;
    travels.push_back(move.travel ? *move.travel : to - drive.position);
    drive.position += travels.back();
  }
  return travels;
}

// The end of the phase that begins in `state`.
SystemState end_of_phase(const Model& model, const PhaseSpec& spec, SystemState state) {
  if (spec.moves.empty()) return state;
  SystemState moved = state;
  const std::vector<StaticGoal> goals = move_drives(model, spec, moved);
  move_static(model, state, moved.drive, goals, entry_of(spec));
  return state;
}

bool same_positions(const SystemState& a, const SystemState& b) {
  for (std::size_t i = 0; i < a.body.size(); ++i)
    if (a.body[i].R_WB != b.body[i].R_WB || a.body[i].p_WC != b.body[i].p_WC) return false;
  for (std::size_t d = 0; d < a.drive.size(); ++d)
    if (a.drive[d].position != b.drive[d].position) return false;
  return true;
}

// True if a contact bears at `after` that did not at `before`: its friction then holds from where it was touched on the
// way, and that way has to be gone again.
bool lands(const Model& model, const SystemState& before, const SystemState& after) {
  SystemWorkspace work = model.system().make_workspace();
  const auto bears = [&](int element, SystemState state) {
    work.forces.clear();
    const Memory m = model.system().memory(element, state, work);
    model.system().elements[static_cast<std::size_t>(element)]->add_forces(state.instant(), 0.0, m, work.forces);
    return !work.forces.value().isZero(0.0);
  };
  for (std::size_t k = 0; k < model.system().elements.size(); ++k) {
    const int e = static_cast<int>(k);
    if (dynamic_cast<const Contact*>(model.system().elements[k].get()) && !bears(e, before) && bears(e, after))
      return true;
  }
  return false;
}

// Goes through the phases of one lift beside those of another that differs little from it.
class Neighbour {
 public:
  Neighbour(const Model& model, const Model& other, const Operation& like)
      : model_(model),
        other_(other),
        like_(like),
        together_(same_positions(model.initial_state(), other.initial_state()) &&
                  same_statics(model.system(), other.system(), model.initial_state())) {}

  /// The end of phase `p` that begins in `before`.
  SystemState end_of_phase(std::size_t p, const SystemState& before) {
    const PhaseSpec &spec = model_.specification().operation.phases[p],
                    &theirs = other_.specification().operation.phases[p];
    if (spec.moves.empty()) return before;
    const SystemState& there = like_.equilibria[p + 1];
    SystemState state = before;
    const std::vector<StaticGoal> goals = move_drives(model_, spec, state);
    together_ = together_ && same_ends(spec, theirs, before, there);
    if (together_) {
      state = there;
      SystemWorkspace work = model_.system().make_workspace();
      model_.system().settle_elements(state, work);
      return state;
    }
    if (lands(other_, like_.equilibria[p], there)) return stillhook::end_of_phase(model_, spec, before);
    for (const StaticGoal& goal : goals) state.drive[goal.drive] = there.drive[goal.drive];
    state.body = there.body;
    state.lambda = there.lambda;
    try {
      solve_static(model_, state, goals, entry_of(spec), true);
      return state;
    } catch (const SpecificationError&) {
      return stillhook::end_of_phase(model_, spec, before);  // not so near after all
    }
  }

 private:
  // True if the other's end of the phase is this lift's too.
  bool same_ends(const PhaseSpec& spec, const PhaseSpec& theirs, const SystemState& before,
                 const SystemState& there) const {
    if (spec.moves.size() != theirs.moves.size()) return false;
    for (std::size_t i = 0; i < spec.moves.size(); ++i) {
      if (!same_end(spec.moves[i], theirs.moves[i])) return false;
      if (spec.moves[i].goal &&
          coordinate_value(model_, there, *spec.moves[i].goal) != coordinate_value(other_, there, *spec.moves[i].goal))
        return false;
    }
    return before.element_state.size() == there.element_state.size() &&
           same_statics(model_.system(), other_.system(), there);
  }

  const Model& model_;
  const Model& other_;
  const Operation& like_;
  bool together_;  // so far
};

}  // namespace

double Operation::planned_duration() const {
  double sum = 0.0;
  for (const Phase& phase : phases) sum += phase.duration;
  return sum;
}

namespace {

// The phase with its moves, whose travels are known, as are the equilibria that it starts from and ends in.
Phase timed_phase(const Model& model, const PhaseSpec& spec, const std::vector<double>& travels,
                  const SystemState& before, const SystemState& after) {
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
    check_limits_of(model, model.specification().drives[m.drive], m.profile, entry);
    if (!m.background) phase.duration = std::max(phase.duration, m.delay + m.profile.duration());
    phase.moves.push_back(std::move(m));
  }
  return phase;
}

}  // namespace

namespace {

// What was measured of the wind says nothing of what came after.
void refuse_longer_than_wind_record(const WindSpec& wind, double duration) {
  if (!wind.blows() || wind.gusts != WindSpec::Gusts::record || !wind.record) return;
  if (duration <= wind.record->length()) return;
  throw SpecificationError("wind", "record_file",
                           "lasts " + number_text(wind.record->length()) + " s, the run " + number_text(duration) +
                               " s without waiting for events: give a longer record or a spectrum");
}

// A sea made of a record repeats after it, which no sea does.
void refuse_longer_than_record(const Model& model, const Operation& operation) {
  const double run = std::max(operation.planned_duration(), 0.0);
  const double end = model.specification().solver.max_duration;
  refuse_longer_than_wind_record(model.specification().wind, end > 0.0 ? (run > 0.0 ? std::min(run, end) : end) : run);
  const SeaStateSpec* sea = model.specification().sea.active_state();
  if (!sea || sea->type != SeaStateSpec::Type::record || !sea->record) return;
  const double length = record_length(*sea->record);
  if (operation.planned_duration() <= length) return;
  throw SpecificationError("sea.states." + sea->name, "record",
                           "lasts " + number_text(length) + " s, the operation " +
                               number_text(operation.planned_duration()) +
                               " s without waiting for events: the sea would repeat");
}

// Phase after phase; `end_of_phase` gives the equilibrium at the end of a phase from that before it.
template <class F>
Operation with_phases(const Model& model, std::size_t phases, double until, F end_of_phase) {
  Operation operation;
  const auto add_pose = [&](const SystemState& state, const std::string& name) {
    operation.static_poses.push_back(static_pose(model, state, name));
    operation.equilibria.push_back(state);
  };
  add_pose(model.initial_state(), "start");
  for (std::size_t p = 0; p < phases; ++p) {
    if (until > 0.0 && operation.planned_duration() >= until) break;
    const PhaseSpec& spec = model.specification().operation.phases[p];
    SystemState before = operation.equilibria.back();
    before.phase = static_cast<int>(p);
    const SystemState after = end_of_phase(p, before);
    add_pose(after, spec.name);
    operation.phases.push_back(timed_phase(model, spec, travels_between(model, spec, before, after),
                                           operation.equilibria[p], operation.equilibria[p + 1]));
  }
  refuse_longer_than_record(model, operation);
  return operation;
}

}  // namespace

Operation build_operation(const Model& model, double until) {
  const std::vector<PhaseSpec>& phases = model.specification().operation.phases;
  return with_phases(model, phases.size(), until,
                     [&](std::size_t p, const SystemState& before) { return end_of_phase(model, phases[p], before); });
}

Operation build_operation_like(const Model& model, const Model& other, const Operation& like) {
  const std::size_t phases = std::min(like.phases.size(), model.specification().operation.phases.size());
  Neighbour neighbour(model, other, like);
  return with_phases(model, phases, 0.0,
                     [&](std::size_t p, const SystemState& before) { return neighbour.end_of_phase(p, before); });
}

std::vector<Move> jumps_to(const std::vector<DriveState>& drives) {
  constexpr double kAtOnce = 1e9;  // travels per s
  std::vector<Move> jumps;
  for (std::size_t d = 0; d < drives.size(); ++d) {
    const double position = drives[d].position;
    if (position == 0.0) continue;
    Move move;
    move.drive = static_cast<int>(d);
    ProfileSpec step;
    step.shape = ProfileSpec::Shape::trapezoid;
    step.ramp = 0.0;
    move.profile = RateProfile(step, position, kAtOnce * std::abs(position));
    move.background = true;
    jumps.push_back(std::move(move));
  }
  return jumps;
}

Operation part_of(const Operation& whole, const OperationPart& part) {
  Operation operation;
  const std::size_t last = static_cast<std::size_t>(part.phase);
  for (std::size_t p = 0; p <= last; ++p) {
    Phase phase = whole.phases[p];
    phase.wait_for = {};
    phase.wait_contact = -1;
    if (p < last) phase.duration = 0.0;
    if (p == last && part.hold > 0.0) phase.duration = part.hold;
    if (p < last || part.hold > 0.0) phase.moves.clear();
    operation.phases.push_back(std::move(phase));
  }
  // The drives jump in the first instant; the state to begin with is there already.
  for (Move& jump : jumps_to(whole.equilibria[part.begins_at()].drive))
    operation.phases.front().moves.push_back(std::move(jump));
  operation.static_poses.assign(whole.static_poses.begin(), whole.static_poses.begin() + part.phase + 2);
  operation.equilibria.assign(whole.equilibria.begin(), whole.equilibria.begin() + part.phase + 2);
  if (part.hold > 0.0) {  // it begins as it ends
    operation.static_poses[last] = operation.static_poses[last + 1];
    operation.equilibria[last] = operation.equilibria[last + 1];
  }
  return operation;
}

SystemState start_of(const Operation& whole, const OperationPart& part) {
  SystemState state = whole.equilibria[part.begins_at()];
  state.t = 0.0;
  state.phase = part.phase;
  for (DriveState& drive : state.drive) drive.rate = 0.0;
  return state;
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
  operation.equilibria = like.equilibria;
  for (std::size_t i = 0; i < like.phases.size(); ++i) {
    std::vector<double> travels;
    for (const Move& move : like.phases[i].moves) travels.push_back(move.profile.travel());
    operation.phases.push_back(
        timed_phase(model, spec.phases[i], travels, like.equilibria[i], like.equilibria[i + 1]));
  }
  return operation;
}

std::vector<StaticPose> solve_poses(const Model& model) {
  std::vector<StaticPose> poses;
  for (const PoseSpec& spec : model.specification().poses) {
    SystemState state = model.initial_state();
    std::vector<StaticGoal> goals;
    std::vector<DriveState> to = state.drive;
    for (const auto& setting : spec.drives) to[model.drive_index(setting.drive)].position = setting.position;
    for (const auto& hold : spec.holds) {
      CoordinateSpec coordinate;
      coordinate.joint = hold.joint;
      goals.push_back({model.drive_index(hold.drive), coordinate, hold.coordinate});
    }
    for (const auto& goal : spec.goals) goals.push_back({model.drive_index(goal.drive), goal.coordinate, goal.value});
    move_static(model, state, to, goals, "poses." + spec.name);
    poses.push_back(static_pose(model, state, spec.name));
  }
  return poses;
}

}  // namespace stillhook
