// Static poses of a model: equilibria at given drive positions, with goals that drives are moved to reach.
#pragma once

#include <string>
#include <vector>

#include "sim/model.h"
#include "sim/trajectory.h"

namespace stillhook {

/// A drive that is to stand where a coordinate has a wanted value in static equilibrium.
struct StaticGoal {
  int drive = 0;
  CoordinateSpec coordinate;
  double value = 0.0;       // m, rad or N
};

/// The coordinate's value (m, rad or N) at a state.
double coordinate_value(const Model& model, const SystemState& state, const CoordinateSpec& coordinate);

/// Moves `state` to the stable equilibrium at its drive positions in calm water; with goals, moves their drives too.
/// `close`: bodies, drives and lambda are already nearly there. Throws SpecificationError naming `entry` when there is
/// no stable equilibrium or a goal is out of reach.
void solve_static(const Model& model, SystemState& state, const std::vector<StaticGoal>& goals,
                  const std::string& entry, bool close = false);

/// The same from the equilibrium `state` with its drives moved slowly to `to` (see drive_path.h), then to the goals:
/// the pose that the lift itself comes to.
void move_static(const Model& model, SystemState& state, const std::vector<DriveState>& to,
                 const std::vector<StaticGoal>& goals, const std::string& entry);

/// The pose as it is reported.
StaticPose static_pose(const Model& model, const SystemState& state, const std::string& name);

}  // namespace stillhook
