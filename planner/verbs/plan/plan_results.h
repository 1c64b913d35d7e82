// What a finished search says: numbers for the summary and the report.
#pragma once

#include <vector>

#include "planner/verbs/plan/plan.h"
#include "planner/run.h"
#include "results/report.h"
#include "results/summary.h"

namespace stillhook {

/// The limits as one scenario of an evaluation kept them: values, no times.
std::vector<LimitCheck> limits_of(const Evaluator& evaluator, const ScenarioOutcome& outcome);

/// Limit by limit the check of the scenario that decides: the one with the smallest margin, or where a share of the
/// scenarios may break the limit, the one with the smallest margin beyond that share. All lists have the limits of the
/// case in its order. This rule is the search's own, and that of every table and file that a plan leaves.
std::vector<LimitCheck> deciding_limits(const Evaluator& evaluator,
                                        const std::vector<std::vector<LimitCheck>>& by_scenario);

/// The limits over all scenarios of an evaluation.
std::vector<LimitCheck> deciding_limits(const Evaluator& evaluator, const Evaluation& evaluation);

/// The metrics that go with such limits: what is limited, from the scenario that decides; everything else from scenario
/// `shown`, whose history the folder holds. Its status is that of the first scenario that was not completed, if any.
Metrics deciding_metrics(const Evaluator& evaluator, const std::vector<Metrics>& by_scenario,
                         const std::vector<LimitCheck>& limits, std::size_t shown);

/// The same of an evaluation: values, no times.
Metrics deciding_metrics(const Evaluator& evaluator, const Evaluation& evaluation);

/// The scenario that a plan's history and report show: the one that comes closest to a hard limit, relative to the
/// limit's scale; without hard limits the one with the largest objective.
std::size_t governing_scenario(const Evaluator& evaluator, const Evaluation& evaluation);

/// The specification of a scenario of the evaluator with the variables at x.
Specification specification_at(const Evaluator& evaluator, const Eigen::VectorXd& x, std::size_t scenario);

/// What must be known before the numbers of a search are used: the warnings of its baseline in every scenario, each once.
/// Throws CaseError for a baseline that cannot be built.
std::vector<std::string> scenario_warnings(const Evaluator& evaluator, const Case& c, const HydroProgress& progress);

/// One sentence on a scenario.
std::string scenario_text(const ScenarioSpec& scenario);

/// The sentence of a report that says which scenario its histories show.
std::string history_note(const Evaluator& evaluator, std::size_t scenario);

/// Everything of the search that a report shows. `wall` in s, NaN if it is not known.
SearchSection search_section(const Evaluator& evaluator, const PlanResult& result, double wall);

/// Adds objective, search and variables to a summary.
void add_search(const Evaluator& evaluator, const PlanResult& result, Summary& summary);

/// The unit of a metric, by its name; empty for a name that is none.
std::string unit_of_metric(const std::string& name);

}  // namespace stillhook
