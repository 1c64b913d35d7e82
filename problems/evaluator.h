// From a case to a problem in the solver's terms:
//
//   minimise    f(x) = aggregate over scenarios s of  sum_k weight_k metric_k(x, s) / scale_k
//   subject to  g_i(x) = max over scenarios s of  (value_i(x, s) - limit_i) / scale_i  <= 0     hard limits only
//               (a limit that may be broken in a share of the scenarios: the largest value but that share)
//   over        x = the case keys of [plan.variables], in their own units, within their bounds
//
// A minimum is the limit of the negative value. scale_i is |limit_i|, or one step of the metric's unit if that is zero.
//
// A run that cannot be completed is graded, not thrown: with r in [0, 1] the share of the operation that ran (mean over
// scenarios, 0 if the lift could not even be built: goal out of reach, speed limit), f = 1000 (2 - r) and every g = 2 -
// r.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "problems/case.h"
#include "problems/search/problem.h"
#include "results/metrics.h"
#include "results/smooth_metrics.h"
#include "sim/operation.h"

namespace stillhook {

/// What a point with gradient is charged, in simulations (docs/performance.md).
inline constexpr double kGradientCharge = 3.0;

/// What one scenario gave.
struct ScenarioOutcome {
  RunStatus status = RunStatus::not_run;  // not_run: the lift could not be built
  double reached = 0.0;                   // share of the operation that ran, 0 to 1
  std::vector<double> metrics;            // by Evaluator::metric_names(), NaN where there is none
  std::string message;                    // why not completed
};

/// One term of the objective, aggregated over the scenarios as the objective is.
struct TermValue {
  ObjectiveTerm term;
  double value = 0.0;         // of the metric, in its unit
  double contribution = 0.0;  // weight * value / scale
};

/// One hard limit and its constraint.
struct ConstraintSpec {
  std::string metric;
  double limit = 0.0, scale = 1.0;  // in the metric's unit
  bool is_max = true;
  double share = 0.0;  // of the scenarios' weight that may break it
};

/// Derivatives of the smooth metrics of a problem: rows as named, a column each variable, mean over the scenarios.
struct SmoothSlopes {
  std::vector<std::string> metrics;
  Eigen::MatrixXd slope;
};

class Evaluator {
 public:
  /// Throws CaseError when the plan has no objective, no variable, a baseline outside its bounds or a scenario that
  /// does not exist. `stop`, when set from outside, interrupts the evaluations under way; it must outlive the
  /// evaluator.
  explicit Evaluator(Case c, const std::atomic<bool>* stop = nullptr);
  /// The same in other conditions than the case's scenarios.
  Evaluator(Case c, std::vector<ScenarioSpec> scenarios, const std::atomic<bool>* stop);

  const Case& base() const { return case_; }
  const std::vector<ScenarioSpec>& scenarios() const { return scenarios_; }
  const std::vector<ConstraintSpec>& constraints() const { return constraints_; }
  const std::vector<std::string>& metric_names() const { return metric_names_; }
  /// The variables as they stand in the case.
  const Eigen::VectorXd& baseline() const { return baseline_; }

  /// The case with its variables at x. Throws CaseError when the case refuses these values.
  Case case_at(const Eigen::VectorXd& x) const;

  /// Runs every scenario, in parallel when not already in a parallel region; may be called from several threads at
  /// once. The result does not depend on the number of threads. Throws only for a fault of the program.
  Evaluation evaluate(const Eigen::VectorXd& x) const;

  /// The same with smooth counterparts of the metrics (smooth_metrics.h) in objective and constraints, and with their
  /// exact derivatives when `gradient`. `details` holds the metrics as they are.
  Evaluation evaluate_smooth(const Eigen::VectorXd& x, const SmoothOptions& smooth, bool gradient,
                             SmoothSlopes* slopes = nullptr) const;
  /// The smooth problem; it refers to this evaluator, which must outlive it.
  SearchProblem smooth_problem(const SmoothOptions& smooth) const;

  /// The problem; it refers to this evaluator, which must outlive it.
  SearchProblem problem() const;

  /// What `details` of an evaluation holds, by scenario.
  std::vector<ScenarioOutcome> outcomes(const Evaluation& evaluation) const;
  /// The objective term by term. Under `worst` the terms of the worst scenario; values NaN if it is not usable.
  std::vector<TermValue> terms(const Evaluation& evaluation) const;

  /// Of one scenario: the objective, and a metric by name (NaN if there is none).
  double objective_of(const ScenarioOutcome& outcome) const;
  double metric_of(const ScenarioOutcome& outcome, const std::string& name) const;

  /// The scenario that decides whether a limit is kept that may be broken in a share of the scenarios' weight, given by
  /// how much each exceeds it: the largest excess but that share.
  std::size_t deciding(double share, const std::vector<double>& excess) const;

  /// How close a scenario comes to its hard limits: the largest scaled constraint; without hard limits its objective.
  double closeness(const ScenarioOutcome& outcome) const;

  /// Objective, constraints and grade from the outcomes of all scenarios: the pure part of evaluate().
  Evaluation aggregated(const std::vector<ScenarioOutcome>& outcomes) const;

 private:
  /// What a scenario's smooth metrics are, and their derivatives: rows as in smooth_names_, a column each variable.
  struct SmoothOutcome {
    ScenarioOutcome outcome;
    Eigen::VectorXd value;
    Eigen::MatrixXd slope;
    bool valid = false;  // the derivatives
  };
  SmoothOutcome run_smooth(const Case& c, const ScenarioSpec& scenario, const SmoothOptions& smooth,
                           bool gradient) const;
  Eigen::VectorXd smooth_values(const Trajectory& run, const SmoothOptions& smooth) const;
  Evaluation aggregated_smooth(const std::vector<SmoothOutcome>& outcomes, bool gradient) const;
  void note_run(const Specification& specification, const Trajectory& run, double planned,
                ScenarioOutcome& outcome) const;

  /// A scenario's lift: what it is simulated as, and with which numbers it is judged.
  struct Lift {
    std::shared_ptr<const Model> model;
    Operation operation;
    Specification specification;
  };
  struct Bases;  // of the scenarios, with the variables as they stand in the case; each built when it is first needed
  /// Where the variables change timing alone, the base's model and poses are taken over.
  Lift lift_of(const Case& c, std::size_t scenario) const;
  ScenarioOutcome run_scenario(const Case& c, std::size_t scenario) const;
  /// How much each scenario counts in the aggregated objective; they sum to one.
  Eigen::VectorXd scenario_shares(const Eigen::VectorXd& objectives) const;
  double constraint_of(const ScenarioOutcome& outcome, const ConstraintSpec& constraint) const;

  Case case_;
  const std::atomic<bool>* stop_;
  std::vector<ScenarioSpec> scenarios_;
  std::vector<ConstraintSpec> constraints_;
  std::vector<std::string> metric_names_;
  std::vector<std::string> smooth_names_;  // metrics of the objective's terms, then of the constraints
  Eigen::VectorXd baseline_;
  std::shared_ptr<Bases> bases_;
};

/// The size that makes a violation comparable with others: |limit|, or one step of the unit if that is zero.
double limit_scale(double limit, Quantity quantity);

}  // namespace stillhook
