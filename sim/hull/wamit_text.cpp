#include "sim/hull/wamit_text.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "sim/specification.h"

namespace stillhook {

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
  while (std::getline(in, text)) {
    ++line;
    if (text.find('\0') != std::string::npos) fail(line, "is not text");
    if (in.eof()) fail(line, "ends in the middle of a line: is the file cut off?");
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
  }
  if (rows_.empty()) fail(std::max(line, 1), "holds no numbers");
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
