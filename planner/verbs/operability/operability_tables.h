// Tables of `stillhook operability`, for the screen and the report, and its verdict.
#pragma once

#include <string>
#include <vector>

#include "planner/verbs/operability/study.h"
#include "results/report.h"

namespace stillhook {

/// What the study says in a sentence or two.
std::string operability_verdict(const OperabilityStudy& study);

/// Limits of the whole lift, a row a heading, a column a period.
ReportTable limits_matrix(const OperabilityStudy& study);
/// Each column's limit, interval, criterion and flags.
ReportTable limits_list(const OperabilityStudy& study);
/// The same matrix for a phase.
ReportTable phase_matrix(const OperabilityStudy& study, std::size_t place);
/// Seeds, runs and time of each column.
ReportTable runs_table(const OperabilityStudy& study);
/// Settings of the study.
ReportTable operability_settings(const OperabilityStudy& study);

/// What a study will take: one timed run told by the caller.
struct CostEstimate {
  double run_s = 0.0;  // wall time of one run
  std::size_t bytes_a_run = 0;
  OperabilityColumn column;  // whose run was timed
  double height = 0.0;       // m
  int jobs = 1;
};
/// {"tasks", "runs_least", ...} for --json.
std::string cost_json(const OperabilityPlan& plan, const CostEstimate& cost);
std::string cost_text(const OperabilityPlan& plan, const CostEstimate& cost);

/// Letters that name the criteria in narrow cells: A, B, ...
std::string criterion_letter(const OperabilityStudy& study, const std::string& criterion);
/// "A off-lead, B re-hits", of those that govern somewhere.
std::string letters_text(const OperabilityStudy& study);
/// "0.87", "≥ 1.20", "0.87?"
std::string limit_text(const OperabilityStudy& study, std::size_t task, std::size_t place);

}  // namespace stillhook
