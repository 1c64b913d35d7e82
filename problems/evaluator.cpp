#include "problems/evaluator.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <numeric>

#include "problems/scenarios.h"
#include "sim/number_text.h"
#include "sim/simulate.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr double kFailedObjective = 1000.0;  // terms are of order 1
constexpr std::size_t kHeader = 2;           // status and reached, before the metrics in `details`

std::vector<ConstraintSpec> constraints_of(const Case& c) {
  std::vector<ConstraintSpec> constraints;
  for (const LimitSpec& limit : c.limits) {
    if (!limit.hard) continue;
    const MetricDefinition* metric = metric_definition(limit.metric);
    if (!metric) throw CaseError("limits." + limit.metric + ": there is no such metric");
    if (limit.max)
      constraints.push_back({limit.metric, *limit.max, limit_scale(*limit.max, metric->quantity), true, limit.share});
    if (limit.min)
      constraints.push_back({limit.metric, *limit.min, limit_scale(*limit.min, metric->quantity), false, limit.share});
  }
  return constraints;
}

Eigen::VectorXd baseline_of(const Case& c) {
  Eigen::VectorXd x(static_cast<Eigen::Index>(c.plan.variables.size()));
  for (std::size_t i = 0; i < c.plan.variables.size(); ++i) {
    const VariableSpec& v = c.plan.variables[i];
    const double value = key_value(c, v.key);
    if (!(value >= v.lower && value <= v.upper))
      throw CaseError("plan.variables." + v.key + ": the case has " + number_text(value) + ", outside the bounds " +
                      number_text(v.lower) + " to " + number_text(v.upper));
    x[static_cast<Eigen::Index>(i)] = value;
  }
  return x;
}

void check_objective(const Case& c) {
  if (c.plan.objective.empty()) throw CaseError("plan.objective: there is no term to minimise");
  if (c.plan.variables.empty()) throw CaseError("plan.variables: there is no variable to search over");
  for (const ObjectiveTerm& term : c.plan.objective)
    if (!metric_exists(term.metric, c.specification))
      throw CaseError("plan.objective." + term.metric + ": there is no such metric in this case");
}

}  // namespace

double limit_scale(double limit, Quantity quantity) {
  return limit != 0.0 ? std::abs(limit) : noticeable_step(quantity);
}

Evaluator::Evaluator(Case c, const std::atomic<bool>* stop) : Evaluator(c, scenarios_of(c), stop) {}

Evaluator::Evaluator(Case c, std::vector<ScenarioSpec> scenarios, const std::atomic<bool>* stop)
    : case_(std::move(c)),
      stop_(stop),
      scenarios_(std::move(scenarios)),
      constraints_(constraints_of(case_)),
      metric_names_(stillhook::metric_names(case_.specification)),
      bases_(std::make_shared<Bases>(scenarios_.size())) {
  check_objective(case_);
  for (const ObjectiveTerm& term : case_.plan.objective) smooth_names_.push_back(term.metric);
  for (const ConstraintSpec& constraint : constraints_) smooth_names_.push_back(constraint.metric);
  for (const ScenarioSpec& scenario : scenarios_) in_scenario(case_.specification, scenario);
  baseline_ = baseline_of(case_);
}

Case Evaluator::case_at(const Eigen::VectorXd& x) const {
  std::vector<std::pair<std::string, double>> values;
  for (std::size_t i = 0; i < case_.plan.variables.size(); ++i)
    values.emplace_back(case_.plan.variables[i].key, x[static_cast<Eigen::Index>(i)]);
  return with_values(case_, values);
}

struct Evaluator::Bases {
  struct Base {
    std::once_flag once;
    std::shared_ptr<const Model> model;  // null if the base cannot be built: every lift is then built for itself
    Operation operation;
  };
  explicit Bases(std::size_t scenarios) : all(scenarios) {}
  std::vector<Base> all;
};

Evaluator::Lift Evaluator::lift_of(const Case& c, std::size_t scenario) const {
  Specification specification = in_scenario(c.specification, scenarios_[scenario]);
  const bool timing_alone = std::all_of(case_.plan.variables.begin(), case_.plan.variables.end(),
                                        [](const VariableSpec& v) { return v.key.starts_with("operation.phases."); }) &&
                            same_poses(case_.specification.operation, specification.operation);
  if (timing_alone) {
    Bases::Base& base = bases_->all[scenario];
    std::call_once(base.once, [&] {
      try {
        auto model = std::make_shared<const Model>(build_model(in_scenario(case_.specification, scenarios_[scenario])));
        base.operation = build_operation(*model);
        base.model = std::move(model);
      } catch (const SpecificationError&) {  // the point's own fault is told, should it have the same
      }
    });
    if (base.model) {
      Operation operation = retimed_operation(*base.model, specification.operation, base.operation);
      return {base.model, std::move(operation), std::move(specification)};
    }
  }
  auto model = std::make_shared<const Model>(build_model(specification));
  Operation operation = build_operation(*model);
  return {std::move(model), std::move(operation), std::move(specification)};
}

ScenarioOutcome Evaluator::run_scenario(const Case& c, std::size_t scenario) const {
  ScenarioOutcome outcome;
  outcome.metrics.assign(metric_names_.size(), kNaN);
  try {
    const Lift lift = lift_of(c, scenario);
    Operation operation = lift.operation;
    RunOptions options;
    SystemState start;
    if (const OperationPart& part = case_.plan.part; !part.whole()) {
      start = start_of(operation, part);
      options.from = &start;
      operation = part_of(operation, part);
    }
    double end = operation.planned_duration();
    options.progress = [&](double, double t_end) {
      end = t_end;
      return !(stop_ && stop_->load());
    };
    note_run(lift.specification, simulate(*lift.model, operation, options), end, outcome);
  } catch (const SpecificationError& error) {
    outcome.message = error.what();
  } catch (const CaseError& error) {
    outcome.message = error.what();
  }
  return outcome;
}

void Evaluator::note_run(const Specification& specification, const Trajectory& run, double planned,
                         ScenarioOutcome& outcome) const {
  const Metrics metrics = compute_metrics(specification, run);
  outcome.status = metrics.status;
  outcome.message = metrics.message;
  double last = run.time.empty() ? 0.0 : run.time.back();
  if (metrics.status == RunStatus::failed) last = metrics.failed_at;
  outcome.reached =
      metrics.status == RunStatus::completed ? 1.0 : std::clamp(planned > 0.0 ? last / planned : 0.0, 0.0, 1.0);
  for (std::size_t i = 0; i < metric_names_.size(); ++i) outcome.metrics[i] = metrics.value(metric_names_[i]);
}

Evaluation Evaluator::evaluate(const Eigen::VectorXd& x) const {
  std::vector<ScenarioOutcome> outcomes(scenarios_.size());
  Case changed;
  try {
    changed = case_at(x);
  } catch (const CaseError& error) {
    for (ScenarioOutcome& outcome : outcomes) {
      outcome.metrics.assign(metric_names_.size(), kNaN);
      outcome.message = error.what();
    }
    return aggregated(outcomes);
  }
  std::vector<std::exception_ptr> errors(scenarios_.size());
#pragma omp parallel for schedule(dynamic, 1) if (!omp_in_parallel() && scenarios_.size() > 1)
  for (std::size_t i = 0; i < scenarios_.size(); ++i) {
    try {
      outcomes[i] = run_scenario(changed, i);
    } catch (...) {
      errors[i] = std::current_exception();
    }
  }
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  return aggregated(outcomes);
}

double Evaluator::metric_of(const ScenarioOutcome& outcome, const std::string& name) const {
  const auto found = std::find(metric_names_.begin(), metric_names_.end(), name);
  return found == metric_names_.end() ? kNaN : outcome.metrics[static_cast<std::size_t>(found - metric_names_.begin())];
}

double Evaluator::objective_of(const ScenarioOutcome& outcome) const {
  double sum = 0.0;
  for (const ObjectiveTerm& term : case_.plan.objective)
    sum += term.weight * metric_of(outcome, term.metric) / term.scale;
  return sum;
}

double Evaluator::constraint_of(const ScenarioOutcome& outcome, const ConstraintSpec& constraint) const {
  const double excess = metric_of(outcome, constraint.metric) - constraint.limit;
  const double scaled = (constraint.is_max ? excess : -excess) / constraint.scale;
  // What could not be computed is not within the limit, as in check_limits().
  return std::isfinite(scaled) ? scaled : 1.0;
}

std::size_t Evaluator::deciding(double share, const std::vector<double>& values) const {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] > values[b]; });
  double total = 0.0, passed = 0.0;
  for (const ScenarioSpec& s : scenarios_) total += s.weight;
  for (const std::size_t i : order) {
    passed += scenarios_[i].weight;
    if (passed > share * total * (1.0 + 1e-12)) return i;
  }
  return order.front();
}

double Evaluator::closeness(const ScenarioOutcome& outcome) const {
  if (constraints_.empty()) return objective_of(outcome);
  double closest = -std::numeric_limits<double>::infinity();
  for (const ConstraintSpec& constraint : constraints_) closest = std::max(closest, constraint_of(outcome, constraint));
  return closest;
}

Eigen::VectorXd Evaluator::scenario_shares(const Eigen::VectorXd& objectives) const {
  Eigen::VectorXd share = Eigen::VectorXd::Zero(objectives.size());
  double total = 0.0;
  for (const ScenarioSpec& s : scenarios_) total += s.weight;
  if (case_.plan.aggregate == PlanSpec::Aggregate::mean) {
    for (Eigen::Index i = 0; i < share.size(); ++i) share[i] = scenarios_[static_cast<std::size_t>(i)].weight / total;
    return share;
  }
  // From the worst on, until the tail is full; `worst` is a tail of one scenario.
  std::vector<Eigen::Index> order(static_cast<std::size_t>(share.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return objectives[a] > objectives[b]; });
  if (case_.plan.aggregate == PlanSpec::Aggregate::worst) {
    share[order.front()] = 1.0;
    return share;
  }
  const double tail = case_.plan.tail_share * total;
  double left = tail;
  for (const Eigen::Index i : order) {
    const double taken = std::min(left, scenarios_[static_cast<std::size_t>(i)].weight);
    share[i] = taken / tail;
    left -= taken;
  }
  return share;
}

Evaluation Evaluator::aggregated(const std::vector<ScenarioOutcome>& outcomes) const {
  Evaluation e;
  e.usable = true;
  double reached = 0.0;
  Eigen::VectorXd objectives(static_cast<Eigen::Index>(outcomes.size()));
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const ScenarioOutcome& outcome = outcomes[i];
    e.details.push_back(static_cast<double>(outcome.status));
    e.details.push_back(outcome.reached);
    e.details.insert(e.details.end(), outcome.metrics.begin(), outcome.metrics.end());
    e.interrupted = e.interrupted || outcome.status == RunStatus::interrupted;
    const double value = objective_of(outcome);
    const bool good = outcome.status == RunStatus::completed && std::isfinite(value);
    if (!good && e.usable) {
      const std::string why =
          outcome.status == RunStatus::completed ? "a metric of the objective does not exist in it" : outcome.message;
      e.message = scenarios_[i].name + ": " + why;
    }
    e.usable = e.usable && good;
    reached += outcome.reached / static_cast<double>(outcomes.size());
    objectives[static_cast<Eigen::Index>(i)] = value;
  }
  const Eigen::Index m = static_cast<Eigen::Index>(constraints_.size());
  if (!e.usable) {
    e.objective = kFailedObjective * (2.0 - reached);
    e.constraints = Eigen::VectorXd::Constant(m, 2.0 - reached);
    return e;
  }
  e.objective = scenario_shares(objectives).dot(objectives);
  e.constraints.resize(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const ConstraintSpec& constraint = constraints_[static_cast<std::size_t>(i)];
    std::vector<double> values;
    for (const ScenarioOutcome& outcome : outcomes) values.push_back(constraint_of(outcome, constraint));
    e.constraints[i] = values[deciding(constraint.share, values)];
  }
  return e;
}

SearchProblem Evaluator::problem() const {
  SearchProblem problem;
  problem.name = case_.name;
  const Eigen::Index n = static_cast<Eigen::Index>(case_.plan.variables.size());
  problem.lower.resize(n);
  problem.upper.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const VariableSpec& v = case_.plan.variables[static_cast<std::size_t>(i)];
    problem.variable_names.push_back(v.key);
    problem.lower[i] = v.lower;
    problem.upper[i] = v.upper;
    problem.logarithmic.push_back(v.logarithmic);
  }
  problem.start = baseline_;
  for (const ConstraintSpec& c : constraints_)
    problem.constraint_names.push_back(c.metric + (c.is_max ? " max" : " min"));
  problem.evaluate = [this](const Eigen::VectorXd& x) { return evaluate(x); };
  return problem;
}

std::vector<ScenarioOutcome> Evaluator::outcomes(const Evaluation& evaluation) const {
  std::vector<ScenarioOutcome> outcomes(scenarios_.size());
  const std::size_t size = kHeader + metric_names_.size();
  if (evaluation.details.size() != outcomes.size() * size) return {};
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const auto begin = evaluation.details.begin() + static_cast<std::ptrdiff_t>(i * size);
    outcomes[i].status = static_cast<RunStatus>(static_cast<int>(begin[0]));
    outcomes[i].reached = begin[1];
    outcomes[i].metrics.assign(begin + kHeader, begin + static_cast<std::ptrdiff_t>(size));
  }
  return outcomes;
}

std::vector<TermValue> Evaluator::terms(const Evaluation& evaluation) const {
  const std::vector<ScenarioOutcome> all = outcomes(evaluation);
  Eigen::VectorXd objectives(static_cast<Eigen::Index>(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i) objectives[static_cast<Eigen::Index>(i)] = objective_of(all[i]);
  const bool known = evaluation.usable && !all.empty();
  const Eigen::VectorXd share = known ? scenario_shares(objectives) : Eigen::VectorXd();
  std::vector<TermValue> terms;
  for (const ObjectiveTerm& term : case_.plan.objective) {
    TermValue t{term, kNaN, kNaN};
    if (known) {
      t.value = 0.0;
      for (std::size_t i = 0; i < all.size(); ++i)
        if (const double part = share[static_cast<Eigen::Index>(i)]; part > 0.0)
          t.value += part * metric_of(all[i], term.metric);
    }
    t.contribution = term.weight * t.value / term.scale;
    terms.push_back(t);
  }
  return terms;
}

}  // namespace stillhook
