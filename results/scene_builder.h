// What the entries of a case add to the picture of a lift (results/elements).
#pragma once

#include <string>

#include "results/scene.h"

namespace stillhook {

class SceneBuilder {
 public:
  /// Keeps references.
  SceneBuilder(const Specification& specification, const Trajectory& trajectory, Scene& scene)
      : specification_(specification), trajectory_(trajectory), scene_(scene) {}

  const Specification& specification() const { return specification_; }
  Scene& scene() { return scene_; }

  int body(const std::string& name) const;  // index; kSceneWorld if there is none of that name
  /// Where a body stands at the start.
  Pose start_pose(int body) const;
  /// Largest value of a channel in the static poses; 0 without one.
  double largest_static(const std::string& channel) const;
  /// Largest magnitude of a channel over the whole run, from every step; 0 if it is not recorded.
  double largest(const std::string& channel) const;
  /// When a phase starts, s: the run's start for none, infinity for one that this run did not reach.
  double phase_start(const std::string& phase) const;

 private:
  const Specification& specification_;
  const Trajectory& trajectory_;
  Scene& scene_;
};

}  // namespace stillhook
