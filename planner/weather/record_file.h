// Weather over time as files: hindcasts, measurements, forecasts, CSV or NetCDF, of one place.
//
//     time,hs [m],tp [s],wave_from [deg],wind_speed [m/s]
//
// Columns are known by the names that providers give them, or as the section `weather` says. Times are ISO 8601 (CSV)
// or by the attribute `units`, "hours since 1900-01-01" (NetCDF), in steps that are all alike; rows that are missing in
// between are samples without values. What a column was taken for, with its unit and its sense, is a remark.
#pragma once

#include <string>

#include "problems/weather_spec.h"
#include "results/weather/weather_record.h"

namespace stillhook {

/// Throws CaseError with file, line, column, rule, value and remedy.
WeatherRecord read_record_file(const std::string& path, const WeatherSpec& spec);

}  // namespace stillhook
