// The columns of one WAMIT numeric file, as numbers with their lines.
#pragma once

#include <string>
#include <vector>

namespace stillhook {

struct WamitRow {
  int line = 0;
  std::vector<double> column;
};

class WamitText {
 public:
  /// Throws SpecificationError ("<path>:<line>") when the file cannot be opened, is not text, holds no rows, ends in
  /// the middle of a row, or something that is no finite number. A last row without its line end is whole when it has
  /// as many columns as the row before and its last number as many digits as the others in that column have.
  explicit WamitText(const std::string& path);

  const std::string& path() const { return path_; }
  const std::vector<WamitRow>& rows() const { return rows_; }

  /// Column n as a mode, from 0. Throws unless 1 <= mode <= modes.
  int mode(const WamitRow& row, std::size_t n, int modes) const;
  void require_columns(const WamitRow& row, std::size_t least, std::size_t most) const;

  [[noreturn]] void fail(int line, const std::string& sentence) const;

 private:
  /// Puts the numbers of a line into a row. Returns the last word.
  std::string read_line(int line, const std::string& text);

  std::string path_;
  std::vector<WamitRow> rows_;
};

/// A number as Fortran prints it: with E, D or, for exponents of three digits, neither. False when it is none.
bool fortran_number(const std::string& text, double& value);

}  // namespace stillhook
