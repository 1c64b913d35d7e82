// The named columns of a CSV file.
#pragma once

#include "tuning/measured_table.h"

namespace stillhook {

/// Throws CaseError that names file, line, and what to do about it.
MeasuredTable read_measured_csv(const std::string& path, const std::vector<std::string>& names);

}  // namespace stillhook
