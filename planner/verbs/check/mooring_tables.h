// The moorings of a lift at its start, as a reader checks them: where each line goes, what it carries, and how stiffly
// they hold each vessel together.
#pragma once

#include <vector>

#include "results/report.h"
#include "sim/model.h"

namespace stillhook {

/// The lines with fairlead and anchor in the world, and one row a moored body with the stiffness against a shift in its
/// own surge and sway and against yaw about its centre of gravity. None where the lift has no moorings.
std::vector<ReportTable> mooring_tables(const Model& model);

}  // namespace stillhook
