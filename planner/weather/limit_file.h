// Limits of an operation as a CSV file: of `stillhook operability`, or from elsewhere.
//
//     tp [s],heading [deg],hs_limit [m],phase,governing          and, where they are known, hs_low [m],hs_high [m]
//
// A row is the limiting significant wave height at a peak period and a heading (direction that the waves travel
// towards, relative to the bow, positive to port: 180 from ahead, 90 from starboard abeam). Without the column of
// headings, or of periods, the limit does not depend on it. Every heading must be there at every period. Rows that
// differ in the phase alone are limits by phase; otherwise the phase only says where the limit was reached. Beside
// phases, rows without one or of phase "all" are limits of the whole operation: they hold too in a record, and for a
// forecast in phases that have none of their own.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/weather/limit_surface.h"

namespace stillhook {

struct LimitFile {
  OperationLimits limits;
  std::optional<OperationLimits> low, high;  // the bounds of the limits at 95 %, where the file has them
  std::vector<std::string> remarks;          // what must be known of the file, one sentence each
};

/// Throws CaseError with file, line, column, rule, value and remedy.
LimitFile read_limit_file(const std::string& path);

}  // namespace stillhook
