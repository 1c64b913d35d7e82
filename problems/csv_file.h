// A CSV file with the names of its columns in its first row: what every reader of one refuses is refused here, and how
// numbers stand in it is decided once for the whole file (RFC 4180; commas, semicolons, tabs or blanks; "#" opens a
// comment; decimal commas where the comma does not part the cells).
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/csv_cells.h"

namespace stillhook {

class CsvFile {
 public:
  /// Reads the whole file and its line of names. `needed` ends the sentence about a file that is no text, as "a
  /// measured run must be CSV or NetCDF". Throws CaseError that names file and line.
  CsvFile(std::string path, const std::string& needed);

  const std::string& path() const { return path_; }
  char separator() const { return separator_; }
  const std::vector<std::string>& names() const { return names_; }
  int line_of_names() const { return line_of_names_; }

  /// Which column has this name. Throws CaseError: there is none (with the nearest), or there are two. `wanted`: all
  /// the names that the reader looks for, so that a first row that has none of them is asked about.
  std::size_t column(const std::string& name, const std::vector<std::string>& wanted) const;

  /// The next row's cells, at least as many as there are names; false at the end. A line of units under the names, as
  /// loggers write it, is passed over: one whose cells in `columns` all may be units. Throws CaseError.
  bool next(std::vector<CsvCell>& cells, const std::vector<std::size_t>& columns);
  int line() const { return rows_->line(); }
  /// "run.csv:17" of the row last read.
  std::string place() const;

 private:
  bool next_row(std::vector<CsvCell>& cells);
  void take_names(const std::vector<CsvCell>& cells);
  void check_count(const std::vector<CsvCell>& cells) const;

  std::string path_, text_;
  std::unique_ptr<CsvRows> rows_;  // looks into text_
  char separator_ = ' ';
  std::vector<std::string> names_;
  int line_of_names_ = 1;
  bool first_row_ = true;
};

/// The numbers of a CSV file: with a decimal point, or all of them with a decimal comma.
class CsvNumbers {
 public:
  explicit CsvNumbers(const CsvFile& file) : file_(file) {}
  /// NaN for a cell that says that there is nothing. Throws CaseError "run.csv:17: column "z": is no number: ...".
  double take(const CsvCell& cell, const std::string& column);
  /// At the end of the file: a comma that may be decimal or part the thousands is not guessed. Throws CaseError.
  void refuse_ambiguous_commas() const;

 private:
  struct SeenCell {
    std::string text;
    int line = 0;
  };
  const CsvFile& file_;
  SeenCell comma_, point_;  // the first number with each
  bool certain_comma_ = false;
};

}  // namespace stillhook
