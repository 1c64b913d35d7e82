// Limits on metrics and the verdict on a run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/metrics.h"

namespace stillhook {

struct LimitSpec {
  std::string metric;
  std::optional<double> max, min;  // in the metric's unit
  std::string source;              // where the number comes from, shown in every report
  bool hard = true;                // hard: a violation makes the verdict fail; soft: reported as a warning
  double share = 0.0;              // of the scenarios of a search that may break it: "in at most 5 % of seas"
};

struct LimitCheck {
  std::string metric, unit, source, phase;
  std::string scenario;  // of a plan in several: the one that decides whether the limit is kept
  double value = std::numeric_limits<double>::quiet_NaN();
  double limit = std::numeric_limits<double>::quiet_NaN();
  double margin = std::numeric_limits<double>::quiet_NaN();  // limit - value for a max, value - limit for a min
  double time = std::numeric_limits<double>::quiet_NaN();    // s
  bool is_max = true, hard = true, pass = false;
};

/// Checks every limit. A metric that could not be computed (NaN) fails.
std::vector<LimitCheck> check_limits(const std::vector<LimitSpec>& limits, const Metrics& metrics);

/// How much of what a limit allows is used: 0.07 = 7 %, above 1 it is broken. Of a maximum value / limit, of a minimum
/// limit / value; of an amplification or a slack ratio only the dynamic part counts, from the 1 of a lift at rest:
/// a DAF of 1.021 uses 7 % of 1.3. For a limit of zero ("no re-hits") there is no such share: 0 if it is kept,
/// +infinity if not; values without one (NaN) give +infinity.
double limit_use(const LimitCheck& check);

/// "7 % of what it allows", "17.4 times what it allows"; empty where there is no such share.
std::string limit_use_text(const LimitCheck& check);

/// 1 - limit_use(): the criterion with the smallest one governs.
double relative_margin(const LimitCheck& check);

/// The check that uses the largest share of what its limit allows, hard ones before soft ones; nullptr if there is none.
const LimitCheck* governing_check(const std::vector<LimitCheck>& checks);

/// True when the run completed and no hard limit is violated.
bool within_limits(const Metrics& metrics, const std::vector<LimitCheck>& checks);

}  // namespace stillhook
