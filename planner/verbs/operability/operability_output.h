// What a study of limiting sea states leaves and prints, whichever verb made it.
#pragma once

#include <string>
#include <vector>

#include "planner/verbs/operability/study.h"

namespace stillhook {

/// Writes operability.csv, operability.nc and report.html; returns their names. A failure is told as the user's to
/// mend.
std::vector<std::string> write_operability_files(const OperabilityStudy& study, const std::string& date);

void print_operability(const OperabilityStudy& study, const std::vector<std::string>& files);

/// kDone, or kLimitViolated when a limit is not certified at the confidence asked for.
int operability_exit(const OperabilityStudy& study);

}  // namespace stillhook
