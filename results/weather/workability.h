// In which samples of a record work may go on, and why not in the others; shares by month and by year.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "results/weather/limit_surface.h"
#include "results/weather/weather_record.h"

namespace stillhook {

/// What decides beside the limits.
struct WeatherRules {
  /// How the vessel lies: its bow to a compass direction (rad, clockwise from true north), or in every sample as is
  /// best. Neither: the lowest limit over all headings counts.
  std::optional<double> bow_towards;
  bool free_heading = false;
  std::optional<double> wind_max;                      // m/s
  std::optional<std::array<double, 2>> daylight = {};  // hours of the day, UTC, between which work may go on
};

enum class SampleState : std::uint8_t {
  workable,
  too_high,  // Hs above the limit
  windy,
  dark,
  outside,  // the limits do not cover this period
  missing   // the record says nothing: not workable
};
inline constexpr std::size_t kSampleStates = 6;

/// "workable", "waves too high", ...
const char* state_text(SampleState state);

struct Workability {
  UnixTime start = 0, step = 0;  // of the record
  std::vector<SampleState> state;
  std::vector<double> limit;  // m; NaN where there is none
  std::array<std::size_t, kSampleStates> counts{};

  std::size_t size() const { return state.size(); }
  bool workable(std::size_t i) const { return state[i] == SampleState::workable; }
  UnixTime time(std::size_t i) const { return start + static_cast<UnixTime>(i) * step; }
  /// Share of all samples.
  double share() const;
};

/// The limit that holds in a sample: at its period and at its heading as the rules say.
double limit_in(const OperationLimits& limits, const WeatherRules& rules, double period, double coming_from);

/// A height that equals its limit is within it.
Workability judge_weather(const WeatherRecord& record, const OperationLimits& limits, const WeatherRules& rules);

/// A share in each year of a record, of which only whole months or years count, and how it spreads over them.
struct YearSpread {
  std::vector<int> years;      // in order
  std::vector<double> values;  // of these years
  double p10() const;          // NaN for less than three years: so few have no percentiles
  double p50() const;
  double p80() const;
  double p90() const;

 private:
  double quantile(double q) const;
};

struct MonthlyWorkability {
  std::array<double, 12> share;         // of all samples in the month, over all years; NaN for none
  std::array<std::size_t, 12> samples;  // that the record has in the month
  std::array<YearSpread, 12> by_year;   // of whole months
  YearSpread whole_years;               // of whole years
};

MonthlyWorkability monthly(const Workability& workability);

/// True if the record has every sample of the month (of the year for month 0).
bool covers(UnixTime start, UnixTime step, std::size_t size, int year, int month);

}  // namespace stillhook
