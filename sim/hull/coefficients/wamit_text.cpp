#include "sim/hull/coefficients/wamit_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "sim/specification.h"

namespace stillhook {

namespace {

/// What the last numbers of rows look like: programs print a column with as many digits in every row, so that a number
/// that is cut off is shorter.
class LastWords {
 public:
  void note(std::size_t columns, const std::string& word) {
    const std::size_t now = digits(word);
    const auto [known, first] = lengths_.insert({columns, {now, now}});
    known->second = {std::min(known->second.first, now), std::max(known->second.second, now)};
    columns_ = columns;
  }
  bool looks_whole(std::size_t columns, const std::string& word) const {
    const auto known = lengths_.find(columns);
    if (columns != columns_ || known == lengths_.end()) return false;
    const auto& [shortest, longest] = known->second;
    return longest - shortest <= 1 && digits(word) >= shortest;  // an exponent of three digits may take one more
  }

 private:
  static std::size_t digits(const std::string& word) {
    return word.size() - (word[0] == '-' || word[0] == '+' ? 1 : 0);
  }
  std::size_t columns_ = 0;                                              // of the row before
  std::map<std::size_t, std::pair<std::size_t, std::size_t>> lengths_;  // shortest and longest, by columns
};

}  // namespace

bool fortran_number(const std::string& text, double& value) {
  std::string plain;
  bool exponent = false;
  for (std::size_t n = 0; n < text.size(); ++n) {
    const char letter = text[n];
    if (letter == 'd' || letter == 'D' || letter == 'e' || letter == 'E') {
      if (exponent || n == 0) return false;
      exponent = true;
      plain += 'e';
    } else if ((letter == '+' || letter == '-') && n > 0 && plain.back() != 'e') {
      if (exponent) return false;
      exponent = true;
      plain += 'e';
      plain += letter;
    } else if (letter == '+' && n == 0) {
      continue;
    } else {
      plain += letter;
    }
  }
  const char* const begin = plain.data();
  const char* const end = begin + plain.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (stop != end || plain.empty()) return false;
  if (error == std::errc::result_out_of_range) {
    value = plain.find("e-") != std::string::npos ? 0.0 : INFINITY;  // too small to matter, or no number
    return std::isfinite(value);
  }
  return error == std::errc() && std::isfinite(value);
}

WamitText::WamitText(const std::string& path) : path_(path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw SpecificationError(path, "", "cannot be opened");
  std::string text;
  int line = 0;
  LastWords words;
  while (std::getline(in, text)) {
    ++line;
    if (text.find('\0') != std::string::npos) fail(line, "is not text");
    const std::size_t before = rows_.size();
    const bool unended = in.eof();
    std::string word;
    try {
      word = read_line(line, text);
    } catch (const SpecificationError&) {
      if (!unended || line == 1) throw;
    }
    if (rows_.size() > before) {
      const std::size_t columns = rows_.back().column.size();
      if (!unended) words.note(columns, word);
      if (!unended || words.looks_whole(columns, word)) continue;
    } else if (!unended) {
      continue;
    }
    if (text.find_first_not_of(" \t\r\x1a") != std::string::npos)
      fail(line, "ends in the middle of a line: is the file cut off? If the row is whole, end it with a line break");
  }
  if (rows_.empty()) fail(std::max(line, 1), "holds no numbers");
}

std::string WamitText::read_line(int line, const std::string& text) {
  std::istringstream words(text);
  WamitRow row{line, {}};
  std::string word;
  while (words >> word) {
    double value = 0.0;
    if (fortran_number(word, value)) {
      row.column.push_back(value);
    } else if (line == 1 && row.column.empty()) {
      break;  // a heading
    } else {
      fail(line, "expected a number, got \"" + word + "\"");
    }
  }
  if (!row.column.empty()) rows_.push_back(std::move(row));
  return word;
}

void WamitText::fail(int line, const std::string& sentence) const {
  throw SpecificationError(path_ + ":" + std::to_string(line), "", sentence);
}

void WamitText::require_columns(const WamitRow& row, std::size_t least, std::size_t most) const {
  const std::size_t got = row.column.size();
  if (got >= least && got <= most) return;
  std::ostringstream sentence;
  sentence << "a row has " << least;
  if (most > least) sentence << " or " << most;
  sentence << " columns, got " << got << (got < least ? ": is the file cut off?" : "");
  fail(row.line, sentence.str());
}

int WamitText::mode(const WamitRow& row, std::size_t n, int modes) const {
  const double value = row.column[n];
  if (value == std::floor(value) && value >= 1.0 && value <= modes) return static_cast<int>(value) - 1;
  std::ostringstream sentence;
  sentence << "expected a mode from 1 to " << modes << " (" << modes / 6 << (modes == 6 ? " hull" : " hulls")
           << "), got " << value;
  fail(row.line, sentence.str());
}

}  // namespace stillhook
