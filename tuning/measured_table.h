// The columns of a measured file, as they stand in it: CSV (RFC 4180; commas, semicolons, tabs or blanks; "#" opens a
// comment; decimal commas where the comma does not part the cells) or NetCDF (variables over one dimension, found by
// name or by their attribute `channel`, as in history.nc).
#pragma once

#include <string>
#include <vector>

namespace stillhook {

struct MeasuredTable {
  std::string file;
  std::vector<std::string> names;           // as asked for
  std::vector<std::vector<double>> values;  // [column][row]; NaN where a cell is empty or says so
  std::vector<std::string> units;           // by column, of NetCDF's attribute `units`; empty: the file does not say
  std::vector<int> lines;                   // of each row in the file; NetCDF: its index from 1

  std::size_t rows() const { return lines.size(); }
  /// "run.csv:17" of a row, for messages.
  std::string place(std::size_t row) const;
};

/// Reads the named columns. Throws CaseError that names file and line: a file that cannot be read (a pipe, a folder,
/// another format), a column that it does not have (with the nearest) or has twice, a cell that is no number.
MeasuredTable read_measured_table(const std::string& path, const std::vector<std::string>& names);

/// True if a file begins as NetCDF does.
bool is_netcdf_file(const std::string& path);

/// Why a measured run cannot be read from a path, as the end of a sentence; empty if it is a file.
std::string fault_of_measured_path(const std::string& path);

}  // namespace stillhook
