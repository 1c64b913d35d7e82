// Text of a table in cells, as RFC 4180 has it: a cell in double quotes may hold separators and line breaks, and a
// quote is written twice in it. Besides commas there are semicolons, tabs, and runs of blanks.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stillhook {

struct CsvCell {
  std::string_view text;  // without quotes and the blanks around it; valid until the next row is read
  bool quoted = false;
};

/// Goes through the rows of a text. Empty lines and those that begin with "#" are no rows.
class CsvRows {
 public:
  explicit CsvRows(std::string_view text);

  /// The separator of the next row: the first of ; tab , that stands in it outside quotes, else a blank. A row
  /// "sep=;", as Excel writes it, names the separator and is passed over.
  char find_separator();
  /// The next row's cells, of which some may be empty; false at the end of the text. Throws std::runtime_error for
  /// a quote that is not closed.
  bool next(char separator, std::vector<CsvCell>& cells);
  /// Of the row last read, from 1.
  int line() const { return line_; }

 private:
  bool at_row();
  bool ends_line(std::size_t at) const { return text_[at] == '\n' || (text_[at] == '\r' && bare_returns_); }
  void skip_line_end();
  CsvCell quoted_cell(char separator);
  CsvCell plain_cell(char separator);
  bool is_separator(std::size_t at, char separator) const;

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 0, lines_passed_ = 0;
  bool bare_returns_ = false;           // lines end as on a Macintosh of the last century
  std::vector<std::string> unescaped_;  // cells of this row in which quotes are doubled
};

/// The number that a cell is, with a point; nothing if it is none. "nan" and "inf" are none.
std::optional<double> number_with_point(std::string_view cell);
/// The same with a decimal comma: "-0,25", "1,5e-3".
std::optional<double> number_with_comma(std::string_view cell);
/// "1,234" may be a thousand or a bit more than one.
bool may_be_thousands(std::string_view cell);
/// A cell that says that there is nothing.
bool says_missing(std::string_view cell);
/// A cell as in a line of units: "s", "[m]", "deg", "1".
bool may_be_unit(std::string_view cell);

}  // namespace stillhook
