#include "problems/spectra/elevation_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

#include "problems/field_table.h"
#include "sim/csv_cells.h"
#include "sim/error.h"
#include "sim/number_text.h"

namespace stillhook {
namespace {

double factor_of(RecordFileSpec::Unit unit) {
  return unit == RecordFileSpec::Unit::feet ? 0.3048 : unit == RecordFileSpec::Unit::centimetres ? 0.01 : 1.0;
}

double cell_number(const std::string& file, int line, const CsvCell& cell, const std::string& name) {
  const std::optional<double> value = number_with_point(cell.text);
  if (!value)
    throw FileError(file + ":" + std::to_string(line) + ": expected a number in \"" + name + "\", got \"" +
                    std::string(cell.text) + "\"");
  return *value;
}

/// s; throws where a step differs from the mean by more than 1 % of it.
double even_step(const std::vector<double>& time, const std::string& file) {
  if (time.size() < 2) throw FileError(file + ": needs at least two rows of numbers");
  const double step = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  for (std::size_t i = 0; i + 1 < time.size(); ++i)
    if (!(std::abs(time[i + 1] - time[i] - step) <= 0.01 * step))
      throw FileError(file + ": its times must rise in even steps (" + number_text(step) + " s on the whole), but " +
                      number_text(time[i]) + " s is followed by " + number_text(time[i + 1]) + " s");
  return step;
}

}  // namespace

MeasuredSeries read_measured_series(const std::string& file, const std::string& wanted) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream whole;
  whole << in.rdbuf();
  if (!in) throw FileError(file + ": cannot be read");
  const std::string text = whole.str();
  MeasuredSeries series;
  std::vector<double> time;
  try {
    CsvRows rows(text);
    const char separator = rows.find_separator();
    std::vector<CsvCell> cells;
    if (!rows.next(separator, cells)) throw FileError(file + ": is empty");
    std::vector<std::string> names;
    for (const CsvCell& cell : cells) names.emplace_back(cell.text);
    const auto column = static_cast<std::size_t>(std::ranges::find(names, wanted) - names.begin());
    if (column == names.size())
      throw FileError(file + ": has no column \"" + wanted + "\"" + did_you_mean(wanted, names));
    if (column == 0) throw FileError(file + ": the first column is the time in s");
    while (rows.next(separator, cells)) {
      if (cells.size() <= column)
        throw FileError(file + ":" + std::to_string(rows.line()) + ": has no cell under \"" + wanted + "\"");
      time.push_back(cell_number(file, rows.line(), cells[0], names[0]));
      series.value.push_back(cell_number(file, rows.line(), cells[column], wanted));
    }
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw FileError(file + ": " + error.what());
  }
  series.step = even_step(time, file);
  series.source = file.substr(file.find_last_of('/') + 1) + ", column " + wanted;
  return series;
}

ElevationRecord read_elevation_file(const RecordFileSpec& spec) {
  MeasuredSeries series = read_measured_series(spec.file, spec.column);
  for (double& v : series.value) v *= factor_of(spec.unit);
  return {series.step, std::move(series.value), std::move(series.source)};
}

WindRecord read_wind_file(const WindSpec& wind) {
  MeasuredSeries series = read_measured_series(wind.record_file, wind.column);
  for (std::size_t i = 0; i < series.value.size(); ++i)
    if (!(series.value[i] >= 0.0))
      throw FileError(wind.record_file + ": value " + std::to_string(i + 1) + " is a wind speed below 0, " +
                      number_text(series.value[i]) + " m/s");
  return {series.step, std::move(series.value), std::move(series.source)};
}

}  // namespace stillhook
