// The text of a coefficient file as header keys and rows, each with its line; what the rows mean is
// read_coefficient_file's concern.
#pragma once

#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace stillhook {

/// One row of the table, and where it stood.
struct CoefficientRow {
  int line = 0;
  std::string quantity;   // Ainf, K, A, B or X
  int i = 0;              // mode from 0
  double column = 0.0;    // mode from 0; X: heading in deg
  double argument = 0.0;  // rad/s; K: s
  double value = 0.0;
  double phase = 0.0;  // deg
  std::pair<int, int> pair() const { return {i, static_cast<int>(column)}; }
};

/// Header and rows of one file, each field checked by itself.
class CoefficientText {
 public:
  /// Throws SpecificationError ("<path>:<line>").
  explicit CoefficientText(const std::string& path);

  const std::string& path() const { return path_; }
  int modes() const { return modes_; }
  /// X is given on one side and mirrored.
  bool mirrored() const { return mirrored_; }
  int last_line() const { return line_; }
  const std::vector<CoefficientRow>& rows() const { return rows_; }

  /// Value of a header key; every file has them all but waterplane_m2, gap_rise and
  /// gap_frequency_rad_s.
  std::string header_text(const std::string& key) const;
  bool has(const std::string& key) const { return header_.contains(key); }
  /// A number >= low, or > low when `open`.
  double header_number(const std::string& key, double low, bool open) const;
  /// One number > 0 for each hull; nothing where the header does not give the key.
  std::vector<double> per_hull(const std::string& key) const;

  [[noreturn]] void fail(int line, const std::string& sentence) const;

 private:
  bool next_line(std::string& text);
  double number(const std::string& field, const char* what, int line) const;
  int mode(const std::string& field, const char* what) const;
  void require_header(const std::string& key, const std::vector<std::string>& allowed) const;
  void read_header();
  void check_conventions();
  void read_rows();
  CoefficientRow parse_row(const std::vector<std::string>& field) const;

  std::string path_;
  std::ifstream in_;
  int line_ = 0, modes_ = 6;
  bool mirrored_ = false;
  std::map<std::string, std::pair<int, std::vector<std::string>>> header_;
  std::vector<CoefficientRow> rows_;
};

}  // namespace stillhook
