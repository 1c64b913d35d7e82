#include "planner/weather/record_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/weather/record_columns.h"
#include "problems/case.h"
#include "sim/spatial/constants.h"
#include "tuning/measured_netcdf.h"
#include "tuning/measured_table.h"

namespace stillhook {
namespace {

constexpr std::size_t kMostSamples = 20'000'000;  // two thousand years by the hour

/// Values of a quantity that can be.
struct Bounds {
  double low, high;
  const char* rule;
};
constexpr Bounds kHeightBounds = {0.0, 30.0, "a height from 0 to 30 m; leave the cell empty where there is none"};
constexpr Bounds kPeriodBounds = {0.0, 60.0, "a period from 0 to 60 s; leave the cell empty where there is none"};
constexpr Bounds kAngleBounds = {-2.0 * std::numbers::pi, 2.0 * std::numbers::pi, "an angle from -360 to 360 deg"};
constexpr Bounds kWindBounds = {0.0, 120.0, "a wind speed from 0 to 120 m/s; leave the cell empty where there is none"};

/// Rows as they stand in a file.
struct RecordRows {
  std::string file;
  std::vector<int> lines;
  std::vector<UnixTime> times;
  std::vector<double> height, period, from, wind;  // SI; empty: not in the file
  std::string place(std::size_t row) const { return fmt::format("{}:{}", file, lines[row]); }
};

void check_bounds(const RecordRows& rows, std::vector<double>& values, const std::optional<ChosenColumn>& column,
                  const Bounds& bounds) {
  if (!column) return;
  // A whisker more: 360 deg in radians is not exactly a turn.
  const double slack = 1e-6 * bounds.high;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] < bounds.low - slack || values[i] > bounds.high + slack)
      throw CaseError(fmt::format("{}: column \"{}\": must be {}, got {:g}{}", rows.place(i), column->header,
                                  bounds.rule, values[i] / column->factor,
                                  column->unit_given ? ""
                                                     : "; or the column is in another unit: write it in brackets after "
                                                       "the name"));
}

/// Directions in radians whose column has no unit would pass as degrees.
void refuse_radians_without_unit(const RecordRows& rows, const std::optional<ChosenColumn>& column) {
  if (!column || column->unit_given || rows.from.size() < 50) return;
  double largest = 0.0;
  for (const double angle : rows.from)
    if (!std::isnan(angle)) largest = std::max(largest, std::abs(angle));
  if (largest * 180.0 / std::numbers::pi <= 6.2832)
    throw CaseError(
        fmt::format("{}:1: column \"{}\": no value is above 6.2832: are they radians? Write the unit in brackets "
                    "after the name, [rad] or [deg]",
                    rows.file, column->header));
}

/// Times in order, and the step that all of them are multiples of.
UnixTime step_of(const RecordRows& rows) {
  if (rows.times.size() < 2)
    throw CaseError(
        fmt::format("{}: has {} rows; two at least are needed to know the step", rows.file, rows.times.size()));
  UnixTime step = std::numeric_limits<UnixTime>::max();
  for (std::size_t i = 1; i < rows.times.size(); ++i) {
    const UnixTime difference = rows.times[i] - rows.times[i - 1];
    if (difference <= 0)
      throw CaseError(
          fmt::format("{}: time {} must be later than {} in the row before; sort the rows and keep each time once",
                      rows.place(i), instant_text(rows.times[i]), instant_text(rows.times[i - 1])));
    step = std::min(step, difference);
  }
  for (std::size_t i = 1; i < rows.times.size(); ++i)
    if ((rows.times[i] - rows.times[0]) % step != 0)
      throw CaseError(fmt::format(
          "{}: time {} is not a whole number of steps of {:g} h after the first, {}; weather must "
          "stand in equal steps: interpolate or thin it out",
          rows.place(i), instant_text(rows.times[i]), static_cast<double>(step) / kHour, instant_text(rows.times[0])));
  const std::size_t span = static_cast<std::size_t>((rows.times.back() - rows.times.front()) / step);
  if (span >= kMostSamples)
    throw CaseError(fmt::format("{}: from {} to {} in steps of {:g} h are more than {} samples; is a time wrong?",
                                rows.file, instant_text(rows.times.front()), instant_text(rows.times.back()),
                                static_cast<double>(step) / kHour, kMostSamples));
  return step;
}

WeatherRecord in_equal_steps(RecordRows rows, const RecordColumns& columns) {
  check_bounds(rows, rows.height, columns.height, kHeightBounds);
  check_bounds(rows, rows.period, columns.period, kPeriodBounds);
  check_bounds(rows, rows.from, columns.from, kAngleBounds);
  check_bounds(rows, rows.wind, columns.wind, kWindBounds);
  refuse_radians_without_unit(rows, columns.from);
  WeatherRecord record;
  record.step = step_of(rows);
  record.start = rows.times.front();
  const std::size_t n = static_cast<std::size_t>((rows.times.back() - record.start) / record.step) + 1;
  record.gaps = n - rows.times.size();
  const auto spread = [&](const std::vector<double>& from, std::vector<double>& to) {
    if (from.empty()) return;
    to.assign(n, kNaN);
    for (std::size_t i = 0; i < from.size(); ++i)
      to[static_cast<std::size_t>((rows.times[i] - record.start) / record.step)] = from[i];
  };
  spread(rows.height, record.height);
  spread(rows.period, record.period);
  spread(rows.from, record.from);
  spread(rows.wind, record.wind);
  for (double& period : record.period)
    if (period == 0.0) period = kNaN;  // of a flat sea
  if (columns.from && columns.from->turned)
    for (double& angle : record.from) angle += std::numbers::pi;
  record.remarks.push_back(columns.height.remark);
  for (const auto& column : {columns.period, columns.from, columns.wind})
    if (column) record.remarks.push_back(column->remark);
  if (record.gaps > 0)
    record.remarks.push_back(fmt::format("{} samples between the first and the last row are missing", record.gaps));
  return record;
}

WeatherRecord read_record_csv(const std::string& path, const WeatherSpec& spec) {
  CsvFile file(path, "weather must be CSV or NetCDF");
  std::vector<OfferedColumn> offered;
  for (const std::string& header : file.names()) {
    const ColumnName column = column_name(header);
    offered.push_back({header, column.name, column.unit, ""});
  }
  const RecordColumns columns = choose_columns(fmt::format("{}:{}", path, file.line_of_names()), offered, spec);
  const std::size_t time = file.column(columns.time, file.names());
  struct Read {
    std::size_t index;
    const ChosenColumn* column;
    std::vector<double>* to;
  };
  RecordRows rows;
  rows.file = path;
  std::vector<Read> reads;
  const auto add = [&](const ChosenColumn& column, std::vector<double>& to) {
    reads.push_back({file.column(column.header, file.names()), &column, &to});
  };
  add(columns.height, rows.height);
  if (columns.period) add(*columns.period, rows.period);
  if (columns.from) add(*columns.from, rows.from);
  if (columns.wind) add(*columns.wind, rows.wind);
  std::vector<std::size_t> wanted = {time};
  for (const Read& read : reads) wanted.push_back(read.index);
  CsvNumbers numbers(file);
  for (std::vector<CsvCell> cells; file.next(cells, wanted);) {
    const std::optional<UnixTime> instant = instant_of(cells[time].text);
    if (!instant)
      throw CaseError(fmt::format("{}: column \"{}\": must be a time as 2019-01-01T03:00Z, got \"{}\"", file.place(),
                                  columns.time, cells[time].text.substr(0, 40)));
    rows.times.push_back(*instant);
    rows.lines.push_back(file.line());
    for (const Read& read : reads)
      read.to->push_back(numbers.take(cells[read.index], read.column->header) * read.column->factor);
  }
  numbers.refuse_ambiguous_commas();
  return in_equal_steps(std::move(rows), columns);
}

/// "hours since 1900-01-01 00:00:00.0": seconds per unit and the origin.
std::pair<double, UnixTime> time_unit(const std::string& path, const std::string& name, const std::string& units) {
  const std::size_t since = units.find(" since ");
  if (since != std::string::npos) {
    const std::string unit = units.substr(0, since);
    std::string from = units.substr(since + 7);
    // "1900-1-1" and "1970-01-01 00:00:0.0" are seen, but not to be guessed: only ISO 8601 is read.
    if (from.ends_with(" UTC")) from.erase(from.size() - 4);
    const std::optional<UnixTime> origin = instant_of(from);
    for (const auto& [known, seconds] :
         {std::pair("second", 1.0), std::pair("minute", 60.0), std::pair("hour", 3600.0), std::pair("day", 86400.0)})
      if (origin && (unit == known || unit == std::string(known) + "s")) return {seconds, *origin};
  }
  throw CaseError(
      fmt::format("{}: variable \"{}\": its attribute units must be as \"hours since 1970-01-01 00:00:00\", got "
                  "\"{}\"",
                  path, name, units));
}

WeatherRecord read_record_netcdf(const std::string& path, const WeatherSpec& spec) {
  std::vector<OfferedColumn> offered;
  std::string time_units;
  const std::vector<MeasuredVariable> variables = variables_of_netcdf(path);
  for (const MeasuredVariable& v : variables)
    offered.push_back({v.name, v.name, v.units == "1" ? "" : v.units, v.standard_name});
  const RecordColumns columns = choose_columns(path, offered, spec);
  for (const MeasuredVariable& v : variables)
    if (v.name == columns.time) time_units = v.units;
  const auto [seconds, origin] = time_unit(path, columns.time, time_units);
  std::vector<std::string> names = {columns.time, columns.height.header};
  for (const auto& column : {columns.period, columns.from, columns.wind})
    if (column) names.push_back(column->header);
  const MeasuredTable table = read_measured_netcdf(path, names);
  RecordRows rows;
  rows.file = path;
  rows.lines = table.lines;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double time = table.values[0][i] * seconds;
    if (!(std::abs(time) < 1e12))
      throw CaseError(fmt::format("{}: variable \"{}\": must be a time, got {:g}", rows.place(i), columns.time, time));
    rows.times.push_back(origin + static_cast<UnixTime>(std::llround(time)));
  }
  std::size_t next = 1;
  const auto take = [&](const ChosenColumn& column, std::vector<double>& to) {
    to = table.values[next++];
    for (double& value : to) value *= column.factor;
  };
  take(columns.height, rows.height);
  if (columns.period) take(*columns.period, rows.period);
  if (columns.from) take(*columns.from, rows.from);
  if (columns.wind) take(*columns.wind, rows.wind);
  return in_equal_steps(std::move(rows), columns);
}

}  // namespace

WeatherRecord read_record_file(const std::string& path, const WeatherSpec& spec) {
  if (const std::string fault = fault_of_measured_path(path); !fault.empty())
    throw CaseError(path + ": cannot be read: " + fault);
  return is_netcdf_file(path) ? read_record_netcdf(path, spec) : read_record_csv(path, spec);
}

}  // namespace stillhook
