// The use of cranes against their capacity curves as `check` prints it.
#pragma once

#include <vector>

#include "results/report.h"
#include "sim/model.h"
#include "sim/statics.h"

namespace stillhook {

/// One table a crane with a curve for the active sea: radius, hook load, capacity and use in each pose, and the
/// amplification that would use up the rest.
std::vector<ReportTable> crane_tables(const Model& model, const std::vector<StaticPose>& poses);

}  // namespace stillhook
