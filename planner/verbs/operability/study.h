// A campaign's columns as limits of a lift: the grid of periods and headings, what governs, what is not certain.
#pragma once

#include <string>
#include <vector>

#include "planner/campaign/collect.h"

namespace stillhook {

struct OperabilityStudy {
  Campaign campaign;
  Collected collected;
  std::vector<std::string> warnings, notes;  // one sentence each

  const OperabilityPlan& plan() const { return campaign.plan; }
  std::size_t task_at(std::size_t period, std::size_t heading) const { return plan().column_at[period][heading]; }
  const CollectedColumn& at(std::size_t period, std::size_t heading) const {
    return collected.columns[task_at(period, heading)];
  }
  /// The limit of the whole (place 0) or of a phase (place 1 on).
  const TargetLimit& limit(std::size_t period, std::size_t heading, std::size_t place = 0) const {
    return at(period, heading).result.targets[place];
  }
};

/// Collects what the folder holds. Throws UsageError and FileError.
OperabilityStudy study_of(Campaign campaign);

/// What a column's limit is not, each a word: "incomplete", "crashed", "not_certified", "wide" (its interval),
/// "at_least", "steep" (the steepest sea of the period is within the limits), "breaks_at_once", "not_monotone"; "ok" if
/// nothing.
std::vector<std::string> flags_of(const OperabilityStudy& study, std::size_t task, std::size_t place);

/// Every column complete, none with a crashed run, all with a lower bound.
bool certified(const OperabilityStudy& study);

/// "wire or crane" words of phases: "all" or the phase's name.
std::string place_name(const OperabilityPlan& plan, std::size_t place);

}  // namespace stillhook
