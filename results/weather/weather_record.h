// Weather over time at one place, in equal steps: what a hindcast, a measurement or a forecast says.
#pragma once

#include <string>
#include <vector>

#include "results/weather/calendar.h"

namespace stillhook {

/// Sample i holds on [time(i), time(i) + step). Values are NaN where they are missing; a quantity that the file does
/// not have at all is an empty vector.
struct WeatherRecord {
  UnixTime start = 0;                     // of the first sample
  UnixTime step = 0;                      // s
  std::vector<double> height;             // significant wave height, m; its size is the record's
  std::vector<double> period;             // peak period, s
  std::vector<double> from;               // rad, compass direction that the waves come from, clockwise from true north
  std::vector<double> wind;               // m/s
  std::size_t gaps = 0;                   // samples that the file lacks between its first and its last
  std::vector<std::string> remarks = {};  // what its columns were taken for, one sentence each

  std::size_t size() const { return height.size(); }
  UnixTime time(std::size_t i) const { return start + static_cast<UnixTime>(i) * step; }
  double step_h() const { return static_cast<double>(step) / kHour; }
  /// Of a quantity that may be empty: NaN then.
  static double value(const std::vector<double>& of, std::size_t i);
};

/// Heading of waves relative to the bow, rad, towards which they travel and positive to port, from compass directions
/// (rad): bow - from - pi. From ahead pi, from starboard abeam pi/2.
double relative_heading(double bow_towards, double coming_from);

}  // namespace stillhook
