// The natural periods of a lift in its static poses.
#pragma once

#include <vector>

#include "results/report.h"
#include "sim/model.h"

namespace stillhook {

/// One table for every body with a hull and one for the load, one row a pose that is the start or asked for by
/// the case (in those at the end of a phase taglines and contacts of that phase act): the period of the mode in which
/// the coordinate takes the largest share. Taglines are off; added mass at each mode's own frequency, no damping.
std::vector<ReportTable> period_tables(const Model& model, const std::vector<StaticPose>& poses);

}  // namespace stillhook
