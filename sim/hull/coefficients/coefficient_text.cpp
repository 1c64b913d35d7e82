#include "sim/hull/coefficients/coefficient_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <sstream>

#include "sim/specification.h"

namespace stillhook {
namespace {

constexpr const char* kMagic = "stillhook_coefficients";
const std::set<std::string> kOptionalKeys = {"waterplane_m2", "gap_rise", "gap_frequency_rad_s", "depth_m"};
constexpr const char* kColumns = "quantity,i,j_or_heading_deg,omega_rad_s_or_t_s,value,phase_deg";

/// Fields between commas, without blanks around them.
std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> fields;
  std::size_t from = 0;
  while (true) {
    const std::size_t comma = text.find(',', from);
    std::string field = text.substr(from, comma == std::string::npos ? comma : comma - from);
    const std::size_t first = field.find_first_not_of(" \t"), last = field.find_last_not_of(" \t");
    fields.push_back(first == std::string::npos ? "" : field.substr(first, last - first + 1));
    if (comma == std::string::npos) return fields;
    from = comma + 1;
  }
}

}  // namespace

CoefficientText::CoefficientText(const std::string& path) : path_(path), in_(path, std::ios::binary) {
  if (!in_) throw SpecificationError(path_, "", "cannot be opened");
  read_header();
  check_conventions();
  read_rows();
}

void CoefficientText::fail(int line, const std::string& sentence) const {
  throw SpecificationError(path_ + ":" + std::to_string(line), "", sentence);
}

bool CoefficientText::next_line(std::string& text) {
  while (std::getline(in_, text)) {
    ++line_;
    if (!text.empty() && text.back() == '\r') text.pop_back();
    if (text.find('\0') != std::string::npos) fail(line_, "is not text");
    const std::size_t first = text.find_first_not_of(" \t");
    if (first != std::string::npos && text[first] != '#') return true;
  }
  return false;
}

double CoefficientText::number(const std::string& field, const char* what, int line) const {
  double value = 0.0;
  const char* end = field.data() + field.size();
  const char* begin = field.data() + (!field.empty() && field[0] == '+' ? 1 : 0);
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (field.empty() || error != std::errc() || stop != end)
    fail(line, std::string(what) + " must be a number, got \"" + field + "\"");
  if (!std::isfinite(value)) fail(line, std::string(what) + " must be finite, got \"" + field + "\"");
  return value;
}

int CoefficientText::mode(const std::string& field, const char* what) const {
  const double value = number(field, what, line_);
  if (value != std::floor(value) || value < 1.0 || value > modes_)
    fail(line_, std::string(what) + " must be a mode from 1 to " + std::to_string(modes_) + ", got \"" + field + "\"");
  return static_cast<int>(value) - 1;
}

void CoefficientText::read_header() {
  static const std::set<std::string> known = {"description", "hulls",       "reference_point", "axes",
                                              "waterline_m", "volume_m3",   "density_kg_m3",   "gravity_m_s2",
                                              "length_m",    "time_factor", "wave_heading",    "symmetry"};
  std::string text;
  if (!next_line(text)) fail(std::max(line_, 1), "the file is empty");
  if (split(text) != std::vector<std::string>{kMagic, "1"})
    fail(line_, "must begin with \"" + std::string(kMagic) + ",1\": this is not a coefficient file of version 1");
  while (true) {
    if (!next_line(text)) fail(line_, "ends before the line of columns \"" + std::string(kColumns) + "\"");
    std::vector<std::string> fields = split(text);
    if (fields[0] == "quantity") break;
    if (!known.contains(fields[0]) && !kOptionalKeys.contains(fields[0])) fail(line_, "unknown key \"" + fields[0] + "\"");
    if (header_.contains(fields[0])) fail(line_, "key \"" + fields[0] + "\" is given twice");
    const std::string key = fields[0];
    fields.erase(fields.begin());
    if (fields.empty()) fail(line_, "key \"" + key + "\" has no value");
    header_[key] = {line_, std::move(fields)};
  }
  for (const std::string& key : known)
    if (!header_.contains(key)) fail(line_, "the header above does not give \"" + key + "\"");
  if (text != kColumns) fail(line_, "the columns must be \"" + std::string(kColumns) + "\"");
}

std::string CoefficientText::header_text(const std::string& key) const {
  std::string text;
  for (const std::string& part : header_.at(key).second) text += (text.empty() ? "" : ", ") + part;
  return text;
}

double CoefficientText::header_number(const std::string& key, double low, bool open) const {
  const std::string text = header_text(key);
  const int line = header_.at(key).first;
  const double value = number(text, key.c_str(), line);
  if (value < low || (open && value == low)) {
    std::ostringstream sentence;
    sentence << key << " must be " << (open ? "> " : ">= ") << low << ", got " << value;
    fail(line, sentence.str());
  }
  return value;
}

void CoefficientText::require_header(const std::string& key, const std::vector<std::string>& allowed) const {
  const std::string text = header_text(key);
  if (std::find(allowed.begin(), allowed.end(), text) != allowed.end()) return;
  std::string list;
  for (const std::string& a : allowed) list += (list.empty() ? "\"" : "\" or \"") + a;
  fail(header_.at(key).first, key + " must be " + list + "\", got \"" + text + "\"");
}

CoefficientRow CoefficientText::parse_row(const std::vector<std::string>& field) const {
  static const std::set<std::string> quantities = {"Ainf", "K", "A", "B", "Bgap", "X"};
  if (!quantities.contains(field[0])) fail(line_, "unknown quantity \"" + field[0] + "\", expected Ainf, K, A, B, Bgap or X");
  if (field.size() != 6)
    fail(line_, "a row has 6 fields, got " + std::to_string(field.size()) + ": is the file cut off?");
  CoefficientRow row;
  row.line = line_;
  row.quantity = field[0];
  row.i = mode(field[1], "i");
  row.value = number(field[4], "value", line_);
  if (row.quantity == "X") {
    row.column = number(field[2], "heading", line_);
    const double high = mirrored_ ? 180.0 : 360.0;
    if (row.column < 0.0 || row.column > high || (!mirrored_ && row.column == high))
      fail(line_, "heading must lie in " + std::string(mirrored_ ? "0..180" : "0..360 (without 360)") +
                      " deg with this symmetry, got " + field[2]);
    row.phase = number(field[5], "phase_deg", line_);
    if (row.value < 0.0) fail(line_, "the amplitude of X must be >= 0, got " + field[4]);
  } else {
    row.column = mode(field[2], "j");
    if (!field[5].empty()) fail(line_, "only X has a phase");
  }
  if (row.quantity == "Ainf") {
    if (!field[3].empty()) fail(line_, "Ainf has neither frequency nor time");
    return row;
  }
  row.argument = number(field[3], row.quantity == "K" ? "t" : "omega", line_);
  if (row.argument < 0.0 || (row.quantity == "X" && row.argument == 0.0))
    fail(line_, (row.quantity == "K" ? std::string("t") : std::string("omega")) + " must be " +
                    (row.quantity == "X" ? "> 0" : ">= 0") + ", got " + field[3]);
  return row;
}

void CoefficientText::read_rows() {
  std::string text;
  while (next_line(text)) {
    const std::vector<std::string> field = split(text);
    if (field[0] != "end") {
      rows_.push_back(parse_row(field));
      continue;
    }
    if (field.size() != 2 || number(field[1], "the number of rows", line_) != static_cast<double>(rows_.size()))
      fail(line_, "says \"" + text + "\", but " + std::to_string(rows_.size()) + " rows came before");
    if (next_line(text)) fail(line_, "there is more after the line \"end\"");
    return;
  }
  fail(line_, "the file is cut off: the line \"end\" is missing");
}

void CoefficientText::check_conventions() {
  require_header("hulls", {"1", "2", "3", "4"});
  modes_ = 6 * static_cast<int>(header_number("hulls", 1, false));
  require_header("reference_point", {"body_origin"});
  require_header("axes", {"x_forward_y_port_z_up"});
  require_header("time_factor", {"exp(-i omega t)"});
  require_header("wave_heading", {"towards"});
  require_header("symmetry", {"port_starboard", "none"});
  mirrored_ = header_text("symmetry") == "port_starboard";
  if (mirrored_ && modes_ > 6) fail(header_.at("symmetry").first, "several hulls together have no symmetry");
}

std::vector<double> CoefficientText::per_hull(const std::string& key) const {
  const auto found = header_.find(key);
  if (found == header_.end()) return {};
  const auto& [line, fields] = found->second;
  if (6 * static_cast<int>(fields.size()) != modes_) fail(line, key + " must have one number a hull");
  std::vector<double> result;
  for (const std::string& field : fields) {
    result.push_back(number(field, key.c_str(), line));
    if (!(result.back() > 0.0)) fail(line, key + " must be > 0, got \"" + field + "\"");
  }
  return result;
}

}  // namespace stillhook
