#include "results/weather/workability.h"

#include <cmath>
#include <map>
#include <numbers>

#include "results/statistics/sample.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

bool is_dark(const WeatherRecord& record, std::size_t i, const std::array<double, 2>& daylight) {
  const double begin = date_of(record.time(i)).hour, end = begin + record.step_h();
  return begin < daylight[0] || end > daylight[1];
}

SampleState state_of(const WeatherRecord& record, std::size_t i, double limit, const WeatherRules& rules,
                     bool needs_period) {
  const double height = record.height[i], wind = WeatherRecord::value(record.wind, i);
  const double period = WeatherRecord::value(record.period, i);
  if (std::isnan(height) || (needs_period && std::isnan(period)) || (rules.wind_max && std::isnan(wind)))
    return SampleState::missing;
  if (std::isnan(limit)) {
    // Without a limit: the heading is missing where the period is within the limits' range.
    return rules.bow_towards && std::isnan(WeatherRecord::value(record.from, i)) ? SampleState::missing
                                                                                 : SampleState::outside;
  }
  if (!(height <= limit)) return SampleState::too_high;
  if (rules.wind_max && !(wind <= *rules.wind_max)) return SampleState::windy;
  if (rules.daylight && is_dark(record, i, *rules.daylight)) return SampleState::dark;
  return SampleState::workable;
}

}  // namespace

double WeatherRecord::value(const std::vector<double>& of, std::size_t i) { return of.empty() ? kNaN : of[i]; }

double relative_heading(double bow_towards, double coming_from) { return bow_towards - coming_from - std::numbers::pi; }

const char* state_text(SampleState state) {
  static constexpr std::array<const char*, kSampleStates> kTexts = {
      "workable", "waves too high", "too much wind", "no daylight", "outside the limits", "missing"};
  return kTexts[static_cast<std::size_t>(state)];
}

double Workability::share() const {
  return size() == 0 ? kNaN : static_cast<double>(counts[0]) / static_cast<double>(size());
}

double limit_in(const OperationLimits& limits, const WeatherRules& rules, double period, double coming_from) {
  if (rules.free_heading) return limits.highest(period);
  if (rules.bow_towards) return limits.at(period, relative_heading(*rules.bow_towards, coming_from));
  return limits.lowest(period);
}

Workability judge_weather(const WeatherRecord& record, const OperationLimits& limits, const WeatherRules& rules) {
  Workability result;
  result.start = record.start;
  result.step = record.step;
  const bool needs_period = limits.depends_on_period();
  for (std::size_t i = 0; i < record.size(); ++i) {
    result.limit.push_back(
        limit_in(limits, rules, WeatherRecord::value(record.period, i), WeatherRecord::value(record.from, i)));
    result.state.push_back(state_of(record, i, result.limit.back(), rules, needs_period));
    ++result.counts[static_cast<std::size_t>(result.state.back())];
  }
  return result;
}

double YearSpread::quantile(double q) const { return values.size() < 3 ? kNaN : quantile_of(values, q); }
double YearSpread::p10() const { return quantile(0.1); }
double YearSpread::p50() const { return quantile(0.5); }
double YearSpread::p80() const { return quantile(0.8); }
double YearSpread::p90() const { return quantile(0.9); }

bool covers(UnixTime start, UnixTime step, std::size_t size, int year, int month) {
  const std::optional<UnixTime> first = instant_of_date(year, month == 0 ? 1 : month, 1);
  const std::optional<UnixTime> after =
      month == 0 || month == 12 ? instant_of_date(year + 1, 1, 1) : instant_of_date(year, month + 1, 1);
  // Samples need not fall on midnight: one may begin up to a step after it.
  return first && after && start < *first + step && start + static_cast<UnixTime>(size) * step > *after - step;
}

MonthlyWorkability monthly(const Workability& workability) {
  struct Count {
    std::size_t samples = 0, workable = 0;
    double share() const { return static_cast<double>(workable) / static_cast<double>(samples); }
  };
  std::array<Count, 12> months;
  std::map<int, std::array<Count, 13>> years;  // 0: the year
  for (std::size_t i = 0; i < workability.size(); ++i) {
    const CalendarDate date = date_of(workability.time(i));
    const std::size_t month = static_cast<std::size_t>(date.month);
    for (Count* count : {&months[month - 1], &years[date.year][0], &years[date.year][month]}) {
      ++count->samples;
      count->workable += workability.workable(i) ? 1 : 0;
    }
  }
  MonthlyWorkability result;
  for (std::size_t m = 0; m < 12; ++m) {
    result.samples[m] = months[m].samples;
    result.share[m] = months[m].samples == 0 ? kNaN : months[m].share();
  }
  for (const auto& [year, counts] : years)
    for (std::size_t m = 0; m <= 12; ++m) {
      if (counts[m].samples == 0 ||
          !covers(workability.start, workability.step, workability.size(), year, static_cast<int>(m)))
        continue;
      YearSpread& spread = m == 0 ? result.whole_years : result.by_year[m - 1];
      spread.years.push_back(year);
      spread.values.push_back(counts[m].share());
    }
  return result;
}

}  // namespace stillhook
