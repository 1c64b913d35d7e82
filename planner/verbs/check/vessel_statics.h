// How the floating bodies lie at rest.
#pragma once

#include <vector>

#include "results/report.h"
#include "sim/model.h"

namespace stillhook {

/// Draft of the hull's middle, heel and trim of every body with a hull, one table a vessel, one row a pose.
std::vector<ReportTable> vessel_tables(const Model& model, const std::vector<StaticPose>& poses);

}  // namespace stillhook
