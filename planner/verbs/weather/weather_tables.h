// Tables of `stillhook weather`, for the screen and the report, and its verdict.
#pragma once

#include <string>
#include <vector>

#include "planner/verbs/weather/study.h"
#include "results/report.h"

namespace stillhook {

/// What the study says in a sentence or two.
std::string verdict_of(const WeatherStudy& study);

ReportTable states_table(const HindcastStudy& hindcast);
ReportTable months_table(const HindcastStudy& hindcast);
ReportTable windows_table(const HindcastStudy& hindcast);
ReportTable waits_table(const HindcastStudy& hindcast, const WindowStatistics& windows);
ReportTable scatter_summary_table(const ScatterStudy& scatter);
ReportTable decision_table(const ForecastStudy& forecast);

/// The phase's name, or "operation" for the whole of it.
std::string phase_title(const std::string& phase);

/// Every key of the settings that were used, with its value.
ReportTable settings_table(const WeatherTask& task);

}  // namespace stillhook
