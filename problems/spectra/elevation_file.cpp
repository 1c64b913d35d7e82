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

ElevationRecord read_elevation_file(const RecordFileSpec& spec) {
  std::ifstream in(spec.file, std::ios::binary);
  std::ostringstream whole;
  whole << in.rdbuf();
  if (!in) throw FileError(spec.file + ": cannot be read");
  const std::string text = whole.str();
  ElevationRecord record;
  std::vector<double> time;
  try {
    CsvRows rows(text);
    const char separator = rows.find_separator();
    std::vector<CsvCell> cells;
    if (!rows.next(separator, cells)) throw FileError(spec.file + ": is empty");
    std::vector<std::string> names;
    for (const CsvCell& cell : cells) names.emplace_back(cell.text);
    const auto column = static_cast<std::size_t>(std::ranges::find(names, spec.column) - names.begin());
    if (column == names.size())
      throw FileError(spec.file + ": has no column \"" + spec.column + "\"" + did_you_mean(spec.column, names));
    if (column == 0) throw FileError(spec.file + ": the first column is the time in s");
    while (rows.next(separator, cells)) {
      if (cells.size() <= column)
        throw FileError(spec.file + ":" + std::to_string(rows.line()) + ": has no cell under \"" + spec.column + "\"");
      time.push_back(cell_number(spec.file, rows.line(), cells[0], names[0]));
      record.elevation.push_back(factor_of(spec.unit) *
                                 cell_number(spec.file, rows.line(), cells[column], spec.column));
    }
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw FileError(spec.file + ": " + error.what());
  }
  record.step = even_step(time, spec.file);
  record.source = spec.file.substr(spec.file.find_last_of('/') + 1) + ", column " + spec.column;
  return record;
}

}  // namespace stillhook
