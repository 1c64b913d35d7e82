// The reference lift as the tests use it: read once, its poses by name, its states.
#pragma once

#include <string>

#include "problems/case.h"
#include "sim/model.h"
#include "sim/operation.h"
#include "sim/statics.h"

namespace stillhook {

/// In the paper's waves, which are those of deep water, as are the truths of the reference data set; the case itself has
/// the water of its depth.
inline Case reference_case(std::vector<Override> overrides = {}) {
  overrides.insert(overrides.begin(), {"sea.deep_waves", "true"});
  return read_case(std::string(STILLHOOK_SOURCE_DIR) + "/problems/box_installation.toml", overrides);
}

struct ReferenceLift {
  explicit ReferenceLift(const Specification& specification = reference_case().specification)
      : model(build_model(specification)), poses(solve_poses(model)) {}

  const StaticPose& pose(const std::string& name) const {
    for (const StaticPose& p : poses)
      if (p.name == name) return p;
    throw std::out_of_range(name);
  }
  int drive(const std::string& name) const { return model.drive_index(name); }
  const Pose& body(const StaticPose& p, const std::string& name) const { return p.bodies[model.body_index(name)]; }
  Vector3 tip(const StaticPose& p) const { return body(p, "boom_port") * Vector3(105.0, 0.0, 0.0); }
  /// The tip from the crane's origin, axes of W: what the table of the reference data set lists as the world, because
  /// its crane only trims and sinks.
  double tip_x(const StaticPose& p) const { return tip(p).x() - body(p, "crane").p.x(); }
  double trim_deg(const StaticPose& p) const { return roll_pitch_yaw(body(p, "crane").R).pitch * 180.0 / M_PI; }
  /// Angle above the crane's x axis, deg.
  double angle_deg(const StaticPose& p, const std::string& name) const {
    const Vector3 x = body(p, "crane").R.transpose() * body(p, name).R.col(0);
    return std::atan2(x.z(), x.x()) * 180.0 / M_PI;
  }
  /// The state at equilibrium in a pose (phase 0: taglines off).
  SystemState state(const StaticPose& p) const {
    SystemState s = model.initial_state();
    const auto& bodies = model.system().bodies;
    for (std::size_t i = 0; i < s.body.size(); ++i) {
      s.body[i].R_WB = p.bodies[i].R;
      s.body[i].p_WC = p.bodies[i] * bodies[i].cog;
    }
    for (std::size_t i = 0; i < s.drive.size(); ++i) s.drive[i].position = p.drives[i];
    s.element_state.clear();
    solve_static(model, s, {}, "poses." + p.name);
    return s;
  }

  Model model;
  std::vector<StaticPose> poses;
};

}  // namespace stillhook
