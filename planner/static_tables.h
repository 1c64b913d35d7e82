// What a lift looks like at rest, as tables for the terminal and the report: the numbers a reader checks a case by.
#pragma once

#include <vector>

#include "results/report.h"
#include "sim/operation.h"

namespace stillhook {

/// Every pose at rest: the start and the end of each phase, then the poses that the case asks to report.
std::vector<StaticPose> all_static_poses(const Model& model, const Operation& operation);

/// Load and hoist points, vessels, angles of hinged bodies, wire tensions, wire lengths; one row a pose.
std::vector<ReportTable> static_tables(const Model& model, const std::vector<StaticPose>& poses);

/// Phases with start, duration, and the drives that move in them. Times without waiting for events.
ReportTable phase_table(const Model& model, const Operation& operation);

}  // namespace stillhook
