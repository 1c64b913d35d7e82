// report.html of `stillhook weather`.
#pragma once

#include <string>
#include <vector>

#include "planner/verbs/weather/study.h"
#include "results/document_control.h"

namespace stillhook {

std::string weather_report(const WeatherStudy& study, const std::vector<std::string>& files,
                           const DocumentControl& control);

// The drawings, each an <svg>. weather_plots.cpp
std::string months_drawing(const HindcastStudy& hindcast);
std::string waiting_drawing(const HindcastStudy& hindcast);
std::string chances_drawing(const HindcastStudy& hindcast, const WindowStatistics& windows);
std::string calms_drawing(const HindcastStudy& hindcast);
/// Every sample of the last whole year, or of the record's last year.
std::string calendar_drawing(const HindcastStudy& hindcast);
/// Counts by height and period with the limits over them. Empty where the record has no periods.
std::string scatter_drawing(const ScatterTable& table, const OperationLimits& limits, const std::string& title);
ScatterTable counted(const WeatherRecord& record);
std::string scatter_months_drawing(const ScatterStudy& scatter);
std::string forecast_drawing(const ForecastStudy& forecast, std::size_t phase);

}  // namespace stillhook
