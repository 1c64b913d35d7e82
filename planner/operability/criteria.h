// The hard limits of a case as criteria of a sea, and how much of each a run uses.
//
// A cell is one criterion in the whole run (place 0) or in one phase (place 1 on). The last criterion is that the run
// completes at all: a lift that diverges, parts a wire or capsizes is broken whatever its limits say.
#pragma once

#include <string>
#include <vector>

#include "planner/operability/column.h"
#include "problems/case.h"
#include "sim/trajectory.h"

namespace stillhook {

inline constexpr const char* kNotCompleted = "not_completed";

struct Criterion {
  std::string name;  // of the metric; with " min" or " max" where it has both limits
  std::string metric;
  double limit = 0.0;  // in the metric's unit
  bool is_max = true;
  bool smooth = true;  // false for counts
};

/// The hard limits in the order of the case, then kNotCompleted.
std::vector<Criterion> criteria_of(const Case& c);

/// What one run gave. values[criterion][place], in the metrics' units; NaN where a metric has no value. Of
/// kNotCompleted: 1 where the run ended early, NaN in phases that it did not reach, else 0.
struct LiftValues {
  RunStatus status = RunStatus::not_run;
  std::string message;  // why it is not completed
  std::vector<std::vector<double>> values;
};

/// Values of a whole run, by phase of `phases`.
LiftValues values_of(const Metrics& metrics, const Trajectory& run, const std::vector<Criterion>& criteria,
                     const std::vector<std::string>& phases);

/// Values of a run of one phase alone are merged into `all`, whose whole is the worst of the phases. The first run
/// begins with an empty `all`.
void merge_phase(LiftValues& all, const Metrics& metrics, const std::vector<Criterion>& criteria,
                 const std::vector<std::string>& phases, std::size_t phase);

/// Shares of what the limits allow, above 1 exactly where check_limits() says that one is broken, by cell:
/// criterion * (phases + 1) + place. A whole run that completes without a value that has a limit breaks it; phases that
/// are simulated alone (`phases_alone`) need not have every value.
std::vector<double> uses_of(const LiftValues& run, const std::vector<Criterion>& criteria, bool phases_alone);

std::vector<ColumnCell> cells_of(const std::vector<Criterion>& criteria, std::size_t phases);

/// "all", then every phase, then every criterion.
std::vector<ColumnTarget> targets_of(const std::vector<Criterion>& criteria, const std::vector<std::string>& phases);

}  // namespace stillhook
