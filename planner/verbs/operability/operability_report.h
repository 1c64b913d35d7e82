// report.html of `stillhook operability`.
#pragma once

#include <string>
#include <vector>

#include "planner/verbs/operability/study.h"
#include "results/document_control.h"

namespace stillhook {

std::string operability_report(const OperabilityStudy& study, const std::vector<std::string>& files,
                               const DocumentControl& control);

// The drawings, each an <svg>. operability_plots.cpp
/// Limits as a table of periods and headings, shaded, with a letter for what governs.
std::string limits_drawing(const OperabilityStudy& study, std::size_t place);
/// Limits over the period, a line a heading.
std::string limit_curves(const OperabilityStudy& study);
/// Share of the seeds of a column that break up to a height, with bounds of 90 % (Clopper & Pearson).
std::string broken_share_drawing(const OperabilityStudy& study, std::size_t task);
/// Limits around the hull, a line a period, with the interval of the lowest. Empty for fewer than three headings.
/// operability_polar.cpp
std::string polar_drawing(const OperabilityStudy& study);

}  // namespace stillhook
