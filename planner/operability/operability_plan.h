// What a study of limiting sea states consists of, worked out from its case alone: every process that sees the same
// case comes to the same columns, seeds and rules.
#pragma once

#include <string>
#include <vector>

#include "planner/operability/column.h"
#include "planner/operability/criteria.h"
#include "problems/case.h"

namespace stillhook {

/// One peak period and one heading: a task.
struct OperabilityColumn {
  double peak_period = 0.0;  // s
  double heading = 0.0;      // rad within [0, 2 pi), direction that the waves travel towards
  double highest = 0.0;      // m, the search goes no further
};

struct OperabilityPlan {
  std::string sea;                                  // name of the state whose height, period, heading and seed are set
  std::vector<double> peak_periods, headings;       // s; rad, ascending within [0, 2 pi)
  std::vector<OperabilityColumn> columns;           // by period, then heading; mirrored headings have none of their own
  std::vector<std::vector<std::size_t>> column_at;  // [period][heading]
  std::vector<Criterion> criteria;
  std::vector<std::string> phases;  // in the order of the operation
  bool phases_alone = false;        // each is simulated for itself, begun at rest
  ColumnRules rules;                // but for `highest`
  int first_seed = 0;

  ColumnRules rules_of(std::size_t column) const;
  /// Of a seed's index; no search has seen them.
  int seed(int index) const;
  std::size_t places() const { return phases.size() + 1; }
};

/// Throws CaseError when the case does not say which seas.
OperabilityPlan operability_plan(const Case& c);

/// Largest significant height of a sea with this peak period, m: its steepness 2 pi Hs/(g Tp^2) is at most 1/15 up to
/// 8 s and 1/25 from 15 s on, linear between (DNV-RP-C205, 3.5.4).
double steepest_height(double peak_period);

/// About how many runs a column takes: if the first look is enough, and if it takes the last one.
struct RunsExpected {
  double least = 0.0, most = 0.0;
};
RunsExpected runs_expected(const ColumnRules& rules);

/// "Tp 8 s, heading 180 deg"
std::string column_text(const OperabilityColumn& column);

double degrees_of(double radians);

}  // namespace stillhook
