#include "results/changed_run.h"

#include <algorithm>
#include <stdexcept>

namespace stillhook {

Trajectory reduced_run(const Trajectory& run, const Tangents& tangents) {
  Trajectory part;
  part.status = run.status;
  part.message = run.message;
  part.time = run.time;
  part.phases = run.phases;
  part.contacts = run.contacts;
  part.static_poses = run.static_poses;
  part.extremes.resize(run.extremes.size());
  for (const int c : tangents.channels) {
    const std::size_t channel = static_cast<std::size_t>(c);
    part.channels.push_back(run.channels[channel]);
    part.values.push_back(run.values[channel]);
    for (std::size_t p = 0; p < run.extremes.size(); ++p) part.extremes[p].push_back(run.extremes[p][channel]);
  }
  return part;
}

Trajectory changed_run(const Trajectory& reduced, const Tangents& tangents, int j, double by,
                       const std::vector<StaticPose>& poses) {
  if (tangents.values.size() != reduced.values.size() || tangents.extremes.size() < reduced.extremes.size())
    throw std::invalid_argument("changed run: these are not the tangents of this run");
  Trajectory run = reduced;
  run.static_poses = poses;
  for (std::size_t k = 0; k < run.values.size(); ++k) {
    const auto slope = tangents.values[k].col(j);
    if (static_cast<std::size_t>(slope.size()) != run.values[k].size())
      throw std::invalid_argument("changed run: these are not the tangents of this run");
    for (std::size_t i = 0; i < run.values[k].size(); ++i) run.values[k][i] += by * slope[static_cast<Eigen::Index>(i)];
    for (std::size_t p = 0; p < run.extremes.size(); ++p) {
      run.extremes[p][k].min += by * tangents.extremes[p][k].min[j];
      run.extremes[p][k].max += by * tangents.extremes[p][k].max[j];
    }
  }
  const std::size_t phases = std::min(run.phases.size(), tangents.phase_start.size());
  for (std::size_t p = 0; p < phases; ++p) {
    run.phases[p].start += by * tangents.phase_start[p][j];
    if (p < tangents.phase_end.size()) run.phases[p].end += by * tangents.phase_end[p][j];
  }
  return run;
}

}  // namespace stillhook
