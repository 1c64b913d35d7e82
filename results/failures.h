// What a simulation can run on through but no lift can: a wire above its breaking load, a vessel that capsizes or has
// no freeboard, a load that has swung out of what a crane holds, a crane outside its capacity curve. Such a run fails whatever its limits say.
#pragma once

#include <string>
#include <vector>

#include "results/run_view.h"

namespace stillhook {

/// Heel or trim, rad, at which a floating body of the operation counts as capsized: 30 deg, where hatches and
/// down-flooding openings of working vessels are under water and nothing on deck stays.
inline constexpr double kCapsized = 0.5235987755982988;
/// Angle from the vertical, rad, at which a hoist wire that carries has lost its load: 45 deg.
inline constexpr double kSwungOut = 0.7853981633974483;

struct Failure {
  double time;           // s, from when on
  std::string sentence;  // what, when, in which phase, against which number
};

/// In the order of their time; empty for a run that a real lift could follow.
std::vector<Failure> failures_of(const RunView& view);

/// The first of them in full, and how many more there are.
std::string failure_text(const std::vector<Failure>& failures);

}  // namespace stillhook
