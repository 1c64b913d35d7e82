// Smooth counterparts of metrics, for searches that follow gradients. Reports and verdicts never use them.
//
//   peaks          max r -> (1/s) ln( (1/T) int exp(s r) dt ), a mean-normalised log-sum-exp that stays below the peak
//                  and nears it as s grows
//   rms, shares    integrals over windows that end between samples, so that they move with the phases
//   re-hits        int k (-gap)_+ dt / (m v0) over the pickup contacts, from the moment the load has once been clear by
//                  `gap_width`: the impulse of every touch against that of stopping the load at v0. (.)_+ is C1 with a
//                  compact foot of gap_width, so it is exactly zero, with a zero gradient, when nothing touches again
//   saturation     logistic share of time near the speed or tension limit
//
// Kreisselmeier & Steinhauser (1979) for the log-sum-exp.
#pragma once

#include <optional>
#include <string>

#include "results/metrics.h"

namespace stillhook {

struct SmoothOptions {
  double sharpness = 20.0;      // > 0: s times the range of r, which is its largest less its smallest value
  double gap_width = 0.02;      // m, > 0
  double rehit_speed = 1.0;     // m/s, > 0: v0, a re-hit that counts as one
  double saturation_width = 0.05;  // 1, > 0: share of the limit over which saturation sets in
};

/// The smooth counterpart of a metric in the metric's unit; empty where there is none (the metric is then taken as it
/// is). The scales that a sharpness refers to come from the run itself and are part of its value.
std::optional<double> smooth_metric(const Specification& specification, const Trajectory& run, const std::string& name,
                                    const SmoothOptions& options);

/// The channels that a metric and its smooth counterpart are computed from.
std::vector<std::string> channels_of_metric(const Specification& specification, const std::string& name);

}  // namespace stillhook
