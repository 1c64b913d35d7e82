// Workability and windows against answers from outside: a two-state Markov chain in closed form, seven days counted by
// hand, three invented years and a scatter table evaluated by another program (tests/truth/weather, made by
// make_weather.py; CC0), the NMI law with its printed numbers.
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "results/weather/alpha.h"
#include "results/weather/calendar.h"
#include "results/weather/go_no_go.h"
#include "results/weather/period_ratio.h"
#include "results/weather/scatter.h"
#include "results/weather/windows.h"
#include "sim/spatial/constants.h"

#include "sim/spatial/pose.h"

// After pose.h, whose vectors it uses.
#include "sim/sea/spectrum.h"

namespace stillhook {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

WeatherRecord record_of(std::vector<double> heights, double step_h, const char* start = "2020-06-01") {
  WeatherRecord record;
  record.start = *instant_of(start);
  record.step = static_cast<UnixTime>(step_h * kHour);
  record.height = std::move(heights);
  return record;
}

OperationLimits limit_of(double height) { return {{{"", LimitSurface(height)}}}; }

TEST_CASE("Instants are read as ISO 8601 and written back", "[weather]") {
  CHECK(*instant_of("1970-01-01") == 0);
  CHECK(*instant_of("2019-01-01T03:00Z") == 1546311600);  // date -u -d 2019-01-01T03:00Z +%s
  CHECK(*instant_of("2019-01-01 03:00:00.000") == 1546311600);
  CHECK(*instant_of("2019-01-01T05:00+02:00") == 1546311600);
  CHECK(*instant_of("1900-01-01") == -2208988800);  // date -u -d 1900-01-01 +%s
  CHECK(instant_text(1546311600) == "2019-01-01T03:00Z");
  CHECK(instant_text(-2208988800) == "1900-01-01T00:00Z");
  CHECK(date_of(1582977600).month == 2);  // 2020-02-29T12:00Z
  CHECK(date_of(1582977600).day == 29);
  CHECK(date_of(1582977600).hour == 12.0);
  for (const char* bad : {"", "2019", "2019-13-01", "2019-02-29", "2019-01-01T25:00", "2019-01-01T03", "01.02.2019",
                          "2019-01-01T03:00Zx", "2019-01-01T03:00+", "-019-01-01"})
    CHECK_FALSE(instant_of(bad));
}

TEST_CASE("A limit is bilinear, around the circle, and ends with its periods", "[weather]") {
  const LimitSurface surface({6.0, 10.0}, {0.0, 90.0 * kDegree, 270.0 * kDegree}, {{2.0, 1.0, 1.5}, {1.0, 0.5, 0.7}});
  CHECK(surface.at(6.0, 0.0) == 2.0);
  CHECK(surface.at(10.0, 90.0 * kDegree) == 0.5);
  CHECK(surface.at(8.0, 45.0 * kDegree) == Approx(0.25 * (2.0 + 1.0 + 1.0 + 0.5)));
  CHECK(surface.at(6.0, -45.0 * kDegree) == Approx(1.75));  // between 270 and 360 deg
  CHECK(surface.at(6.0, 675.0 * kDegree) == Approx(1.75));
  CHECK(surface.at(6.0, 180.0 * kDegree) == Approx(1.25));
  CHECK(std::isnan(surface.at(5.99, 0.0)));
  CHECK(std::isnan(surface.at(10.01, 0.0)));
  CHECK(std::isnan(surface.at(8.0, kNaN)));
  CHECK(surface.lowest(6.0) == 1.0);
  CHECK(LimitSurface(1.5).at(kNaN, kNaN) == 1.5);
  const OperationLimits two{{{"a", surface}, {"b", LimitSurface(1.2)}}};
  CHECK(two.at(6.0, 0.0) == 1.2);
  CHECK(two.at(10.0, 0.0) == 1.0);
  CHECK(two.highest(10.0) == 1.0);
  CHECK(two.highest(6.0) == 1.2);
  // From ahead 180, from starboard abeam +90.
  CHECK(std::remainder(relative_heading(250.0 * kDegree, 250.0 * kDegree) - std::numbers::pi, 2 * std::numbers::pi) ==
        Approx(0.0).margin(1e-12));
  CHECK(std::remainder(relative_heading(0.0, 90.0 * kDegree) - 0.5 * std::numbers::pi, 2 * std::numbers::pi) ==
        Approx(0.0).margin(1e-12));
}

TEST_CASE("A sample is workable when height, wind, daylight and limits say so", "[weather]") {
  WeatherRecord record = record_of({1.0, 1.5, 1.6, kNaN, 1.0, 1.0}, 3.0);
  record.period = {8.0, 8.0, 8.0, 8.0, 20.0, kNaN};
  record.wind = {5.0, 15.0, 5.0, 5.0, 5.0, 5.0};
  const OperationLimits limits{{{"", LimitSurface({4.0, 16.0}, {}, {{1.5}, {1.5}})}}};
  const Workability w = judge_weather(record, limits, {});
  using S = SampleState;
  CHECK(w.state == std::vector<S>{S::workable, S::workable, S::too_high, S::missing, S::outside, S::missing});
  WeatherRules rules;
  rules.wind_max = 10.0;
  CHECK(judge_weather(record, limits, rules).state[1] == S::windy);
  rules = {};
  rules.daylight = {{3.0, 6.0}};  // the second sample, from 3 to 6, alone
  CHECK(judge_weather(record, limits, rules).state[0] == S::dark);
  CHECK(judge_weather(record, limits, rules).state[1] == S::workable);
}

const std::vector<double> kSevenDays = {1.2, 1.4, 1.6, 1.8, 2.0, 2.2, 1.9, 1.4, 1.1, 0.9, 0.8, 1.0, 1.3, 1.7,
                                        1.6, 1.2, 1.0, 1.1, 1.6, 1.9, 1.4, 1.2, 1.5, 1.5, 1.6, 1.4, 1.3, 1.1};

TEST_CASE("Seven days whose windows were counted by hand", "[weather]") {
  const Workability w = judge_weather(record_of(kSevenDays, 6.0), limit_of(1.5), {});
  CHECK(w.counts[0] == 18);  // of 28; a height that equals the limit counts
  CHECK(calms(w) == std::vector<double>{12, 36, 18, 24, 18});
  const auto starts = [](const WindowStatistics& s) {
    std::vector<int> at;
    for (std::size_t i = 0; i < s.wait_h.size(); ++i)
      if (s.wait_h[i] == 0.0) at.push_back(static_cast<int>(i));
    return at;
  };
  const WindowStatistics day = find_windows(w, 24.0, RecordEnd::censor, {1.0});
  CHECK(starts(day) == std::vector<int>{7, 8, 9, 20});
  CHECK(day.all.mean_h == Approx(23.714).margin(0.5e-3));
  CHECK(day.censored == 7);
  CHECK(day.all.within[0].share == Approx(12.0 / 21.0));
  const WindowStatistics ring = find_windows(w, 24.0, RecordEnd::wrap, {1.0});
  CHECK(starts(ring) == std::vector<int>{7, 8, 9, 20, 25, 26});
  CHECK(ring.all.mean_h == Approx(21.643).margin(0.5e-3));
  CHECK(ring.all.within[0].share == Approx(18.0 / 28.0));
  const WindowStatistics half = find_windows(w, 12.0, RecordEnd::censor, {1.0});
  CHECK(half.starts == 13);
  CHECK(half.all.mean_h == Approx(8.0));
  CHECK(half.censored == 1);
  CHECK(half.all.within[0].share == Approx(21.0 / 23.0));
  const WindowStatistics half_ring = find_windows(w, 12.0, RecordEnd::wrap, {1.0});
  CHECK(half_ring.starts == 14);
  CHECK(half_ring.all.mean_h == Approx(7.714).margin(0.5e-3));
  CHECK(half_ring.all.within[0].share == Approx(26.0 / 28.0));
}

TEST_CASE("Waits in a two-state Markov chain are those in closed form", "[weather]") {
  constexpr double p = 0.1, r = 0.05;  // leave calm, leave storm
  constexpr std::size_t kSteps = 2'000'000;
  std::vector<double> heights;
  bool calm = true;
  for (std::size_t i = 0; i < kSteps; ++i) {
    heights.push_back(calm ? 1.0 : 2.0);
    if (portable_uniform(5, 0, i) < (calm ? p : r)) calm = !calm;
  }
  const Workability w = judge_weather(record_of(std::move(heights), 1.0), limit_of(1.5), {});
  struct Row {
    int m;
    double startable, wait;
  };
  for (const Row& row :
       {Row{1, 0.33333, 13.3333}, Row{2, 0.3, 15.6667}, Row{4, 0.243, 21.4856}, Row{8, 0.159432, 39.0559}}) {
    const double q = std::pow(1.0 - p, row.m - 1);
    const double in_calm = (1.0 - q) / p - (row.m - 1) * q, in_storm = (1.0 / r + in_calm) / q;
    const double wait = (r * (in_calm + (1.0 - q) * in_storm) + p * in_storm) / (p + r);
    CHECK(wait == Approx(row.wait).margin(0.5e-4));  // the printed numbers are this form's
    const WindowStatistics s = find_windows(w, row.m, RecordEnd::censor, {});
    CAPTURE(row.m);
    // Two million steps hold 67,000 calms and storms: their mean is known to half a per cent, waits to two.
    CHECK(s.all.start_share == Approx(row.startable).epsilon(0.02));
    CHECK(s.all.mean_h == Approx(row.wait).epsilon(0.02));
  }
}

TEST_CASE("Months that the record cuts are counted, but do not speak for a year", "[weather]") {
  // From 15 January to 10 March: February alone is whole.
  const Workability w = judge_weather(record_of(std::vector<double>(55, 1.0), 24.0, "2021-01-15"), limit_of(1.5), {});
  const MonthlyWorkability months = monthly(w);
  CHECK(months.samples[0] == 17);
  CHECK(months.by_year[0].years.empty());
  CHECK(months.by_year[1].years == std::vector<int>{2021});
  CHECK(months.by_year[2].years.empty());
  CHECK(std::isnan(months.share[5]));
  CHECK(months.whole_years.years.empty());
  CHECK(std::isnan(months.by_year[1].p50()));  // one year has no percentiles
}

TEST_CASE("The empirical law of calms gives its printed numbers", "[weather]") {
  const WeibullHeights heights{0.3, 1.5, 1.4};
  CHECK(heights.mean() == Approx(1.66714).margin(0.5e-5));
  const CalmLaw law(heights, 1.5);
  CHECK(law.mean_h() == Approx(35.17).margin(0.5e-2));
  CHECK(law.longer_than(12.0) == Approx(0.4377).margin(0.5e-4));
  CHECK(heights.height_exceeded(heights.exceedance(1.5)) == Approx(1.5));
  // A table made of this distribution gives it back; its bins are exact, so only the grid of the location remains.
  ScatterTable table;
  for (int i = 0; i < 16; ++i) {
    const double low = 0.5 * i;
    table.bins.push_back(
        {0, kNaN, low, low + 0.5, 5.0, 6.0, 1e5 * (heights.exceedance(low) - heights.exceedance(low + 0.5))});
  }
  const auto fitted = fit_heights(table);
  REQUIRE(fitted);
  CHECK(fitted->location == Approx(0.3).margin(0.01));
  CHECK(fitted->shape == Approx(1.4).epsilon(0.02));
  CHECK(fitted->mean() == Approx(heights.mean()).epsilon(0.01));
}

TEST_CASE("Alpha factors between their rows, and beyond them", "[weather]") {
  const AlphaTable table;
  CHECK(table.factor(10.0, 1.5) == Approx(0.705));
  CHECK(1.5 * table.factor(10.0, 1.5) == Approx(1.0575));
  CHECK(table.factor(20.0, 2.5) == Approx(0.7375));
  CHECK(2.5 * table.factor(20.0, 2.5) == Approx(1.8437).margin(0.5e-4));
  CHECK(table.factor(12.0, 0.5) == 0.65);
  CHECK(table.factor(12.0, 9.0) == 0.80);
  CHECK(table.factor(72.0, 2.0) == 0.63);
  CHECK_THROWS(table.factor(73.0, 2.0));
  CHECK(reference_period(10.0).total_h() == 16.0);  // 6 h at least
  CHECK(reference_period(20.0).total_h() == 30.0);
  CHECK_THROWS(AlphaTable(std::vector<AlphaTable::Row>{{12, 1, 1.2}}));
  CHECK_THROWS(AlphaTable(std::vector<AlphaTable::Row>{{12, 1, 0.7}, {12, 1, 0.8}}));
}

TEST_CASE("A lift may start before the sea of its set-down has come", "[weather]") {
  // Hours 0 to 11 rough for the set-down, fine for the lift-off; 3 h each, T_C = 6 h.
  std::vector<double> heights(12, 1.2);
  heights.insert(heights.end(), 24, 0.5);
  const WeatherRecord forecast = record_of(heights, 1.0);
  const OperationLimits limits{{{"lift_off", LimitSurface(2.5)}, {"set_down", LimitSurface(1.0)}}};
  GoNoGoRules rules;
  rules.period = reference_period(6.0);
  rules.alpha = AlphaTable();
  const std::vector<PlannedPhase> phases = {{"lift_off", 0.0, 3.0}, {"set_down", 3.0, 6.0}};
  const GoNoGo d = decide(forecast, limits, phases, rules);
  REQUIRE(d.first_start);
  // Set-down is from 3 h after the start on: 9 h is the first start whose set-down begins at 12 h.
  CHECK(*d.first_start == 9);
  CHECK_FALSE(d.go_now());
  CHECK(d.now[0].go());
  CHECK_FALSE(d.now[1].go());
  CHECK(*d.now[1].first_broken == 3);
  CHECK(d.samples[1][0].alpha == Approx(0.65));
  CHECK(d.samples[1][0].allowed == Approx(0.65));
  // The last start has 12 h of forecast before it: samples 0 to 24.
  CHECK(d.starts_told == 25);
  // As one operation it must wait for the sea of its set-down altogether.
  const GoNoGo whole = decide(forecast, limit_of(1.0), {{"", 0.0, 6.0}}, rules);
  CHECK(*whole.first_start == 12);
  rules.period = reference_period(80.0);
  CHECK_THROWS_WITH(decide(forecast, limit_of(1.0), {{"", 0.0, 80.0}}, rules),
                    Catch::Contains("unrestricted by weather"));
  rules.period = reference_period(6.0);
  CHECK_THROWS_WITH(decide(forecast, {{{"other", LimitSurface(1.0)}}}, phases, rules), Catch::Contains("lift_off"));
}

TEST_CASE("Alpha by lead time is gentler near, and never harsher than by the operation's time", "[weather]") {
  const WeatherRecord forecast = record_of(std::vector<double>(120, 0.5), 1.0);
  GoNoGoRules rules;
  rules.period = reference_period(36.0);
  const GoNoGo by_operation = decide(forecast, limit_of(1.0), {{"", 0.0, 36.0}}, rules);
  rules.by_lead_time = true;
  const GoNoGo by_lead = decide(forecast, limit_of(1.0), {{"", 0.0, 36.0}}, rules);
  CHECK(by_operation.samples[0][0].alpha == 0.62);
  CHECK(by_lead.samples[0][0].alpha == 0.65);
  CHECK(by_lead.samples[0][11].alpha == 0.65);  // ends 12 h ahead
  CHECK(by_lead.samples[0][12].alpha == 0.63);
  CHECK(by_lead.samples[0][119].alpha == 0.62);  // capped at T_POP
}

TEST_CASE("Periods of a JONSWAP spectrum in terms of each other", "[weather]") {
  // Pierson-Moskowitz in closed form: Tp/Tz = (1.25 pi)^(1/4), Te/Tp = Gamma(1.25)/1.25^(1/4).
  CHECK(period_ratios(1.0).peak_over_zero_crossing == Approx(1.407716).epsilon(1e-5));
  CHECK(1.0 / period_ratios(1.0).peak_over_energy == Approx(std::tgamma(1.25) / std::pow(1.25, 0.25)).epsilon(1e-5));
  // DNV-RP-C205, 3.5.5.5: Tz/Tp = 0.6673 + 0.05037 g - 0.006230 g^2 + 0.0003341 g^3, a fit good to half a per cent.
  for (const double g : {2.0, 3.3, 5.0}) {
    const double fit = 0.6673 + 0.05037 * g - 0.006230 * g * g + 0.0003341 * g * g * g;
    CHECK(1.0 / period_ratios(g).peak_over_zero_crossing == Approx(fit).epsilon(5e-3));
  }
}

}  // namespace
}  // namespace stillhook
