// Planning: the baseline, the search and the random sample it must beat, on one store.
#pragma once

#include "problems/evaluator.h"
#include "problems/search/search.h"
#include "problems/search/store.h"

namespace stillhook {

/// The search that a case asks for. The objective's best must keep every limit strictly.
SearchOptions search_options(const PlanSpec& plan);

/// What an evaluation of this case depends on besides x: the resolved document without what only steers the search
/// (budget, seed, algorithms), the contents of the files it names, and the program's version.
StoreIdentity store_identity(const Case& c);

struct PlanOptions {
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const SearchProgress&)> progress;
  /// Called with the best point so far each time it improves during the search.
  std::function<void(const Eigen::VectorXd& best_x)> improved;
};

struct PlanResult {
  /// One evaluation; the objective is NaN where it is not usable.
  struct Point {
    double objective = 0.0;
    bool feasible = false;
  };
  SearchReport gradient;  // the stage on the smooth problem; not_run without one
  SearchReport search, random;
  Evaluation baseline;
  std::vector<Point> history, random_history;  // in the order asked for
  int distinct = 0;                            // different points that the search asked for
  bool interrupted = false;                    // stopped from outside before all was done

  bool has_plan() const { return search.best_evaluation > 0 && search.best.usable; }
};

/// Searches, then samples at random as many points as the search took, unless the case asks for none. Deterministic for a case without time budget:
/// with what the store holds answered from there, it ends at the same plan. Throws CaseError if the case's algorithms
/// cannot solve its problem.
PlanResult solve_plan(const Evaluator& evaluator, EvaluationStore& store, const PlanOptions& options = {});

/// The result of an earlier solve_plan() from what its store holds alone, simulating nothing. One that was interrupted
/// ends where its store does.
PlanResult replay_plan(const Evaluator& evaluator, EvaluationStore& store);

}  // namespace stillhook
