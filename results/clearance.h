// Distances between named pairs of shapes (boxes and capsules fixed to bodies) along a run. FCL stays in clearance.cpp.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "results/run_view.h"

namespace stillhook {

struct ClearanceSeries {
  std::string name;
  std::vector<double> time, distance;                         // s, m: about one a second, closer around the minimum
  double minimum = std::numeric_limits<double>::quiet_NaN();  // m, 0 when the shapes touch or overlap
  double minimum_time = std::numeric_limits<double>::quiet_NaN();  // s
  std::vector<Peak> by_phase;                                      // the minimum in each phase, m
};

/// Distance of two shapes (m), 0 when they touch or overlap. X_WA and X_WB are the poses of the bodies they belong to.
double shape_distance(const ClearanceSpec::Shape& a, const Pose& X_WA, const ClearanceSpec::Shape& b, const Pose& X_WB);

/// One series per clearance of the specification, from the recorded samples; an empty one for a pair whose bodies are
/// not recorded. Between samples taken every `spacing` (s) the recorded ones are looked at wherever the minimum of a
/// phase could hide, judged by the fastest change of distance seen.
std::vector<ClearanceSeries> compute_clearances(const Specification& specification, const Trajectory& trajectory,
                                                double spacing = 1.0);

}  // namespace stillhook
