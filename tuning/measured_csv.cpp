#include "tuning/measured_csv.h"

#include <algorithm>

#include "problems/csv_file.h"

namespace stillhook {
namespace {

/// Two channels may be asked of one column.
std::size_t first_of(const std::vector<std::string>& names, std::size_t k) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), names[k]) - names.begin());
}

}  // namespace

MeasuredTable read_measured_csv(const std::string& path, const std::vector<std::string>& names) {
  CsvFile file(path, "a measured run must be CSV or NetCDF");
  MeasuredTable table;
  table.file = path;
  table.names = names;
  table.values.resize(names.size());
  table.units.resize(names.size());
  std::vector<std::size_t> columns;
  for (const std::string& name : names) columns.push_back(file.column(name, names));
  CsvNumbers numbers(file);
  for (std::vector<CsvCell> cells; file.next(cells, columns);) {
    table.lines.push_back(file.line());
    for (std::size_t k = 0; k < names.size(); ++k)
      if (first_of(names, k) == k) table.values[k].push_back(numbers.take(cells[columns[k]], names[k]));
  }
  numbers.refuse_ambiguous_commas();
  for (std::size_t k = 0; k < names.size(); ++k)
    if (first_of(names, k) != k) table.values[k] = table.values[first_of(names, k)];
  return table;
}

}  // namespace stillhook
