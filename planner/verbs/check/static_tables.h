// What a lift looks like at rest, as tables for the terminal and the report: the numbers a reader checks a case by.
#pragma once

#include <vector>

#include "results/report.h"
#include "sim/operation.h"

namespace stillhook {

/// Load and hoist points, vessels, angles of hinged bodies, natural periods, wire tensions, wire lengths; one row a
/// pose: the start, the end of each phase, then the poses that the case asks to report. And the moorings.
std::vector<ReportTable> static_tables(const Model& model, const Operation& operation);

/// Phases with start, duration, and the drives that move in them. Times without waiting for events.
ReportTable phase_table(const Model& model, const Operation& operation);

}  // namespace stillhook
