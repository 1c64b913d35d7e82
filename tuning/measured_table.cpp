#include "tuning/measured_table.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>

#include "problems/case.h"
#include "problems/field_table.h"
#include "results/netcdf_file.h"

namespace stillhook {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string_view trimmed(std::string_view text) {
  const auto blank = [](unsigned char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

/// A cell that says that there is nothing.
bool says_missing(std::string_view cell) {
  static constexpr std::array<std::string_view, 9> kWords = {"", "nan", "na", "n/a", "null", "none", "-", "inf", "#n/a"};
  std::string lower(cell);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  if (!lower.empty() && (lower.front() == '+' || (lower.front() == '-' && lower.size() > 1))) lower.erase(0, 1);
  return std::find(kWords.begin(), kWords.end(), lower) != kWords.end();
}

std::optional<double> number_in(std::string_view cell, bool decimal_comma) {
  std::string with_point;
  if (decimal_comma && cell.find(',') != std::string_view::npos) {
    with_point = cell;
    std::replace(with_point.begin(), with_point.end(), ',', '.');
    cell = with_point;
  }
  if (!cell.empty() && cell.front() == '+') cell.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

/// Goes through the cells of a line.
class Cells {
 public:
  Cells(std::string_view line, char separator) : rest_(line), separator_(separator) {}

  std::optional<std::string_view> next() {
    if (done_) return std::nullopt;
    if (separator_ == ' ') {  // any run of blanks
      while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t')) rest_.remove_prefix(1);
      if (rest_.empty()) return done_ = true, std::nullopt;
    }
    const std::size_t end = separator_ == ' ' ? rest_.find_first_of(" \t") : rest_.find(separator_);
    const std::string_view cell = trimmed(rest_.substr(0, end));
    if (end == std::string_view::npos)
      done_ = true;
    else
      rest_.remove_prefix(end + 1);
    return cell;
  }

 private:
  std::string_view rest_;
  char separator_;
  bool done_ = false;
};

class CsvReader {
 public:
  CsvReader(const std::string& path, const std::vector<std::string>& names) {
    table_.file = path;
    table_.names = names;
    table_.values.resize(names.size());
  }

  MeasuredTable read() {
    std::ifstream in(table_.file, std::ios::binary | std::ios::ate);
    if (!in) throw CaseError(table_.file + ": cannot be read");
    std::string text(static_cast<std::size_t>(in.tellg()), '\0');
    in.seekg(0);
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    std::string_view rest(text);
    int number = 0;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      const std::string_view line = trimmed_end(rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
      ++number;
      if (trimmed(line).empty() || line.front() == '#') continue;
      if (place_.empty())
        head(line, number);
      else
        row(line, number);
    }
    if (place_.empty()) throw CaseError(table_.file + ":1: has no line with the names of its columns");
    return std::move(table_);
  }

 private:
  static std::string_view trimmed_end(std::string_view line) {
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  void head(std::string_view line, int number) {
    for (const char candidate : {';', '\t', ','})
      if (separator_ == ' ' && line.find(candidate) != std::string_view::npos) separator_ = candidate;
    std::vector<std::string> found;
    Cells cells(line, separator_);
    while (const auto cell = cells.next()) found.emplace_back(*cell);
    place_.assign(found.size(), -1);
    if (std::all_of(found.begin(), found.end(), [&](const std::string& cell) { return number_in(cell, false); }))
      throw CaseError(fmt::format("{}:{}: has no line with the names of its columns, numbers begin at once", table_.file,
                                  number));
    for (std::size_t k = 0; k < table_.names.size(); ++k) {
      const auto at = std::find(found.begin(), found.end(), table_.names[k]);
      if (at == found.end())
        throw CaseError(fmt::format("{}:{}: has no column \"{}\"{}; it has {}", table_.file, number, table_.names[k],
                                    did_you_mean(table_.names[k], found), fmt::join(found, ", ")));
      place_[static_cast<std::size_t>(at - found.begin())] = static_cast<int>(k);
    }
  }

  void row(std::string_view line, int number) {
    Cells cells(line, separator_);
    std::size_t column = 0;
    for (auto& values : table_.values) values.push_back(kNone);
    table_.lines.push_back(number);
    while (const auto cell = cells.next()) {
      if (column < place_.size() && place_[column] >= 0) {
        const auto k = static_cast<std::size_t>(place_[column]);
        if (const auto value = number_in(*cell, separator_ == ';')) {
          table_.values[k].back() = *value;
        } else if (!says_missing(*cell)) {
          if (table_.lines.size() == 1) return drop_units();
          throw CaseError(fmt::format("{}:{}: column \"{}\": is no number: \"{}\"", table_.file, number, table_.names[k],
                                      cell->substr(0, 40)));
        }
      }
      ++column;
    }
    if (column != place_.size())
      throw CaseError(fmt::format("{}:{}: has {} cells, the names say {}", table_.file, number, column, place_.size()));
  }

  /// Loggers like to put a line of units under the names.
  void drop_units() {
    for (auto& values : table_.values) values.pop_back();
    table_.lines.pop_back();
  }

  MeasuredTable table_;
  std::vector<int> place_;  // by column of the file: which of the names, -1 none
  char separator_ = ' ';
};

/// Variables of a NetCDF file by their names and `channel` attributes.
std::vector<std::pair<std::string, std::string>> variables_of(const NetcdfFile& file) {
  int count = 0;
  file.check(nc_inq_nvars(file.id(), &count), "variables");
  std::vector<std::pair<std::string, std::string>> found;
  for (int id = 0; id < count; ++id) {
    std::array<char, NC_MAX_NAME + 1> name{};
    file.check(nc_inq_varname(file.id(), id, name.data()), "variables");
    found.emplace_back(name.data(), name.data());
    nc_type type = NC_NAT;
    std::size_t length = 0;
    if (nc_inq_att(file.id(), id, "channel", &type, &length) == NC_NOERR && type == NC_CHAR)
      found.emplace_back(file.text(id, "channel"), name.data());
  }
  return found;
}

std::size_t length_of(const NetcdfFile& file, const std::string& variable, const std::string& path) {
  int rank = 0, dimension = 0;
  const int id = file.find(variable);
  file.check(nc_inq_varndims(file.id(), id, &rank), variable);
  if (rank != 1) throw CaseError(fmt::format("{}: variable \"{}\" must have one dimension, has {}", path, variable, rank));
  file.check(nc_inq_vardimid(file.id(), id, &dimension), variable);
  std::size_t length = 0;
  file.check(nc_inq_dimlen(file.id(), dimension, &length), variable);
  return length;
}

MeasuredTable read_netcdf(const std::string& path, const std::vector<std::string>& names) {
  try {
    const NetcdfFile file(path, NetcdfFile::Mode::read, path);
    const auto found = variables_of(file);
    MeasuredTable table;
    table.file = path;
    table.names = names;
    std::size_t rows = 0;
    for (const std::string& name : names) {
      const auto at = std::find_if(found.begin(), found.end(), [&](const auto& v) { return v.first == name; });
      if (at == found.end()) {
        std::vector<std::string> known;
        for (const auto& v : found) known.push_back(v.first);
        throw CaseError(fmt::format("{}: has no variable \"{}\"{}", path, name, did_you_mean(name, known)));
      }
      const std::size_t length = length_of(file, at->second, path);
      if (!table.values.empty() && length != rows)
        throw CaseError(fmt::format("{}: \"{}\" has {} values, \"{}\" {}", path, name, length, names.front(), rows));
      rows = length;
      table.values.push_back(file.doubles(at->second, rows));
      for (double& value : table.values.back())
        if (!std::isfinite(value) || std::abs(value) >= 0.99 * NC_FILL_FLOAT) value = kNone;
    }
    for (std::size_t i = 0; i < rows; ++i) table.lines.push_back(static_cast<int>(i + 1));
    return table;
  } catch (const CaseError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw CaseError(error.what());
  }
}

bool is_netcdf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::array<char, 4> magic{};
  in.read(magic.data(), magic.size());
  const std::string_view start(magic.data(), magic.size());
  return start.substr(0, 3) == "CDF" || start.substr(1) == "HDF";
}

}  // namespace

std::string MeasuredTable::place(std::size_t row) const { return fmt::format("{}:{}", file, lines[row]); }

MeasuredTable read_measured_table(const std::string& path, const std::vector<std::string>& names) {
  return is_netcdf(path) ? read_netcdf(path, names) : CsvReader(path, names).read();
}

}  // namespace stillhook
