#include "planner/verbs/plan/pareto.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "planner/verbs/plan/plan_results.h"

namespace stillhook {
namespace {

constexpr double kTolerance = 1e-6;  // of a scaled constraint

double largest(const Evaluator& evaluator, const Evaluation& e, const std::string& metric) {
  double value = -std::numeric_limits<double>::infinity();
  for (const ScenarioOutcome& outcome : evaluator.outcomes(e)) {
    const double here = evaluator.metric_of(outcome, metric);
    if (!std::isfinite(here)) return std::numeric_limits<double>::quiet_NaN();
    value = std::max(value, here);
  }
  return value;
}

class FrontSearch {
 public:
  FrontSearch(const Evaluator& evaluator, const SearchProblem& problem, EvaluationStore& store,
              const PlanOptions& options)
      : evaluator_(evaluator), options_(options), spec_(evaluator.base().plan.pareto) {
    const PlanSpec& plan = evaluator.base().plan;
    with_gradient_ = plan.gradient_algorithm != "none";
    solver_ = with_gradient_                   ? plan.gradient_algorithm
              : plan.local_algorithm == "none" ? "cobyla"
                                               : plan.local_algorithm;
    problem_ = with_store(problem, store, "front");
    // The two metrics' own limits are the last constraints.
    const auto& constraints = evaluator.constraints();
    second_ = static_cast<Eigen::Index>(constraints.size()) - 1;
    first_ = second_ - 1;
    front_.first = spec_.first;
    front_.second = spec_.second;
  }

  TracedFront trace(const PlanResult& plan) {
    take(evaluator_.baseline(), "as given");
    if (plan.search.best_x.size() > 0) take(plan.search.best_x, "plan");
    minimise(second_, std::nullopt, best_known(second_, std::nullopt));
    const std::optional<double> slack = lowest(first_, best_known(second_, std::nullopt));
    minimise(first_, std::nullopt, best_known(first_, std::nullopt));
    const std::optional<double> tight = lowest(first_, best_known(first_, std::nullopt));
    if (slack && tight)
      for (int k = spec_.points - 2; k > 0; --k) {
        const double share = static_cast<double>(k) / (spec_.points - 1), limit = *tight + share * (*slack - *tight);
        minimise(second_, limit, best_known(second_, limit));
      }
    mark();
    return std::move(front_);
  }

 private:
  struct Known {
    Eigen::VectorXd x;
    double value[2];   // scaled like the constraints: first, second
    double violation;  // of the hard limits
  };

  bool stopped() const { return front_.interrupted || (options_.stop && options_.stop->load()); }

  // The evaluation by the metrics as they are.
  void note(const Eigen::VectorXd& x, const Evaluation& e, const std::string& label) {
    if (e.interrupted) {
      front_.interrupted = true;
      return;
    }
    const Evaluation as_is = evaluator_.aggregated(evaluator_.outcomes(e));
    if (!as_is.usable) return;
    const double limits = first_ > 0 ? std::max(0.0, as_is.constraints.head(first_).maxCoeff()) : 0.0;
    const std::lock_guard lock(mutex_);
    if (std::any_of(known_.begin(), known_.end(), [&](const Known& k) { return k.x == x; })) return;  // passed before
    known_.push_back({x, {as_is.constraints[first_], as_is.constraints[second_]}, limits});
    front_.points.push_back(
        {x, largest(evaluator_, e, spec_.first), largest(evaluator_, e, spec_.second), limits <= 0.0, false, label});
  }

  void take(const Eigen::VectorXd& x, const std::string& label) {
    if (stopped()) return;
    const Evaluation e = problem_.evaluate(x);
    ++front_.evaluations;
    note(x, e, label);
  }

  /// The known point to start from: the best of those that keep the limits, else the one that breaks them least.
  const Known* best_known(Eigen::Index of, std::optional<double> limit) const {
    const auto key = [&](const Known& k) {
      const double over = std::max(k.violation, limit ? k.value[0] - *limit : 0.0);
      return std::pair(std::max(over, 0.0), k.value[of - first_]);
    };
    const Known* best = nullptr;
    for (const Known& k : known_)
      if (!best || key(k) < key(*best)) best = &k;
    return best;
  }
  std::optional<double> lowest(Eigen::Index of, const Known* k) const {
    return k ? std::optional(k->value[of - first_]) : std::nullopt;
  }

  /// The front's problem with one of its two constraints as the objective and the other at `limit`, or gone.
  Evaluation posed(Evaluation e, Eigen::Index of, std::optional<double> limit) const {
    if (!e.usable) {
      if (e.constraints.size() > 0) e.constraints.conservativeResize(first_ + 1);
      return e;
    }
    const Eigen::VectorXd g = e.constraints;
    const Eigen::MatrixXd J = e.constraint_jacobian;
    e.objective = g[of];
    e.constraints = g.head(first_ + 1);
    e.constraints[first_] = limit ? g[first_] - *limit : -1.0;
    if (!e.gradient_valid) return e;
    e.objective_gradient = J.row(of);
    e.constraint_jacobian = J.topRows(first_ + 1);
    if (!limit) e.constraint_jacobian.row(first_).setZero();
    return e;
  }

  void minimise(Eigen::Index of, std::optional<double> limit, const Known* start) {
    if (!start || stopped()) return;
    SearchProblem problem = problem_;
    problem.name += " front";
    problem.start = start->x;
    problem.constraint_names.resize(static_cast<std::size_t>(first_) + 1);
    const auto wrap = [this, of, limit](auto evaluate) {
      return [this, of, limit, evaluate](const Eigen::VectorXd& x) {
        const Evaluation e = evaluate(x);
        note(x, e, "");
        return posed(e, of, limit);
      };
    };
    problem.evaluate = wrap(problem_.evaluate);
    if (problem_.evaluate_with_gradient) problem.evaluate_with_gradient = wrap(problem_.evaluate_with_gradient);
    SolveOptions with;
    with.solver = solver_;
    with.evaluations = spec_.evaluations;
    with.seed = static_cast<unsigned long>(evaluator_.base().plan.seed);
    with.constraint_tolerance = kTolerance;
    with.x_tolerance = 1e-3;
    with.should_stop = [this] { return stopped(); };
    with.progress = options_.progress;
    if (const std::string fault = solve_fault(problem, with); !fault.empty()) throw CaseError("plan.pareto: " + fault);
    const SearchReport report = solve(problem, with);
    front_.evaluations += report.evaluations;
    front_.gradients += report.gradients;
    front_.interrupted = front_.interrupted || report.status == SearchStatus::interrupted;
  }

  /// Which points no other beats: among those that keep the limits.
  void mark() {
    for (TracedFront::Point& p : front_.points) {
      p.on_front = p.feasible && std::none_of(front_.points.begin(), front_.points.end(), [&](const auto& q) {
                     return q.feasible && q.first <= p.first && q.second <= p.second &&
                            (q.first < p.first || q.second < p.second || &q < &p);
                   });
    }
  }

  const Evaluator& evaluator_;
  const PlanOptions& options_;
  const ParetoSpec& spec_;
  bool with_gradient_ = false;
  std::string solver_;
  SearchProblem problem_;
  Eigen::Index first_ = 0, second_ = 0;
  std::mutex mutex_;
  std::vector<Known> known_;
  TracedFront front_;
};

SearchProblem problem_of(const Evaluator& front) {
  return front.base().plan.gradient_algorithm != "none" ? front.smooth_problem({}) : front.problem();
}

}  // namespace

StoreIdentity front_identity(const Case& c) {
  StoreIdentity identity = store_identity(c);
  identity.problem += "# front of " + c.plan.pareto.first + " and " + c.plan.pareto.second + "\n";
  return identity;
}

Evaluator front_evaluator(const Evaluator& evaluator, const Evaluation& baseline, const std::atomic<bool>* stop) {
  Case c = evaluator.base();
  for (const std::string& metric : {c.plan.pareto.first, c.plan.pareto.second}) {
    const double value =
        baseline.usable ? largest(evaluator, baseline, metric) : std::numeric_limits<double>::quiet_NaN();
    if (!std::isfinite(value))
      throw CaseError("plan.pareto: the lift as given has no value of " + metric + ", which scales the front");
    LimitSpec limit;
    limit.metric = metric;
    limit.max = value;
    limit.source = "the lift as given";
    c.limits.push_back(limit);
  }
  return Evaluator(std::move(c), stop);
}

TracedFront trace_front(const Evaluator& front, const PlanResult& plan, EvaluationStore& store,
                        const PlanOptions& options) {
  return FrontSearch(front, problem_of(front), store, options).trace(plan);
}

TracedFront replay_front(const Evaluator& front, const PlanResult& plan, EvaluationStore& store) {
  SearchProblem problem = problem_of(front);
  const auto unknown = [](const Eigen::VectorXd&) {
    Evaluation e;
    e.interrupted = true;
    return e;
  };
  problem.evaluate = unknown;
  if (problem.evaluate_with_gradient) problem.evaluate_with_gradient = unknown;
  return FrontSearch(front, problem, store, {}).trace(plan);
}

ParetoFront front_drawing(const TracedFront& front) {
  ParetoFront drawing{front.first, unit_of_metric(front.first), front.second, unit_of_metric(front.second), {}};
  for (const TracedFront::Point& p : front.points)
    drawing.points.push_back({p.first, p.second, p.on_front, p.feasible, p.label});
  return drawing;
}

ParetoSummary front_summary(const TracedFront& front) {
  ParetoSummary summary{front.first, front.second, {}};
  for (const TracedFront::Point& p : front.points)
    summary.points.push_back({p.first, p.second, p.on_front, p.feasible, {p.x.begin(), p.x.end()}});
  return summary;
}

std::string front_text(const ParetoSummary& front) {
  std::vector<const ParetoSummary::Point*> points;
  for (const ParetoSummary::Point& p : front.points)
    if (p.on_front) points.push_back(&p);
  if (points.empty())
    return fmt::format("Front of {} and {}: no point within the limits was found.", front.first, front.second);
  std::sort(points.begin(), points.end(), [](auto* a, auto* b) { return a->first < b->first; });
  std::string text = fmt::format("Front of {} and {}:", front.first, front.second);
  for (const ParetoSummary::Point* p : points) text += fmt::format("\n  {:12.5g} {:12.5g}", p->first, p->second);
  return text;
}

}  // namespace stillhook
