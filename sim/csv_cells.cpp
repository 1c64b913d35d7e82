#include "sim/csv_cells.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace stillhook {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

CsvRows::CsvRows(std::string_view text) : text_(text) {
  if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);  // byte-order mark of UTF-8
  bare_returns_ = text_.find('\n') == std::string_view::npos;
}

bool CsvRows::at_row() {
  while (at_ < text_.size()) {
    std::size_t end = at_;
    while (end < text_.size() && !ends_line(end)) ++end;
    if (!without_blanks(text_.substr(at_, end - at_)).empty() && text_[at_] != '#') return true;
    at_ = end;
    skip_line_end();
  }
  return false;
}

void CsvRows::skip_line_end() {
  if (at_ < text_.size()) ++at_;
  ++lines_passed_;
}

char CsvRows::find_separator() {
  if (!at_row()) return ' ';
  std::size_t end = at_;
  std::string found;
  bool inside = false;
  for (; end < text_.size() && (inside || !ends_line(end)); ++end) {
    if (text_[end] == '"') inside = !inside;
    if (!inside) found += text_[end];
  }
  const std::string_view row = without_blanks(text_.substr(at_, end - at_));
  if (row.size() == 5 && row.starts_with("sep=")) {
    const char named = row.back();
    at_ = end;
    skip_line_end();
    return named;
  }
  for (const char candidate : {';', '\t', ','})
    if (found.find(candidate) != std::string::npos) return candidate;
  return ' ';
}

bool CsvRows::is_separator(std::size_t at, char separator) const {
  return text_[at] == separator || (separator == ' ' && text_[at] == '\t');
}

bool CsvRows::next(char separator, std::vector<CsvCell>& cells) {
  cells.clear();
  unescaped_.clear();
  if (!at_row()) return false;
  line_ = lines_passed_ + 1;
  while (true) {
    // Blanks before a cell; between blanks there is no empty one.
    while (at_ < text_.size() && is_blank(text_[at_]) && !ends_line(at_) &&
           (separator == ' ' || !is_separator(at_, separator)))
      ++at_;
    const bool at_end = at_ >= text_.size() || ends_line(at_);
    if (at_end && separator == ' ') break;
    cells.push_back(!at_end && text_[at_] == '"' ? quoted_cell(separator) : plain_cell(separator));
    if (at_ >= text_.size() || ends_line(at_)) break;
    ++at_;  // the separator
  }
  skip_line_end();
  return true;
}

CsvCell CsvRows::plain_cell(char separator) {
  const std::size_t begin = at_;
  while (at_ < text_.size() && !ends_line(at_) && !is_separator(at_, separator)) ++at_;
  return {without_blanks(text_.substr(begin, at_ - begin)), false};
}

CsvCell CsvRows::quoted_cell(char separator) {
  const std::size_t begin = ++at_;
  bool doubled = false;
  while (at_ < text_.size()) {
    if (text_[at_] == '\n') ++lines_passed_;
    if (text_[at_] == '"') {
      if (at_ + 1 >= text_.size() || text_[at_ + 1] != '"') break;
      doubled = true;
      ++at_;
    }
    ++at_;
  }
  if (at_ >= text_.size()) throw std::runtime_error("a double quote opens a cell in this row and is not closed");
  CsvCell cell{text_.substr(begin, at_ - begin), true};
  ++at_;
  const CsvCell tail = plain_cell(separator);
  if (!tail.text.empty())
    throw std::runtime_error("text follows the closing quote of a cell: " + std::string(tail.text.substr(0, 40)));
  if (doubled) {
    std::string plain;
    for (std::size_t i = 0; i < cell.text.size(); ++i) {
      plain += cell.text[i];
      if (cell.text[i] == '"') ++i;
    }
    if (unescaped_.empty()) unescaped_.reserve(256);  // views into it must stay
    if (unescaped_.size() == unescaped_.capacity())
      throw std::runtime_error("more than 256 cells of this row have quotes in them");
    unescaped_.push_back(std::move(plain));
    cell.text = unescaped_.back();
  }
  cell.text = without_blanks(cell.text);
  return cell;
}

std::optional<double> number_with_point(std::string_view cell) {
  if (cell.size() > 1 && cell.front() == '+' && cell[1] != '-') cell.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<double> number_with_comma(std::string_view cell) {
  const std::size_t comma = cell.find(',');
  if (comma == std::string_view::npos || cell.find('.') != std::string_view::npos) return std::nullopt;
  if (comma == 0 || !is_digit(cell[comma - 1]) || comma + 1 == cell.size() || !is_digit(cell[comma + 1]))
    return std::nullopt;
  std::string with_point(cell);
  with_point[comma] = '.';
  return number_with_point(with_point);
}

bool may_be_thousands(std::string_view cell) {
  if (!cell.empty() && (cell.front() == '-' || cell.front() == '+')) cell.remove_prefix(1);
  const std::size_t comma = cell.find(',');
  return comma >= 1 && comma <= 3 && cell.front() != '0' && cell.size() == comma + 4 &&
         std::all_of(cell.begin() + static_cast<std::ptrdiff_t>(comma) + 1, cell.end(), is_digit);
}

bool says_missing(std::string_view cell) {
  static constexpr std::array<std::string_view, 16> kWords = {
      "",    "nan",  "na",       "n/a",     "null",  "none",    "-",      "--",
      "inf", "#n/a", "infinity", "missing", "#num!", "1.#qnan", "1.#ind", "1.#inf"};
  std::string lower = lower_case(cell);
  if (lower.size() > 1 && (lower.front() == '+' || (lower.front() == '-' && lower != "--"))) lower.erase(0, 1);
  return std::find(kWords.begin(), kWords.end(), lower) != kWords.end();
}

bool may_be_unit(std::string_view cell) {
  if (cell.empty() || cell == "1" || cell == "-") return true;
  const auto first = static_cast<unsigned char>(cell.front());
  const bool opens =
      std::isalpha(first) || first >= 128 || first == '[' || first == '(' || first == '%' || cell.starts_with("1/");
  return opens && !number_with_point(cell);
}

}  // namespace stillhook
