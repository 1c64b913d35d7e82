#include "results/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stillhook {

int SceneBuilder::body(const std::string& name) const {
  for (std::size_t i = 0; i < specification_.bodies.size(); ++i)
    if (specification_.bodies[i].name == name) return static_cast<int>(i);
  return kSceneWorld;
}

Pose SceneBuilder::start_pose(int body) const {
  const bool known = !trajectory_.static_poses.empty() && body >= 0 &&
                     static_cast<std::size_t>(body) < trajectory_.static_poses.front().bodies.size();
  return known ? trajectory_.static_poses.front().bodies[static_cast<std::size_t>(body)] : Pose();
}

double SceneBuilder::largest_static(const std::string& channel) const {
  double largest = 0.0;
  for (const StaticPose& pose : trajectory_.static_poses)
    if (const auto found = pose.values.find(channel); found != pose.values.end() && std::isfinite(found->second))
      largest = std::max(largest, found->second);
  return largest;
}

double SceneBuilder::largest(const std::string& channel) const {
  const int c = trajectory_.find(channel);
  double largest = 0.0;
  for (const std::vector<Extreme>& phase : trajectory_.extremes)
    if (c >= 0 && static_cast<std::size_t>(c) < phase.size())
      if (const Extreme& e = phase[static_cast<std::size_t>(c)]; e.min <= e.max)
        largest = std::max({largest, std::abs(e.min), std::abs(e.max)});
  return largest;
}

double SceneBuilder::phase_start(const std::string& phase) const {
  if (phase.empty()) return trajectory_.phases.empty() ? 0.0 : trajectory_.phases.front().start;
  for (const PhaseRecord& p : trajectory_.phases)
    if (p.name == phase) return p.start;
  return std::numeric_limits<double>::infinity();
}

}  // namespace stillhook
