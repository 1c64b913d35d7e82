// Keys that a fit, a tuning and a plan vary together.
#pragma once

#include <string>

#include "problems/case.h"

namespace stillhook {

/// Whether two keys can lead to the same value, `*` being every entry.
bool may_meet(const std::string& a, const std::string& b);

/// A case with a value outside the bounds of its [plan.variables] cannot be read, so a fit may not go there. Throws
/// CaseError for a parameter with wider bounds than a variable of the plan for the same key.
void check_fit_within_plan(const Case& c);

}  // namespace stillhook
