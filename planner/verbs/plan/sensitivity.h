// What a plan hangs on: the slope of every metric of its problem by every variable, and what its limits cost.
//
// The price of a limit is its Lagrange multiplier (problems/search/multipliers.h): loosening limit i by one unit of its
// metric lowers the objective by m_i / scale_i.
#pragma once

#include "planner/verbs/plan/plan.h"
#include "results/report.h"

namespace stillhook {

struct PlanSensitivities {
  std::vector<std::string> metrics, units;  // rows of `slope`
  Eigen::MatrixXd slope;                    // metric's unit per unit of the key, mean over the scenarios
  Eigen::VectorXd objective;                // gradient of the smooth objective
  struct Price {
    std::string metric, unit;
    double per_unit = 0.0;  // fall of the objective for a limit looser by one unit
  };
  std::vector<Price> prices;  // of limits that are active
  double residual = 0.0;      // of the conditions of optimality, over the gradient
  bool valid = false;
};

/// At x, a column each variable of the evaluator's problem.
PlanSensitivities plan_sensitivities(const Evaluator& evaluator, const Eigen::VectorXd& x);

/// How the metrics change with the variables, and what the limits cost: for a report.
SensitivityTable sensitivity_table(const Evaluator& evaluator, const PlanSensitivities& sensitivities);
ReportTable price_table(const PlanSensitivities& sensitivities);

}  // namespace stillhook
