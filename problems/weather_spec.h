// What `stillhook weather` is asked: files, their columns, how the vessel lies, how long the operation takes.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace stillhook {

/// A phase of the operation with a duration of its own, for the decision by a forecast.
struct WeatherPhaseSpec {
  std::string name;
  double duration = 0.0;  // s
};

struct WeatherSpec {
  enum class Period { peak, zero_crossing, energy };
  enum class Sense { by_name, from, towards };
  enum class AlphaBy { operation, lead_time };
  enum class End { censor, wrap };

  std::string hindcast, scatter, forecast;  // resolved paths; empty = given on the command line
  std::string time_column, height_column, period_column, direction_column, wind_column;  // empty = by the usual names
  std::optional<Period> period_kind;                                                     // absent: by the column's name
  double gamma = 3.3;  // peak enhancement with which other periods become peak periods
  Sense direction_sense = Sense::by_name;
  std::optional<double> bow_towards;  // rad, compass
  bool free_heading = false;
  std::optional<double> operation;  // s, T_POP; absent: of the case's operation
  double contingency = 0.5;         // of it; 6 h at least
  std::vector<double> windows;      // s
  std::vector<WeatherPhaseSpec> phases;
  std::string alpha;  // file; empty = the built-in table
  AlphaBy alpha_by = AlphaBy::operation;
  std::optional<double> wind_max;  // m/s
  std::vector<double> daylight;    // s after midnight UTC, from and to; empty = all day
  End record_end = End::censor;
  std::vector<double> horizons = {86400.0, 3 * 86400.0, 7 * 86400.0, 14 * 86400.0};  // s
};

}  // namespace stillhook
