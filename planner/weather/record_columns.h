// Which column of a weather file is what.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/weather/columns.h"
#include "problems/weather_spec.h"

namespace stillhook {

/// A column as the file has it.
struct OfferedColumn {
  std::string header, name, unit, standard_name;  // as written; without its unit; of it; of CF, empty if not given
};

struct ChosenColumn {
  std::string header;
  double factor = 1.0;  // to SI
  bool unit_given = false;
  bool turned = false;  // of directions: the file says where the waves travel towards
  std::string remark;   // what it was taken for
};

struct RecordColumns {
  std::string time;  // header
  ChosenColumn height;
  std::optional<ChosenColumn> period, from, wind;
};

/// `place` begins messages. Throws CaseError: a column is missing, two may be meant, a unit or a sense is not known.
RecordColumns choose_columns(const std::string& place, const std::vector<OfferedColumn>& offered,
                             const WeatherSpec& spec);

}  // namespace stillhook
