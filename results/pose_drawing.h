// Static poses drawn to scale: elevation from starboard (x to the right, z up) and plan (x to the right, y up).
#pragma once

#include <string>
#include <vector>

#include "results/scene.h"

namespace stillhook {

struct PoseDrawing {
  std::string name;  // of the pose
  std::string svg;   // one <svg> element, a file of its own as well
};

/// One drawing a pose, all to the same scale and about the same place; a pose that looks like the one before is left
/// out. `target` (m, in W) is marked with a cross.
std::vector<PoseDrawing> draw_named_poses(const Scene& scene, const std::vector<StaticPose>& poses,
                                          const Vector3& target);

/// The drawings alone.
std::vector<std::string> draw_poses(const Scene& scene, const std::vector<StaticPose>& poses, const Vector3& target);

}  // namespace stillhook
