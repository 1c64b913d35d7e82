// The front between two metrics that cannot both be had: plans that no other beats in both.
//
//   for limits e between the ends of the front:   minimise second(x)  subject to  first(x) <= e  and every hard limit
//
// (the epsilon-constraint method: Haimes, Lasdon & Wismer 1971; it also finds what lies in a dent of the front, which
// weighted sums miss). Each metric counts with its largest value over the scenarios. The ends come first: the least
// second metric, then the least first one; the points between start from their better neighbour.
#pragma once

#include "planner/verbs/plan/plan.h"
#include "results/report.h"
#include "results/summary.h"

namespace stillhook {

/// The points that were found: each of the front with its x, and what the searches passed on their way.
struct TracedFront {
  struct Point {
    Eigen::VectorXd x;
    double first = 0.0, second = 0.0;  // in the metrics' units
    bool feasible = false, on_front = false;
    std::string label;
  };
  std::string first, second;
  std::vector<Point> points;
  int evaluations = 0, gradients = 0;
  bool interrupted = false;
};

/// Identity of the store of a front.
StoreIdentity front_identity(const Case& c);

/// The evaluator of the front's problem: the case with both metrics limited at their values in the baseline.
/// Throws CaseError if the baseline has no such values.
Evaluator front_evaluator(const Evaluator& evaluator, const Evaluation& baseline, const std::atomic<bool>* stop);

/// Traces the front of case.plan.pareto from the plan. `front` is front_evaluator()'s; the store is the front's own.
TracedFront trace_front(const Evaluator& front, const PlanResult& plan, EvaluationStore& store,
                        const PlanOptions& options);

/// The result of an earlier trace_front() from what its store holds alone; what is not there ends it.
TracedFront replay_front(const Evaluator& front, const PlanResult& plan, EvaluationStore& store);

ParetoFront front_drawing(const TracedFront& front);
ParetoSummary front_summary(const TracedFront& front);

/// The front as a list for the screen.
std::string front_text(const ParetoSummary& front);

}  // namespace stillhook
