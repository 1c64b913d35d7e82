// Files that `stillhook weather` leaves beside its report.
#pragma once

#include <string>

#include "planner/verbs/weather/study.h"

namespace stillhook {

/// weather.csv: a line a sample of the hindcast: time, height, limit, state, wait for each window.
std::string samples_csv(const HindcastStudy& hindcast);

/// weather_months.csv: a line a month, of all years (year "all") and of each whole one.
std::string months_csv(const HindcastStudy& hindcast);

/// forecast.csv: a line a sample of the forecast: time, height; of each phase limit, alpha, what is allowed; start.
std::string forecast_csv(const ForecastStudy& forecast);

/// weather.nc (CF-1.8): the same as weather.csv and weather_months.csv as arrays. Throws FileError.
void write_weather_netcdf(const HindcastStudy& hindcast, const std::string& title, const std::string& path);

/// summary.json of the verb.
std::string weather_summary(const WeatherStudy& study, const std::vector<std::string>& files, const std::string& date);

}  // namespace stillhook
