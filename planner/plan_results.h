// What a finished search says: numbers for the summary and the report.
#pragma once

#include <vector>

#include "planner/plan.h"
#include "planner/run.h"
#include "results/report.h"
#include "results/summary.h"

namespace stillhook {

/// The limits as one scenario of an evaluation kept them: values, no times.
std::vector<LimitCheck> limits_of(const Evaluator& evaluator, const ScenarioOutcome& outcome);

/// Limit by limit the check with the smallest margin; all lists have the same limits in the same order.
std::vector<LimitCheck> worst_limits(const std::vector<std::vector<LimitCheck>>& by_scenario);

/// The limits over all scenarios of an evaluation.
std::vector<LimitCheck> worst_limits(const Evaluator& evaluator, const Evaluation& evaluation);

/// The scenario that a plan's history and report show: the one that comes closest to a hard limit, relative to the
/// limit's scale; without hard limits the one with the largest objective.
std::size_t governing_scenario(const Evaluator& evaluator, const Evaluation& evaluation);

/// The specification of a scenario of the evaluator with the variables at x.
Specification specification_at(const Evaluator& evaluator, const Eigen::VectorXd& x, std::size_t scenario);

/// One sentence on a scenario.
std::string scenario_text(const ScenarioSpec& scenario);

/// The sentence of a report that says which scenario its histories show.
std::string history_note(const Evaluator& evaluator, std::size_t scenario);

/// Everything of the search that a report shows. `wall` in s, NaN if it is not known.
SearchSection search_section(const Evaluator& evaluator, const PlanResult& result, double wall);

/// Adds objective, search and variables to a summary.
void add_search(const Evaluator& evaluator, const PlanResult& result, Summary& summary);

}  // namespace stillhook
