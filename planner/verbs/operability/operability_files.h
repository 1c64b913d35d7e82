// Files that a study of limiting sea states leaves beside its report.
#pragma once

#include <string>

#include "planner/verbs/operability/study.h"

namespace stillhook {

/// operability.csv: a line a period, heading and phase ("all" for the whole lift); what `weather` reads as LIMITS.
std::string operability_csv(const OperabilityStudy& study);

/// operability.nc (CF-1.8): limits over tp, heading, phase, limit, and the crossing of every seed. Throws FileError.
void write_operability_netcdf(const OperabilityStudy& study, const std::string& path);

/// summary.json of the verb. `wall`: s, of this process.
std::string operability_summary(const OperabilityStudy& study, const std::vector<std::string>& files,
                                const std::string& status, const std::string& date, double wall);

}  // namespace stillhook
