// Wind and current in numbers: speeds and gusts at the heights of the lift, what they push with, what they change.
#pragma once

#include <vector>

#include "results/report.h"
#include "sim/model.h"

namespace stillhook {

/// "Wind": mean, 60 s and 3 s gust, standard deviation of the simulated gusts and pressure at 10 m, at the load and at
/// the upper ends of the hoist wires. "Wind and current on bodies": mean force and yaw moment at the start, and the
/// heel and trim that they cause. "Falls in wind and current": angle and offset of the hoist wires. Empty without
/// either.
std::vector<ReportTable> flow_tables(const Model& model);

}  // namespace stillhook
