#include "tuning/measured_netcdf.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string_view>

#include "problems/case.h"
#include "problems/field_table.h"
#include "results/netcdf_file.h"
#include "sim/guarded_read.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

/// Names that a variable can be asked for by: its own and its attribute `channel`.
std::vector<std::pair<std::string, std::string>> named_variables(const NetcdfFile& file) {
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

std::size_t length_of_variable(const NetcdfFile& file, int id, const std::string& name, const std::string& path) {
  int rank = 0;
  file.check(nc_inq_varndims(file.id(), id, &rank), name);
  std::vector<int> dimensions(static_cast<std::size_t>(rank));
  file.check(nc_inq_vardimid(file.id(), id, dimensions.data()), name);
  // Dimensions of length 1, as of the one place of a hindcast, say nothing.
  std::size_t longest = 1;
  int long_ones = 0;
  for (const int dimension : dimensions) {
    std::size_t length = 0;
    file.check(nc_inq_dimlen(file.id(), dimension, &length), name);
    if (length == 1) continue;
    ++long_ones;
    longest = length;
  }
  if (long_ones > 1 || rank == 0)
    throw CaseError(fmt::format("{}: variable \"{}\" must have one dimension{}, has {}", path, name,
                                rank > 1 ? " longer than 1" : "", rank > 1 ? long_ones : rank));
  return longest;
}

/// Numbers of an attribute; empty if there is none, or a text.
std::vector<double> numbers_of(const NetcdfFile& file, int id, const char* attribute) {
  nc_type type = NC_NAT;
  std::size_t length = 0;
  if (nc_inq_att(file.id(), id, attribute, &type, &length) != NC_NOERR || type == NC_CHAR || type == NC_STRING)
    return {};
  std::vector<double> values(length);
  file.check(nc_get_att_double(file.id(), id, attribute, values.data()), std::string("attribute ") + attribute);
  return values;
}

std::string text_of(const NetcdfFile& file, int id, const char* attribute) {
  nc_type type = NC_NAT;
  std::size_t length = 0;
  if (nc_inq_att(file.id(), id, attribute, &type, &length) != NC_NOERR || type != NC_CHAR) return {};
  std::string text = file.text(id, attribute);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\0')) text.pop_back();
  return text;
}

/// What NetCDF writes where nothing was written, if the variable does not say otherwise.
std::vector<double> usual_fill(nc_type type) {
  switch (type) {
    case NC_SHORT:
      return {NC_FILL_SHORT};
    case NC_INT:
      return {NC_FILL_INT};
    case NC_INT64:
      return {static_cast<double>(NC_FILL_INT64)};
    case NC_FLOAT:
      return {NC_FILL_FLOAT};
    case NC_DOUBLE:
      return {NC_FILL_DOUBLE};
    default:
      return {};
  }
}

/// Which raw numbers of a variable are gaps, and what the others mean.
class Unpacking {
 public:
  Unpacking(const NetcdfFile& file, int id) {
    nc_type type = NC_NAT;
    file.check(nc_inq_vartype(file.id(), id, &type), "type of a variable");
    missing_ = numbers_of(file, id, "_FillValue");
    if (missing_.empty()) missing_ = usual_fill(type);
    for (const double value : numbers_of(file, id, "missing_value")) missing_.push_back(value);
    if (const auto range = numbers_of(file, id, "valid_range"); range.size() == 2) low_ = range[0], high_ = range[1];
    if (const auto low = numbers_of(file, id, "valid_min"); low.size() == 1) low_ = low[0];
    if (const auto high = numbers_of(file, id, "valid_max"); high.size() == 1) high_ = high[0];
    if (const auto factor = numbers_of(file, id, "scale_factor"); factor.size() == 1) factor_ = factor[0];
    if (const auto offset = numbers_of(file, id, "add_offset"); offset.size() == 1) offset_ = offset[0];
  }

  double operator()(double raw) const {
    // Beyond all measurements lies what programs fill with when they do not say so.
    const bool given = std::isfinite(raw) && std::abs(raw) < 0.99 * NC_FILL_FLOAT && raw >= low_ && raw <= high_ &&
                       std::find(missing_.begin(), missing_.end(), raw) == missing_.end();
    return given ? raw * factor_ + offset_ : kNaN;
  }

 private:
  std::vector<double> missing_;
  double low_ = -kInfinite, high_ = kInfinite, factor_ = 1.0, offset_ = 0.0;
  static constexpr double kInfinite = std::numeric_limits<double>::infinity();
};

MeasuredTable read_variables(const std::string& path, const std::vector<std::string>& names) {
  const NetcdfFile file(path, NetcdfFile::Mode::read, path);
  const auto found = named_variables(file);
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
    const int id = file.find(at->second);
    const std::size_t length = length_of_variable(file, id, at->second, path);
    if (!table.values.empty() && length != rows)
      throw CaseError(fmt::format("{}: \"{}\" has {} values, \"{}\" {}", path, name, length, names.front(), rows));
    rows = length;
    table.values.push_back(rows > 0 ? file.doubles(at->second, rows) : std::vector<double>());
    table.units.push_back(text_of(file, id, "units"));
    const Unpacking unpacked(file, id);
    for (double& value : table.values.back()) value = unpacked(value);
  }
  for (std::size_t i = 0; i < rows; ++i) table.lines.push_back(static_cast<int>(i + 1));
  return table;
}

// A table as bytes, from the child that reads the file to this process, which never opens it: the number of rows, then
// of each column its numbers, the length of its unit and the unit.

template <class T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
T take(std::string_view& bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}

std::string as_bytes(const MeasuredTable& table) {
  std::string bytes;
  put(bytes, table.rows());
  for (std::size_t column = 0; column < table.names.size(); ++column) {
    for (const double value : table.values[column]) put(bytes, value);
    put(bytes, table.units[column].size());
    bytes += table.units[column];
  }
  return bytes;
}

MeasuredTable from_bytes(std::string_view bytes, const std::string& path, const std::vector<std::string>& names) {
  MeasuredTable table;
  table.file = path;
  table.names = names;
  table.lines.resize(take<std::size_t>(bytes));
  std::iota(table.lines.begin(), table.lines.end(), 1);
  for (std::size_t column = 0; column < names.size(); ++column) {
    std::vector<double>& values = table.values.emplace_back(table.rows());
    for (double& value : values) value = take<double>(bytes);
    const auto length = take<std::size_t>(bytes);
    table.units.emplace_back(bytes.substr(0, length));
    bytes.remove_prefix(length);
  }
  return table;
}

void put_text(std::string& bytes, const std::string& text) {
  put(bytes, text.size());
  bytes += text;
}

std::string take_text(std::string_view& bytes) {
  const auto length = take<std::size_t>(bytes);
  const std::string text(bytes.substr(0, length));
  bytes.remove_prefix(length);
  return text;
}

std::string variables_as_bytes(const std::string& path) {
  const NetcdfFile file(path, NetcdfFile::Mode::read, path);
  std::string bytes;
  for (const auto& [asked, name] : named_variables(file)) {
    const int id = file.find(name);
    put_text(bytes, asked);
    put_text(bytes, text_of(file, id, "units"));
    put_text(bytes, text_of(file, id, "standard_name"));
  }
  return bytes;
}

}  // namespace

std::vector<MeasuredVariable> variables_of_netcdf(const std::string& path) {
  try {
    const std::string bytes = read_in_child(path, [&] { return variables_as_bytes(path); });
    std::vector<MeasuredVariable> variables;
    for (std::string_view rest = bytes; !rest.empty();) {
      MeasuredVariable& v = variables.emplace_back();
      v.name = take_text(rest);
      v.units = take_text(rest);
      v.standard_name = take_text(rest);
    }
    return variables;
  } catch (const FileError& error) {
    throw CaseError(error.what());
  }
}

MeasuredTable read_measured_netcdf(const std::string& path, const std::vector<std::string>& names) {
  try {
    return from_bytes(read_in_child(path, [&] { return as_bytes(read_variables(path, names)); }), path, names);
  } catch (const FileError& error) {
    throw CaseError(error.what());
  }
}

}  // namespace stillhook
