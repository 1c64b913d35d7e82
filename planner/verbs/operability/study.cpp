#include "planner/verbs/operability/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace stillhook {
namespace {

/// How many columns have which flag of the whole lift.
std::map<std::string, std::vector<std::size_t>> flagged_columns(const OperabilityStudy& study) {
  std::map<std::string, std::vector<std::size_t>> flagged;
  for (std::size_t task = 0; task < study.collected.columns.size(); ++task)
    for (const std::string& flag : flags_of(study, task, 0)) flagged[flag].push_back(task);
  return flagged;
}

std::string columns_text(const OperabilityStudy& study, const std::vector<std::size_t>& tasks) {
  std::string text = column_text(study.plan().columns[tasks.front()]);
  if (tasks.size() > 1) text += fmt::format(" and {} more", tasks.size() - 1);
  return text;
}

void warn_of_columns(OperabilityStudy& study) {
  const auto flagged = flagged_columns(study);
  const auto tell = [&](const char* flag, std::vector<std::string>& list, const std::string& sentence) {
    if (const auto found = flagged.find(flag); found != flagged.end())
      list.push_back(columns_text(study, found->second) + ": " + sentence);
  };
  tell("incomplete", study.warnings, "not all runs are there: what is shown is a bound");
  tell("crashed", study.warnings,
       "a run ended the program twice: what it would have given is not known, and the limit counts as not certified");
  tell("not_certified", study.warnings,
       fmt::format("{} seeds are too few for a lower bound of a limit at {:g}: it is an estimate only",
                   study.plan().rules.looks.back(), study.plan().rules.level));
  tell("breaks_at_once", study.warnings, "a limit is broken in the lowest sea that was tried: no sea is low enough");
  tell(
      "not_monotone", study.warnings,
      "a seed breaks a limit at a height and keeps it at a larger one; the lower height counts, and others like it may "
      "lie between the heights that were tried");
  tell("wide", study.notes,
       fmt::format("the interval of the limit is wider than the tolerance of {:g} asks for, with all {} seeds",
                   study.plan().rules.tolerance, study.plan().rules.looks.back()));
  tell("steep", study.notes,
       "the steepest sea of the period is within the limits: its height is given, the limit lies higher");
  tell("at_least", study.notes, "operability.height_max_m is within the limits: it is given, the limit lies higher");
}

void warn_of_machines(OperabilityStudy& study) {
  const Collected& c = study.collected;
  if (c.arithmetic.size() > 1)
    study.warnings.push_back(fmt::format(
        "the runs come from {} kinds of processor, whose C libraries round sines and exponentials differently: another "
        "campaign need not give the same last bits",
        c.arithmetic.size()));
  if (c.repeated > 0)
    study.notes.push_back(fmt::format("{} of {} runs were made twice, by different attempts, and gave the same bits",
                                      c.repeated, c.runs + c.repeated));
}

}  // namespace

OperabilityStudy study_of(Campaign campaign) {
  OperabilityStudy study;
  study.campaign = std::move(campaign);
  study.collected = collect(study.campaign);
  warn_of_columns(study);
  warn_of_machines(study);
  return study;
}

std::vector<std::string> flags_of(const OperabilityStudy& study, std::size_t task, std::size_t place) {
  const CollectedColumn& column = study.collected.columns[task];
  const TargetLimit& limit = column.result.targets[place];
  const OperabilityColumn& of = study.plan().columns[task];
  std::vector<std::string> flags;
  if (!column.complete) flags.emplace_back("incomplete");
  if (column.result.crashed > 0) flags.emplace_back("crashed");
  if (place == 0 && column.complete && std::isnan(limit.limit.low)) flags.emplace_back("not_certified");
  const bool reached_end = limit.resolved && limit.at_least;
  if (place == 0 && column.result.certified && !column.result.within_tolerance) flags.emplace_back("wide");
  if (reached_end && of.highest >= steepest_height(of.peak_period) * (1.0 - 1e-9))
    flags.emplace_back("steep");
  else if (limit.at_least && column.complete)
    flags.emplace_back("at_least");
  if (limit.below_lowest) flags.emplace_back("breaks_at_once");
  if (place == 0 && !column.result.monotone) flags.emplace_back("not_monotone");
  if (flags.empty()) flags.emplace_back("ok");
  return flags;
}

bool certified(const OperabilityStudy& study) {
  return std::all_of(study.collected.columns.begin(), study.collected.columns.end(),
                     [](const CollectedColumn& c) { return c.complete && c.result.certified; });
}

std::string place_name(const OperabilityPlan& plan, std::size_t place) {
  return place == 0 ? "all" : plan.phases[place - 1];
}

}  // namespace stillhook
