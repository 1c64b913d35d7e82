// The operation as commands: every phase's moves with their travel worked out from the geometry of static poses.
#pragma once

#include <string>
#include <vector>

#include "sim/lifting/profile.h"
#include "sim/model.h"
#include "sim/trajectory.h"

namespace stillhook {

struct Move {
  int drive = 0;
  RateProfile profile;      // from rest to rest over the travel
  double delay = 0.0;       // s after the start of the phase
  bool background = false;  // the phase may end before this move does
};

struct Phase {
  std::string name;
  PhaseSpec::Stage stage = PhaseSpec::Stage::hanging;
  EventSpec wait_for;
  int wait_contact = -1;  // element index of the contact waited for
  double duration = 0.0;  // s, from its start to the end of its foreground moves (and at least the specified time)
  std::vector<Move> moves;
};

struct Operation {
  std::vector<Phase> phases;
  std::vector<StaticPose> static_poses;  // [0] start, [i + 1] end of phase i with every move finished, calm water
  std::vector<SystemState> equilibria;   // the states of static_poses

  /// Duration without waiting for events, s.
  double planned_duration() const;
};

/// Solves the static poses phase by phase, so that a move with a goal gets the travel that reaches it. `until` (s; 0 =
/// all): phases that cannot begin before are left out. Throws SpecificationError when a goal cannot be reached or a
/// drive's limits are broken.
Operation build_operation(const Model& model, double until = 0.0);

/// The same for a model that differs little from `other`, with as many phases as `like`, the operation of `other`. An
/// equilibrium of `other` that is one of this model as well is taken over; else it is where the search for it begins.
Operation build_operation_like(const Model& model, const Model& other, const Operation& like);

/// Moves that bring every drive from rest at zero to where it stands in `drives`, all in the first instant.
std::vector<Move> jumps_to(const std::vector<DriveState>& drives);

/// A part of an operation: one phase, or the pose at its end held for a while.
struct OperationPart {
  int phase = -1;     // -1: no part, the whole operation
  double hold = 0.0;  // s; > 0: at rest at the phase's end for so long

  bool whole() const { return phase < 0; }
  /// Index of the static pose that it begins in.
  std::size_t begins_at() const { return static_cast<std::size_t>(phase) + (hold > 0.0 ? 1 : 0); }
};

/// The operation with everything before the part done in no time and nothing after it, to be run from start_of().
Operation part_of(const Operation& whole, const OperationPart& part);
/// At rest where the part begins.
SystemState start_of(const Operation& whole, const OperationPart& part);

/// True if both ask for the same phases and moves with the same travels and goals: they differ at most in timing
/// (speeds, profiles, delays, durations, waits), so that every pose is the same.
bool same_poses(const OperationSpec& a, const OperationSpec& b);

/// The operation of `spec` with the travels and poses of `like`, which was built on this model and has the same poses.
Operation retimed_operation(const Model& model, const OperationSpec& spec, const Operation& like);

/// The reported poses of the specification (Specification::poses), each a static equilibrium.
std::vector<StaticPose> solve_poses(const Model& model);

}  // namespace stillhook
