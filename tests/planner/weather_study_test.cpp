// Workability, windows and limits against another program: three invented years, their scatter table and the stub
// simulator of an operability study (tests/truth/weather).
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "planner/verbs/weather/study.h"
#include "planner/weather/limit_file.h"
#include "planner/weather/scatter_file.h"
#include "results/statistics/limiting_height.h"
#include "results/statistics/sample.h"
#include "tuning/measured_table.h"

#include "sim/spatial/pose.h"

// After pose.h, whose vectors it uses.
#include "sim/sea/spectrum.h"

namespace stillhook {
namespace {

using nlohmann::json;

const std::string kWeather = std::string(STILLHOOK_SOURCE_DIR) + "/problems/weather/";
const std::string kTruth = std::string(STILLHOOK_SOURCE_DIR) + "/tests/truth/weather/";
constexpr double kDegree = std::numbers::pi / 180.0;

json expected() { return json::parse(std::ifstream(kTruth + "expected.json")); }

WeatherTask hindcast_task() {
  WeatherTask task;
  task.limits = read_limit_file(kWeather + "limits.csv");
  task.limits_source = "limits.csv";
  task.spec.hindcast = kWeather + "hindcast.csv";
  task.spec.bow_towards = 250.0 * kDegree;
  return task;
}

// Shares are counts over counts, waits sums of whole hours: the other program's doubles may differ in their last bits.
constexpr double kBits = 1e-12;

TEST_CASE("Three years of hindcast: workability by month and year, as another program has it", "[weather]") {
  const json truth = expected();
  const WeatherStudy study = study_weather(hindcast_task());
  const HindcastStudy& h = *study.hindcast;
  CHECK(h.record.size() == truth["samples"].get<std::size_t>());
  CHECK(h.record.step_h() == truth["step_h"].get<double>());
  CHECK(h.workability.counts[static_cast<std::size_t>(SampleState::outside)] ==
        truth["outside_envelope"].get<std::size_t>());
  CHECK(h.workability.share() == Approx(truth["workable"].get<double>()).epsilon(kBits));
  for (std::size_t m = 0; m < 12; ++m) {
    CHECK(h.months.share[m] == Approx(truth["by_month"][std::to_string(m + 1)].get<double>()).epsilon(kBits));
    const YearSpread& years = h.months.by_year[m];
    REQUIRE(years.years == std::vector<int>{2019, 2020, 2021});
    for (std::size_t y = 0; y < 3; ++y) {
      const std::string key = std::to_string(years.years[y]) + (m < 9 ? "-0" : "-") + std::to_string(m + 1);
      CHECK(years.values[y] == Approx(truth["by_month_year"][key].get<double>()).epsilon(kBits));
    }
  }
  WeatherTask plain = hindcast_task();
  plain.limits.limits.phases = {{"", LimitSurface(1.5)}};
  CHECK(study_weather(plain).hindcast->workability.share() ==
        Approx(truth["workable_hs_only_1p5"].get<double>()).epsilon(kBits));
  const std::vector<double> lengths = calms(h.workability);
  const json& runs = truth["runs"];
  CHECK(lengths.size() == runs["number"].get<std::size_t>());
  CHECK(mean_of(lengths) == Approx(runs["mean_h"].get<double>()).epsilon(kBits));
  CHECK(*std::max_element(lengths.begin(), lengths.end()) == runs["longest_h"].get<double>());
  CHECK(std::count_if(lengths.begin(), lengths.end(), [](double l) { return l >= 24.0; }) ==
        runs["at_least_24h"].get<int>());
}

TEST_CASE("Three years of hindcast: windows and waits, as another program has them", "[weather]") {
  const json truth = expected();
  for (const bool wrap : {false, true}) {
    WeatherTask task = hindcast_task();
    task.spec.horizons = {1 * kDay, 3 * kDay, 7 * kDay};
    if (wrap) task.spec.record_end = WeatherSpec::End::wrap;
    const WeatherStudy study = study_weather(task);
    REQUIRE(study.hindcast->windows.size() == 4);  // 6, 12, 24 and 48 h without an operation
    for (const WindowStatistics& w : study.hindcast->windows) {
      const std::string key = "TR_" + std::to_string(static_cast<int>(w.duration_h)) + (wrap ? "h_wrap" : "h_censor");
      CAPTURE(key);
      const json& t = truth[key];
      const auto is = [&](double value, const char* name) {
        CHECK(value == Approx(t[name].get<double>()).epsilon(kBits).margin(1e-12));
      };
      CHECK(w.samples == t["samples"].get<std::size_t>());
      CHECK(w.starts == t["starts"].get<std::size_t>());
      CHECK(w.censored == t["censored"].get<std::size_t>());
      is(w.all.start_share, "start_share");
      is(w.all.mean_h, "mean_wait_h");
      is(w.all.p50_h, "p50_wait_h");
      is(w.all.p80_h, "p80_wait_h");
      is(w.all.p90_h, "p90_wait_h");
      is(w.all.within[0].share, "within_1_days");
      is(w.all.within[1].share, "within_3_days");
      is(w.all.within[2].share, "within_7_days");
      for (std::size_t m = 0; m < 12; ++m) {
        const std::string month = std::to_string(m + 1);
        CHECK(w.by_month[m].mean_h == Approx(t["wait_by_month_mean_h"][month].get<double>()).epsilon(kBits));
        CHECK(w.by_month[m].start_share == Approx(t["start_share_by_month"][month].get<double>()).epsilon(kBits));
      }
    }
  }
}

TEST_CASE("A scatter table of thirty years, as another program has it", "[weather]") {
  const json truth = expected()["scatter"];
  WeatherTask task = hindcast_task();
  task.spec.hindcast.clear();
  task.spec.scatter = kWeather + "scatter.csv";
  const WeatherStudy study = study_weather(task);
  const ScatterStudy& s = *study.scatter;
  CHECK(s.workability.total == truth["total"].get<double>());
  CHECK(s.workability.outside == truth["outside"].get<double>());
  CHECK(s.workability.share == Approx(truth["workable_linear_in_bin"].get<double>()).epsilon(kBits));
  CHECK(s.workability.share_centre == Approx(truth["workable_bin_centre"].get<double>()).epsilon(kBits));
  // The same climate as the hindcast, thirty years of it: three years differ by a few per cent.
  CHECK(s.workability.share == Approx(expected()["workable"].get<double>()).margin(0.03));
  // The form found in reports holds the same counts without directions.
  const ScatterTable wide = read_scatter_file(kTruth + "scatter_wide.csv");
  CHECK(wide.total() == truth["total"].get<double>());
  CHECK(wide.exceedance(1.5) == Approx(s.table.exceedance(1.5)).epsilon(kBits));
}

/// Crossings of the stub simulator: each limit is broken at a height in closed form.
std::vector<std::vector<Crossing>> stub_columns(std::vector<std::pair<double, double>>& conditions) {
  const MeasuredTable t = read_measured_table(
      kTruth + "stub.csv", {"tp [s]", "heading [deg]", "seed", "rehit [1/m]", "offlead [deg/m]", "daf_excess [1/m]"});
  std::vector<std::vector<Crossing>> columns;
  for (std::size_t i = 0; i < t.rows(); ++i) {
    const std::pair condition(t.values[0][i], t.values[1][i]);
    if (conditions.empty() || conditions.back() != condition) {
      conditions.push_back(condition);
      columns.emplace_back();
    }
    const double b = t.values[4][i];
    const std::map<double, const char*> broken = {{1.0 / t.values[3][i], "rehits"},
                                                  {(-1.0 + std::sqrt(1.0 + 2.4 / b)) / 0.4, "offlead_max"},
                                                  {0.2 / t.values[5][i], "daf_excess"}};
    columns.back().push_back({broken.begin()->first, broken.begin()->second});
  }
  return columns;
}

TEST_CASE("Limits of the stub simulator's columns, as another program has them", "[statistics]") {
  std::vector<std::pair<double, double>> conditions;
  const std::vector<std::vector<Crossing>> columns = stub_columns(conditions);
  std::ifstream in(kTruth + "stub_expected.csv");
  std::string line;
  std::getline(in, line);
  int rows = 0;
  while (std::getline(in, line)) {
    std::vector<std::string> cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    REQUIRE(cells.size() == 13);
    CAPTURE(line);
    const std::pair condition(std::stod(cells[0]), std::stod(cells[1]));
    const std::size_t at =
        static_cast<std::size_t>(std::find(conditions.begin(), conditions.end(), condition) - conditions.begin());
    REQUIRE(at < conditions.size());
    const std::vector<Crossing> some(columns[at].begin(), columns[at].begin() + std::stoi(cells[2]));
    const LimitingHeight limit = limiting_height(some);
    constexpr double kPrinted = 0.6e-5;  // five digits, from inputs of five digits
    CHECK(limit.height == Approx(std::stod(cells[3])).margin(kPrinted));
    CHECK(limit.low == Approx(std::stod(cells[4])).margin(kPrinted));
    CHECK(limit.high == Approx(std::stod(cells[5])).margin(kPrinted));
    // The file has the Gumbel limit also where the test of the distribution refuses it.
    if (!std::isnan(limit.gumbel)) CHECK(limit.gumbel == Approx(std::stod(cells[6])).margin(kPrinted));
    CHECK(limiting_height(some, 1.0 / std::numbers::e).height == Approx(std::stod(cells[7])).margin(kPrinted));
    CHECK(limit.governing == cells[8]);
    CHECK(limit.governing_share == Approx(std::stod(cells[9])).margin(0.6e-3));
    ++rows;
  }
  CHECK(rows == 24);
}

/// Width of the 90 % interval of a scatter table's workability when the seeds of all columns are drawn at once, or
/// those of each column on their own. The limit over the period is that of beam seas.
double interval_width(const std::vector<std::vector<Crossing>>& columns,
                      const std::vector<std::pair<double, double>>& conditions, const ScatterTable& table, bool own) {
  const std::size_t seeds = columns.front().size();
  const auto share = [&](const std::vector<std::size_t>& drawn) {
    std::vector<double> periods;
    std::vector<std::vector<double>> grid;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (conditions[c].second != 90.0) continue;
      std::vector<double> heights;
      for (std::size_t i = 0; i < seeds; ++i)
        heights.push_back(columns[c][drawn[own ? c * seeds + i : i] % seeds].height);
      periods.push_back(conditions[c].first);
      grid.push_back({quantile_of(heights, 0.1)});
    }
    return judge_scatter(table, {{{"", LimitSurface(periods, {}, grid)}}}, {}).share;
  };
  const Interval interval = bootstrap_interval(own ? seeds * columns.size() : seeds, share, 1000);
  return interval.high - interval.low;
}

TEST_CASE("Workability's interval is wider when columns share what a seed does to them", "[statistics]") {
  std::vector<std::pair<double, double>> conditions;
  std::vector<std::vector<Crossing>> columns = stub_columns(conditions);
  const ScatterTable table = read_scatter_file(kTruth + "scatter_wide.csv");
  // The stub's columns have nothing in common (their crossings correlate by -0.03 on average), so both ways of drawing
  // say the same: 1000 resamples know such a width to a tenth.
  CHECK(interval_width(columns, conditions, table, false) ==
        Approx(interval_width(columns, conditions, table, true)).epsilon(0.1));
  // Seeds that are high or low in every column alike: errors add up instead of their squares. Where no column holds
  // more than three quarters of the weight that is by 1/sqrt(0.75^2 + 0.25^2) = 1.26 at least, less a tenth of the
  // resampling.
  for (std::vector<Crossing>& column : columns) {
    const double height = column.front().height;
    for (std::size_t seed = 0; seed < column.size(); ++seed)
      column[seed].height = height * (0.7 + 0.6 * portable_uniform(17, 0, seed));
  }
  CHECK(interval_width(columns, conditions, table, false) >
        0.9 * 1.26 * interval_width(columns, conditions, table, true));
}

}  // namespace
}  // namespace stillhook
