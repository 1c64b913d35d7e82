#include "planner/weather/columns.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "problems/case.h"
#include "problems/field_table.h"

namespace stillhook {
namespace {

constexpr double kColumnDegree = std::numbers::pi / 180.0;

struct UnitOf {
  const char* name;
  double factor;
};

const std::vector<UnitOf>& units_of(Measure measure) {
  static const std::vector<UnitOf> heights = {{"m", 1.0}, {"cm", 0.01}, {"ft", 0.3048}};
  static const std::vector<UnitOf> times = {{"s", 1.0}, {"h", 3600.0}, {"min", 60.0}};
  static const std::vector<UnitOf> angles = {{"deg", kColumnDegree},
                                             {"degree", kColumnDegree},
                                             {"degrees", kColumnDegree},
                                             {"degree_true", kColumnDegree},
                                             {"degrees_true", kColumnDegree},
                                             {"\u00b0", kColumnDegree},
                                             {"rad", 1.0},
                                             {"radian", 1.0},
                                             {"radians", 1.0}};
  static const std::vector<UnitOf> speeds = {
      {"m/s", 1.0},       {"m s-1", 1.0}, {"m s**-1", 1.0}, {"kn", 1852.0 / 3600.0}, {"knots", 1852.0 / 3600.0},
      {"km/h", 1.0 / 3.6}};
  static const std::vector<UnitOf> counts = {{"1", 1.0}, {"%", 0.01}};
  switch (measure) {
    case Measure::height:
      return heights;
    case Measure::time:
      return times;
    case Measure::angle:
      return angles;
    case Measure::speed:
      return speeds;
    case Measure::count:
      break;
  }
  return counts;
}

}  // namespace

std::string lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

ColumnName column_name(const std::string& header) {
  const auto trimmed = [](std::string text) {
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
  };
  for (const auto& [open, close] : {std::pair('[', ']'), std::pair('(', ')')}) {
    const std::size_t at = header.rfind(open);
    if (at != std::string::npos && at > 0 && header.back() == close)
      return {trimmed(header.substr(0, at)), trimmed(header.substr(at + 1, header.size() - at - 2))};
  }
  return {trimmed(header), ""};
}

const char* usual_unit(Measure measure) { return units_of(measure).front().name; }

double factor_of_unit(const std::string& place, const std::string& column, const std::string& unit, Measure measure) {
  std::vector<std::string> known;
  for (const UnitOf& u : units_of(measure)) {
    if (unit.empty() || unit == u.name) return u.factor;
    known.push_back(u.name);
  }
  throw CaseError(fmt::format("{}: column \"{}\": the unit must be one of {}, got \"{}\"{}", place, column,
                              fmt::join(known, ", "), unit, did_you_mean(unit, known)));
}

std::optional<FoundColumn> find_column(const CsvFile& file, const std::vector<std::string>& names, Measure measure) {
  const std::string place = fmt::format("{}:{}", file.path(), file.line_of_names());
  std::optional<FoundColumn> found;
  for (std::size_t i = 0; i < file.names().size(); ++i) {
    const std::string& header = file.names()[i];
    const ColumnName column = column_name(header);
    const std::string name = lower_case(column.name);
    if (std::find(names.begin(), names.end(), name) == names.end()) continue;
    if (found)
      throw CaseError(
          fmt::format("{}: has two columns that may be meant, \"{}\" and \"{}\", number {} and {}; name the one "
                      "to be read, or remove the other",
                      place, found->header, header, found->index + 1, i + 1));
    found = FoundColumn{i, header, name, column.unit, factor_of_unit(place, header, column.unit, measure)};
  }
  return found;
}

FoundColumn need_column(const CsvFile& file, const std::vector<std::string>& names, Measure measure,
                        const std::string& example) {
  if (const auto found = find_column(file, names, measure)) return *found;
  throw CaseError(fmt::format("{}:{}: has no column \"{}\"; it has {}", file.path(), file.line_of_names(), example,
                              fmt::join(file.names(), ", ")));
}

}  // namespace stillhook
