// The slings of every rigging as `check` prints them.
#pragma once

#include <vector>

#include "problems/case.h"
#include "results/report.h"

namespace stillhook {

/// One table a rigging: lengths, tensions, angles and skew with the load hanging at rest.
std::vector<ReportTable> rigging_tables(const Case& c);

}  // namespace stillhook
