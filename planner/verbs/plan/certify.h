// What a plan promises in conditions that its search has not seen, and with which confidence.
//
// Shares of broken limits come with the one-sided 95 % bound of Clopper & Pearson (1934), means and quantiles with
// bootstrap intervals (Efron & Tibshirani 1993) whose resampling is seeded: same runs, same intervals. Plan and baseline
// are run in the same conditions, so their difference is paired: the common sea drops out of it.
#pragma once

#include "planner/verbs/plan/plan.h"
#include "results/report.h"
#include "results/summary.h"

namespace stillhook {

/// A number over the fresh conditions.
struct SampleSummary {
  double mean = 0.0, mean_low = 0.0, mean_high = 0.0;              // and its 90 % bootstrap interval
  double quantile = 0.0, quantile_low = 0.0, quantile_high = 0.0;  // 90 %, and its 90 % interval
  double worst = 0.0;
  int worst_index = 0;  // of the scenario
};

/// Summary of values; NaN values are left out. `larger_is_worse` decides on quantile (90 % or 10 %) and worst.
SampleSummary summarised(const std::vector<double>& values, bool larger_is_worse = true);

struct Certificate {
  struct OfLimit {
    std::string metric, unit;
    double limit = 0.0, allowed = 0.0;  // allowed: share
    bool is_max = true, hard = true;
    int broken = 0, baseline_broken = 0;
    double bound = 1.0;  // upper 95 % of the share
    SampleSummary value;
    bool kept() const { return bound <= allowed || broken == 0; }
  };
  struct OfTerm {
    std::string metric, unit;
    SampleSummary plan, baseline;
  };
  std::vector<ScenarioSpec> scenarios;
  int completed = 0, baseline_completed = 0;
  SampleSummary objective, baseline_objective, improvement;  // improvement: baseline less plan, by condition
  std::vector<OfLimit> limits;
  std::vector<OfTerm> terms;
};

/// Runs the plan x and the baseline in case.plan.certify fresh conditions of each scenario.
Certificate certify(const Evaluator& evaluator, const Eigen::VectorXd& x, const std::atomic<bool>* stop = nullptr);

/// A few lines for the screen.
std::string certificate_text(const Certificate& certificate);

/// For the first screen of a report: in how many conditions which limits are broken.
std::string certificate_sentence(const Certificate& certificate);

/// All runs of the plan completed, and every hard limit broken in no larger share of them than its case allows.
bool keeps_hard_limits(const Certificate& certificate);

CertificateSummary certificate_summary(const Certificate& certificate);

/// What a report says of it.
std::vector<ReportTable> certificate_tables(const Certificate& certificate);

}  // namespace stillhook
