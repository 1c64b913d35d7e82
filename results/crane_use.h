// How far a crane is used against its capacity curve along a run.
#pragma once

#include <string>
#include <vector>

#include "results/run_view.h"
#include "sim/crane_parts.h"

namespace stillhook {

class ChannelSet;

/// One value a sample.
struct CraneUse {
  const CraneCurveSpec* curve = nullptr;
  std::vector<double> radius;  // m
  std::vector<double> load;    // N: what the curve bounds, the hook load in waves or that at rest
  std::vector<double> use;     // 1: load over capacity; outside the curve's radii over that of its nearest end
};

/// Where a point of a body goes along a run, m, one place a sample; empty if the body was not recorded.
std::vector<Vector3> path_of(const RunView& view, const PlaceOnBody& place);

/// Adds the channels that crane_use() reads.
void add_crane_channels(ChannelSet& channels, const std::string& crane);

/// Of a crane with a curve that holds in the sea of the run; without one, or without samples, everything is empty.
CraneUse crane_use(const RunView& view, const std::string& crane);

}  // namespace stillhook
