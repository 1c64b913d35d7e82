// The named variables of a NetCDF file, by its conventions (CF 1.8, sections 2.5.1 and 8.1): gaps by _FillValue,
// missing_value and the valid range, packed numbers by scale_factor and add_offset.
#pragma once

#include "tuning/measured_table.h"

namespace stillhook {

/// Throws CaseError that names file and variable.
MeasuredTable read_measured_netcdf(const std::string& path, const std::vector<std::string>& names);

/// What a file has under which name. Throws CaseError.
struct MeasuredVariable {
  std::string name, units, standard_name;  // the latter two empty where the file does not say
};
std::vector<MeasuredVariable> variables_of_netcdf(const std::string& path);

}  // namespace stillhook
