#include "tuning/meeting_keys.h"

#include <fmt/core.h>

#include <algorithm>

#include "problems/case_key.h"

namespace stillhook {

bool may_meet(const std::string& a, const std::string& b) {
  const std::vector<std::string> x = steps_of(a), y = steps_of(b);
  return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                    [](const std::string& s, const std::string& t) { return s == t || s == "*" || t == "*"; });
}

void check_fit_within_plan(const Case& c) {
  for (const FitParameterSpec& fitted : c.fit.parameters)
    for (const VariableSpec& planned : c.plan.variables) {
      if (!may_meet(fitted.key, planned.key)) continue;
      if (planned.lower <= fitted.lower && fitted.upper <= planned.upper) continue;
      throw CaseError(fmt::format(
          "{}: [fit.parameters.\"{}\"] goes from {:.6g} to {:.6g}, [plan.variables.\"{}\"] from {:.6g} to {:.6g} only: "
          "a fitted value outside the bounds of the plan would leave a case that cannot be read. Widen those of the "
          "plan, narrow those of the fit, or leave the variable out of [plan.variables]",
          c.file, fitted.key, fitted.lower, fitted.upper, planned.key, planned.lower, planned.upper));
    }
}

}  // namespace stillhook
