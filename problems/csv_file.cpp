#include "problems/csv_file.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>

#include "problems/case.h"
#include "problems/field_table.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr std::size_t kShownOfCell = 40;  // characters of a cell in a message

std::string whole_csv_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw CaseError(path + ": cannot be read");
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (in.bad()) throw CaseError(path + ": cannot be read to its end");
  return text;
}

/// Files that are no text, by how they begin.
void refuse_other_formats(const std::string& path, std::string_view text, const std::string& needed) {
  const auto refuse = [&](const std::string& what) { throw CaseError(path + ": " + what); };
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    refuse("is text in UTF-16, as Excel's \"Unicode Text\"; save it as \"CSV UTF-8\"");
  if (text.starts_with("PK\x03\x04")) refuse("is a workbook or an archive, not CSV; save the sheet as \"CSV UTF-8\"");
  if (text.starts_with("\xD0\xCF\x11\xE0")) refuse("is an old Excel workbook; save the sheet as \"CSV UTF-8\"");
  if (text.starts_with("\x1F\x8B")) refuse("is compressed by gzip; unpack it first");
  if (text.starts_with("MATLAB")) refuse("is a file of MATLAB; write the table with writetable() as CSV");
  if (text.substr(0, 65536).find('\0') != std::string_view::npos) refuse("is a binary file; " + needed);
}

std::string shown_names(const std::vector<std::string>& found) {
  constexpr std::size_t kMost = 30;
  const auto end = found.begin() + static_cast<std::ptrdiff_t>(std::min(found.size(), kMost));
  std::string text = fmt::format("{}", fmt::join(found.begin(), end, ", "));
  if (found.size() > kMost) text += fmt::format(" and {} more", found.size() - kMost);
  return text;
}

/// Loggers like to put a line of units under the names.
bool is_line_of_units(const std::vector<CsvCell>& cells, const std::vector<std::size_t>& columns) {
  bool names_one = false;
  for (const std::size_t column : columns) {
    if (column >= cells.size()) continue;
    const std::string_view cell = cells[column].text;
    if (!may_be_unit(cell)) return false;
    names_one = names_one || !(says_missing(cell) || cell == "1");
  }
  return names_one;
}

}  // namespace

CsvFile::CsvFile(std::string path, const std::string& needed) : path_(std::move(path)), text_(whole_csv_text(path_)) {
  refuse_other_formats(path_, text_, needed);
  rows_ = std::make_unique<CsvRows>(text_);
  separator_ = rows_->find_separator();
  std::vector<CsvCell> cells;
  if (!next_row(cells)) throw CaseError(path_ + ":1: has no line with the names of its columns");
  take_names(cells);
}

std::string CsvFile::place() const { return fmt::format("{}:{}", path_, line()); }

bool CsvFile::next_row(std::vector<CsvCell>& cells) {
  try {
    return rows_->next(separator_, cells);
  } catch (const std::runtime_error& error) {
    throw CaseError(fmt::format("{}: {}", place(), error.what()));
  }
}

void CsvFile::take_names(const std::vector<CsvCell>& cells) {
  for (const CsvCell& cell : cells) names_.emplace_back(cell.text);
  line_of_names_ = line();
  const auto is_number = [](const std::string& cell) { return number_with_point(cell) || number_with_comma(cell); };
  if (std::all_of(names_.begin(), names_.end(), is_number))
    throw CaseError(place() + ": has no line with the names of its columns, numbers begin at once");
}

std::size_t CsvFile::column(const std::string& name, const std::vector<std::string>& wanted) const {
  const std::string here = fmt::format("{}:{}", path_, line_of_names_);
  const auto at = std::find(names_.begin(), names_.end(), name);
  if (at == names_.end()) {
    const bool knows_none = std::none_of(wanted.begin(), wanted.end(), [&](const std::string& other) {
      return std::find(names_.begin(), names_.end(), other) != names_.end();
    });
    throw CaseError(fmt::format("{}: has no column \"{}\"{}; it has {}{}", here, name, did_you_mean(name, names_),
                                shown_names(names_),
                                knows_none ? "; is this the line of the names? Lines above it must begin with #" : ""));
  }
  if (const auto second = std::find(at + 1, names_.end(), name); second != names_.end())
    throw CaseError(fmt::format("{}: has two columns \"{}\", number {} and {}; rename one of them", here, name,
                                at - names_.begin() + 1, second - names_.begin() + 1));
  return static_cast<std::size_t>(at - names_.begin());
}

bool CsvFile::next(std::vector<CsvCell>& cells, const std::vector<std::size_t>& columns) {
  if (!next_row(cells)) return false;
  const bool first = std::exchange(first_row_, false);
  if (first && is_line_of_units(cells, columns)) return next(cells, columns);
  check_count(cells);
  return true;
}

void CsvFile::check_count(const std::vector<CsvCell>& cells) const {
  // Programs like to end a row with a separator: an empty cell more says nothing.
  const auto empty = [](const CsvCell& cell) { return cell.text.empty(); };
  const bool enough = cells.size() >= names_.size();
  if (enough && std::all_of(cells.begin() + static_cast<std::ptrdiff_t>(names_.size()), cells.end(), empty)) return;
  throw CaseError(fmt::format("{}: has {} cells, the names say {}{}", place(), cells.size(), names_.size(),
                              separator_ == ',' && cells.size() > names_.size()
                                  ? "; numbers with decimal commas need semicolons or tabs between them, or quotes"
                                  : ""));
}

double CsvNumbers::take(const CsvCell& cell, const std::string& column) {
  if (const auto number = number_with_point(cell.text)) {
    if (point_.line == 0 && cell.text.find('.') != std::string_view::npos)
      point_ = {std::string(cell.text), file_.line()};
    return *number;
  }
  const bool comma_may_be_decimal = file_.separator() != ',' || cell.quoted;
  if (const auto number = comma_may_be_decimal ? number_with_comma(cell.text) : std::nullopt) {
    if (comma_.line == 0) comma_ = {std::string(cell.text), file_.line()};
    if (!may_be_thousands(cell.text)) certain_comma_ = true;
    return *number;
  }
  if (!says_missing(cell.text))
    throw CaseError(fmt::format("{}: column \"{}\": is no number: \"{}\"", file_.place(), column,
                                cell.text.substr(0, kShownOfCell)));
  return kNaN;
}

void CsvNumbers::refuse_ambiguous_commas() const {
  if (comma_.line > 0 && point_.line > 0)
    throw CaseError(
        fmt::format("{}:{}: has a number with a comma, \"{}\", and in line {} one with a point, \"{}\": "
                    "write all of them with a decimal point and without a sign between thousands",
                    file_.path(), comma_.line, comma_.text.substr(0, kShownOfCell), point_.line,
                    point_.text.substr(0, kShownOfCell)));
  if (comma_.line > 0 && file_.separator() == ',' && !certain_comma_)
    throw CaseError(
        fmt::format("{}:{}: \"{}\" may have a decimal comma or a comma between thousands: write decimal "
                    "points and no sign between thousands",
                    file_.path(), comma_.line, comma_.text.substr(0, kShownOfCell)));
}

}  // namespace stillhook
