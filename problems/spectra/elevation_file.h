// Measured series in tables, the elevation of the surface and the speed of the wind: the first column is the time in s in
// even steps, the names of the columns are in the first row.
#pragma once

#include <string>
#include <vector>

#include "sim/environment/wind_spec.h"
#include "sim/sea/sea_spec.h"

namespace stillhook {

struct MeasuredSeries {
  double step = 0.0;  // s
  std::vector<double> value;
  std::string source;  // file and column, in words
};

/// One column. Throws FileError "<file>:<line>: ...".
MeasuredSeries read_measured_series(const std::string& file, const std::string& column);

/// The column wind.column, m/s. Throws FileError, also for a speed below 0.
WindRecord read_wind_file(const WindSpec& wind);

/// The column spec.column, in m. Throws FileError "<file>:<line>: ...".
ElevationRecord read_elevation_file(const RecordFileSpec& spec);

}  // namespace stillhook
