// Columns of weather files: found by the names that providers give them, with their units in brackets.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "problems/csv_file.h"

namespace stillhook {

/// "hs [m]" or "hs (m)": name and unit; the unit is empty where the name has none.
struct ColumnName {
  std::string name, unit;
};
ColumnName column_name(const std::string& header);

/// What a column measures: which units it may have.
enum class Measure { height, time, angle, speed, count };

/// SI per unit of a column; the measure's usual unit (m, s, deg, m/s, 1) for an empty one. Throws CaseError, which
/// begins with `place`, for a unit that it cannot have.
double factor_of_unit(const std::string& place, const std::string& column, const std::string& unit, Measure measure);

/// The unit that a column without one is taken in.
const char* usual_unit(Measure measure);

/// A column of a file that was found.
struct FoundColumn {
  std::size_t index = 0;
  std::string header, name, unit;  // as written; without its unit; of it
  double factor = 1.0;             // SI per unit
};

/// The column that is called one of `names` (lower case; capitals in the file do not matter), whatever its unit. Throws
/// CaseError if two are.
std::optional<FoundColumn> find_column(const CsvFile& file, const std::vector<std::string>& names, Measure measure);

/// The same, but the column must be there. `example` is how the message writes it: "hs_limit [m]".
FoundColumn need_column(const CsvFile& file, const std::vector<std::string>& names, Measure measure,
                        const std::string& example);

/// A text in lower case.
std::string lower_case(std::string text);

}  // namespace stillhook
