#include "tuning/measured_csv.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>

#include "problems/case.h"
#include "problems/field_table.h"
#include "sim/spatial/constants.h"
#include "sim/csv_cells.h"

namespace stillhook {
namespace {

constexpr std::size_t kShown = 40;  // characters of a cell in a message

/// A cell worth remembering for a later message.
struct SeenCell {
  std::string text;
  int line = 0;
};

class CsvReader {
 public:
  CsvReader(const std::string& path, const std::vector<std::string>& names) {
    table_.file = path;
    table_.names = names;
    table_.values.resize(names.size());
    table_.units.resize(names.size());
  }

  MeasuredTable read() {
    const std::string text = whole_text();
    refuse_other_formats(text);
    CsvRows rows(text);
    separator_ = rows.find_separator();
    std::vector<CsvCell> cells;
    while (next_row(rows, cells)) {
      if (place_.empty())
        take_names(cells, rows.line());
      else
        take_row(cells, rows.line());
    }
    if (place_.empty()) throw CaseError(table_.file + ":1: has no line with the names of its columns");
    refuse_ambiguous_commas();
    copy_shared_columns();
    return std::move(table_);
  }

 private:
  std::string whole_text() const {
    std::ifstream in(table_.file, std::ios::binary);
    if (!in) throw CaseError(table_.file + ": cannot be read");
    std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    if (in.bad()) throw CaseError(table_.file + ": cannot be read to its end");
    return text;
  }

  /// Files that are no text, by how they begin.
  void refuse_other_formats(std::string_view text) const {
    const auto refuse = [&](const char* what) { throw CaseError(table_.file + ": " + what); };
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
      refuse("is text in UTF-16, as Excel's \"Unicode Text\"; save it as \"CSV UTF-8\"");
    if (text.starts_with("PK\x03\x04")) refuse("is a workbook or an archive, not CSV; save the sheet as \"CSV UTF-8\"");
    if (text.starts_with("\xD0\xCF\x11\xE0")) refuse("is an old Excel workbook; save the sheet as \"CSV UTF-8\"");
    if (text.starts_with("\x1F\x8B")) refuse("is compressed by gzip; unpack it first");
    if (text.starts_with("MATLAB")) refuse("is a file of MATLAB; write the table with writetable() as CSV");
    if (text.substr(0, 65536).find('\0') != std::string_view::npos)
      refuse("is a binary file; a measured run must be CSV or NetCDF");
  }

  bool next_row(CsvRows& rows, std::vector<CsvCell>& cells) const {
    try {
      return rows.next(separator_, cells);
    } catch (const std::runtime_error& error) {
      throw CaseError(fmt::format("{}:{}: {}", table_.file, rows.line(), error.what()));
    }
  }

  void take_names(const std::vector<CsvCell>& cells, int line) {
    std::vector<std::string> found;
    for (const CsvCell& cell : cells) found.emplace_back(cell.text);
    place_.assign(found.size(), -1);
    const auto is_number = [](const std::string& cell) { return number_with_point(cell) || number_with_comma(cell); };
    if (std::all_of(found.begin(), found.end(), is_number))
      throw CaseError(
          fmt::format("{}:{}: has no line with the names of its columns, numbers begin at once", table_.file, line));
    for (std::size_t k = 0; k < table_.names.size(); ++k) {
      if (first_of(k) != k) continue;
      const auto at = std::find(found.begin(), found.end(), table_.names[k]);
      if (at == found.end())
        throw CaseError(fmt::format(
            "{}:{}: has no column \"{}\"{}; it has {}{}", table_.file, line, table_.names[k],
            did_you_mean(table_.names[k], found), shown_names(found),
            knows_none_of_them(found) ? "; is this the line of the names? Lines above it must begin with #" : ""));
      if (const auto second = std::find(at + 1, found.end(), table_.names[k]); second != found.end())
        throw CaseError(fmt::format("{}:{}: has two columns \"{}\", number {} and {}; rename one of them", table_.file,
                                    line, table_.names[k], at - found.begin() + 1, second - found.begin() + 1));
      place_[static_cast<std::size_t>(at - found.begin())] = static_cast<int>(k);
    }
  }

  /// Two channels may be asked of one column.
  std::size_t first_of(std::size_t k) const {
    return static_cast<std::size_t>(std::find(table_.names.begin(), table_.names.end(), table_.names[k]) -
                                    table_.names.begin());
  }

  void copy_shared_columns() {
    for (std::size_t k = 0; k < table_.names.size(); ++k)
      if (first_of(k) != k) table_.values[k] = table_.values[first_of(k)];
  }

  bool knows_none_of_them(const std::vector<std::string>& found) const {
    return std::none_of(table_.names.begin(), table_.names.end(), [&found](const std::string& name) {
      return std::find(found.begin(), found.end(), name) != found.end();
    });
  }

  static std::string shown_names(const std::vector<std::string>& found) {
    constexpr std::size_t kMost = 30;
    const auto end = found.begin() + static_cast<std::ptrdiff_t>(std::min(found.size(), kMost));
    std::string text = fmt::format("{}", fmt::join(found.begin(), end, ", "));
    if (found.size() > kMost) text += fmt::format(" and {} more", found.size() - kMost);
    return text;
  }

  void take_row(const std::vector<CsvCell>& cells, int line) {
    if (rows_seen_++ == 0 && is_line_of_units(cells)) return;
    check_count(cells, line);
    for (auto& values : table_.values) values.push_back(kNaN);
    table_.lines.push_back(line);
    for (std::size_t column = 0; column < place_.size(); ++column)
      if (place_[column] >= 0) take_cell(cells[column], static_cast<std::size_t>(place_[column]), line);
  }

  void check_count(const std::vector<CsvCell>& cells, int line) const {
    // Programs like to end a row with a separator: an empty cell more says nothing.
    const auto empty = [](const CsvCell& cell) { return cell.text.empty(); };
    const bool enough = cells.size() >= place_.size();
    if (enough && std::all_of(cells.begin() + static_cast<std::ptrdiff_t>(place_.size()), cells.end(), empty)) return;
    throw CaseError(fmt::format("{}:{}: has {} cells, the names say {}{}", table_.file, line, cells.size(),
                                place_.size(),
                                separator_ == ',' && cells.size() > place_.size()
                                    ? "; numbers with decimal commas need semicolons or tabs between them, or quotes"
                                    : ""));
  }

  /// Loggers like to put a line of units under the names.
  bool is_line_of_units(const std::vector<CsvCell>& cells) const {
    bool names_one = false;
    for (std::size_t column = 0; column < std::min(place_.size(), cells.size()); ++column) {
      if (place_[column] < 0) continue;
      const std::string_view cell = cells[column].text;
      if (!may_be_unit(cell)) return false;
      names_one = names_one || !(says_missing(cell) || cell == "1");
    }
    return names_one;
  }

  void take_cell(const CsvCell& cell, std::size_t k, int line) {
    double& value = table_.values[k].back();
    if (const auto number = number_with_point(cell.text)) {
      value = *number;
      if (point_.line == 0 && cell.text.find('.') != std::string_view::npos) point_ = {std::string(cell.text), line};
      return;
    }
    const bool comma_may_be_decimal = separator_ != ',' || cell.quoted;
    if (const auto number = comma_may_be_decimal ? number_with_comma(cell.text) : std::nullopt) {
      value = *number;
      if (comma_.line == 0) comma_ = {std::string(cell.text), line};
      if (!may_be_thousands(cell.text)) certain_comma_ = true;
      return;
    }
    if (!says_missing(cell.text))
      throw CaseError(fmt::format("{}:{}: column \"{}\": is no number: \"{}\"", table_.file, line, table_.names[k],
                                  cell.text.substr(0, kShown)));
  }

  /// A comma that may be decimal or part the thousands is not guessed.
  void refuse_ambiguous_commas() const {
    if (comma_.line > 0 && point_.line > 0)
      throw CaseError(fmt::format(
          "{}:{}: has a number with a comma, \"{}\", and in line {} one with a point, \"{}\": "
          "write all of them with a decimal point and without a sign between thousands",
          table_.file, comma_.line, comma_.text.substr(0, kShown), point_.line, point_.text.substr(0, kShown)));
    if (comma_.line > 0 && separator_ == ',' && !certain_comma_)
      throw CaseError(
          fmt::format("{}:{}: \"{}\" may have a decimal comma or a comma between thousands: write decimal "
                      "points and no sign between thousands",
                      table_.file, comma_.line, comma_.text.substr(0, kShown)));
  }

  MeasuredTable table_;
  std::vector<int> place_;  // by column of the file: which of the names, -1 none
  char separator_ = ' ';
  std::size_t rows_seen_ = 0;
  SeenCell comma_, point_;  // the first number with each
  bool certain_comma_ = false;
};

}  // namespace

MeasuredTable read_measured_csv(const std::string& path, const std::vector<std::string>& names) {
  return CsvReader(path, names).read();
}

}  // namespace stillhook
