// What the verbs print.
#pragma once

#include <string>

#include "results/report.h"
#include "results/summary.h"

namespace stillhook {

/// A table as text with its title above and its note below.
std::string table_text(const ReportTable& table);

/// Every metric that is not of a single element, with unit, time and phase.
std::string metrics_text(const Metrics& metrics);

/// Each limit with its value, margin and verdict.
std::string limits_text(const std::vector<LimitCheck>& limits);

/// One line: within the limits or not, and the criterion that governs.
std::string verdict_text(const Metrics& metrics, const std::vector<LimitCheck>& limits);

/// Baseline and plan side by side: the objective term by term with the random search beside, variables, limits.
std::string search_text(const SearchSection& search);

}  // namespace stillhook
