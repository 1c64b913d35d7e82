#include "planner/verbs/plan/certify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/verbs/plan/plan_results.h"
#include "problems/scenarios.h"
#include "results/statistics/binomial.h"
#include "results/statistics/sample.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

/// 90 % interval of a statistic of the values by resampling.
template <class F>
Interval bootstrap(const std::vector<double>& values, F statistic) {
  std::vector<double> sample(values.size());
  return bootstrap_interval(values.size(), [&](const std::vector<std::size_t>& drawn) {
    for (std::size_t i = 0; i < drawn.size(); ++i) sample[i] = values[drawn[i]];
    return statistic(sample);
  });
}

struct Runs {
  std::vector<ScenarioOutcome> plan, baseline;
};

std::vector<double> objectives(const Evaluator& fresh, const std::vector<ScenarioOutcome>& outcomes) {
  std::vector<double> values;
  for (const ScenarioOutcome& outcome : outcomes)
    values.push_back(outcome.status == RunStatus::completed ? fresh.objective_of(outcome) : kNaN);
  return values;
}

int completed(const std::vector<ScenarioOutcome>& outcomes) {
  return static_cast<int>(std::count_if(outcomes.begin(), outcomes.end(),
                                        [](const ScenarioOutcome& o) { return o.status == RunStatus::completed; }));
}

void judge_limits(const Evaluator& fresh, const Runs& runs, Certificate& certificate) {
  std::vector<std::vector<LimitCheck>> checks, before;
  for (const ScenarioOutcome& o : runs.plan) checks.push_back(limits_of(fresh, o));
  for (const ScenarioOutcome& o : runs.baseline) before.push_back(limits_of(fresh, o));
  if (checks.empty()) return;
  for (std::size_t i = 0; i < checks.front().size(); ++i) {
    const LimitCheck& first = checks.front()[i];
    Certificate::OfLimit limit;
    limit.metric = first.metric;
    limit.unit = unit_of_metric(first.metric);
    limit.limit = first.limit;
    limit.is_max = first.is_max;
    limit.hard = first.hard;
    for (const LimitSpec& spec : fresh.base().limits)
      if (spec.metric == first.metric) limit.allowed = spec.share;
    std::vector<double> values;
    for (std::size_t s = 0; s < checks.size(); ++s) {
      limit.broken += checks[s][i].pass ? 0 : 1;
      limit.baseline_broken += before[s][i].pass ? 0 : 1;
      values.push_back(checks[s][i].value);
    }
    limit.bound = broken_share_bound(limit.broken, static_cast<int>(checks.size()));
    limit.value = summarised(values, limit.is_max);
    certificate.limits.push_back(limit);
  }
}

}  // namespace

SampleSummary summarised(const std::vector<double>& values, bool larger_is_worse) {
  SampleSummary s;
  std::vector<double> known;
  s.worst = kNaN;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    known.push_back(values[i]);
    if (std::isnan(s.worst) || (larger_is_worse ? values[i] > s.worst : values[i] < s.worst)) {
      s.worst = values[i];
      s.worst_index = static_cast<int>(i);
    }
  }
  const double q = larger_is_worse ? 0.9 : 0.1;
  s.mean = mean_of(known);
  s.quantile = quantile_of(known, q);
  const Interval mean = bootstrap(known, mean_of);
  const Interval quantile = bootstrap(known, [q](const std::vector<double>& v) { return quantile_of(v, q); });
  s.mean_low = mean.low;
  s.mean_high = mean.high;
  s.quantile_low = quantile.low;
  s.quantile_high = quantile.high;
  return s;
}

Certificate certify(const Evaluator& evaluator, const Eigen::VectorXd& x, const std::atomic<bool>* stop) {
  Certificate certificate;
  certificate.scenarios = fresh_scenarios(evaluator.base(), evaluator.base().plan.certify);
  const Evaluator fresh(evaluator.base(), certificate.scenarios, stop);
  const Runs runs{fresh.outcomes(fresh.evaluate(x)), fresh.outcomes(fresh.evaluate(fresh.baseline()))};
  certificate.completed = completed(runs.plan);
  certificate.baseline_completed = completed(runs.baseline);
  const std::vector<double> plan = objectives(fresh, runs.plan), baseline = objectives(fresh, runs.baseline);
  std::vector<double> difference;
  for (std::size_t i = 0; i < plan.size(); ++i) difference.push_back(baseline[i] - plan[i]);
  certificate.objective = summarised(plan);
  certificate.baseline_objective = summarised(baseline);
  certificate.improvement = summarised(difference, false);
  for (const ObjectiveTerm& term : evaluator.base().plan.objective) {
    std::vector<double> of_plan, of_baseline;
    for (std::size_t i = 0; i < runs.plan.size(); ++i) {
      of_plan.push_back(fresh.metric_of(runs.plan[i], term.metric));
      of_baseline.push_back(fresh.metric_of(runs.baseline[i], term.metric));
    }
    certificate.terms.push_back({term.metric, unit_of_metric(term.metric), summarised(of_plan), summarised(of_baseline)});
  }
  judge_limits(fresh, runs, certificate);
  return certificate;
}

std::string certificate_text(const Certificate& c) {
  std::string text = fmt::format(
      "In {} fresh conditions: objective {:.4f}, 90 % quantile {:.4f} (baseline {:.4f}, {:.4f}); paired improvement "
      "{:.4f} "
      "({:.4f} to {:.4f}).",
      c.scenarios.size(), c.objective.mean, c.objective.quantile, c.baseline_objective.mean,
      c.baseline_objective.quantile, c.improvement.mean, c.improvement.mean_low, c.improvement.mean_high);
  for (const Certificate::OfLimit& l : c.limits)
    if (l.broken > 0)
      text +=
          fmt::format("\n  {} {} {:.4g} is broken in {} of them (at most {:.1f} % at 95 % confidence; baseline {}).",
                      l.metric, l.is_max ? "<=" : ">=", l.limit, l.broken, 100.0 * l.bound, l.baseline_broken);
  return text;
}

std::string certificate_sentence(const Certificate& c) {
  const std::size_t tried = c.scenarios.size();
  std::string broken;
  for (const Certificate::OfLimit& l : c.limits)
    if (l.broken > 0)
      broken += fmt::format("{}{} in {} (at most {:.0f} % of such conditions, at 95 % confidence)",
                            broken.empty() ? "" : "; ", l.metric, l.broken, 100.0 * l.bound);
  std::string text = fmt::format("In {} fresh conditions that the search has not seen, the plan ", tried);
  if (c.completed < static_cast<int>(tried))
    text += fmt::format("runs to its end in {} only; of those it ", c.completed);
  if (!broken.empty()) return text + "breaks " + broken + ".";
  return text + fmt::format(
                    "breaks no limit: with that many, a limit may still be broken in up to {:.0f} % of such "
                    "conditions, at 95 % confidence.",
                    100.0 * broken_share_bound(0, c.completed));
}

bool keeps_hard_limits(const Certificate& c) {
  return c.completed == static_cast<int>(c.scenarios.size()) &&
         std::all_of(c.limits.begin(), c.limits.end(), [&](const Certificate::OfLimit& l) {
           return !l.hard || l.broken <= l.allowed * static_cast<double>(c.scenarios.size());
         });
}

CertificateSummary certificate_summary(const Certificate& c) {
  const auto mean = [](const SampleSummary& s) { return MeanSummary{s.mean, s.mean_low, s.mean_high}; };
  CertificateSummary summary;
  summary.conditions = static_cast<int>(c.scenarios.size());
  summary.completed = c.completed;
  summary.baseline_completed = c.baseline_completed;
  summary.plan = mean(c.objective);
  summary.baseline = mean(c.baseline_objective);
  summary.improvement = mean(c.improvement);
  for (const Certificate::OfTerm& t : c.terms)
    summary.terms.push_back({t.metric, t.unit, mean(t.plan), mean(t.baseline)});
  for (const Certificate::OfLimit& l : c.limits)
    summary.limits.push_back({l.metric, l.broken, l.baseline_broken, l.bound, l.allowed});
  return summary;
}

std::vector<ReportTable> certificate_tables(const Certificate& c) {
  const auto interval = [](double v, double low, double high) {
    return fmt::format("{:.4g} ({:.4g} to {:.4g})", v, low, high);
  };
  ReportTable values{
      "In conditions the search has not seen",
      fmt::format("{} fresh conditions, plan and baseline in each; {} and {} runs were completed. Means and "
                  "90 % quantiles with 90 % bootstrap intervals.",
                  c.scenarios.size(), c.completed, c.baseline_completed),
      {"", "plan, mean", "plan, 90 %", "baseline, mean", "baseline, 90 %", "worst condition"},
      {}};
  const auto row = [&](const std::string& name, const SampleSummary& p, const SampleSummary& b) {
    values.rows.push_back(
        {name, interval(p.mean, p.mean_low, p.mean_high), interval(p.quantile, p.quantile_low, p.quantile_high),
         interval(b.mean, b.mean_low, b.mean_high), interval(b.quantile, b.quantile_low, b.quantile_high),
         c.scenarios.empty() ? "" : c.scenarios[static_cast<std::size_t>(p.worst_index)].name});
  };
  row("objective", c.objective, c.baseline_objective);
  for (const Certificate::OfTerm& t : c.terms)
    row(t.unit == "1" || t.unit.empty() ? t.metric : t.metric + ", " + t.unit, t.plan, t.baseline);
  values.rows.push_back({"improvement of the objective (paired)",
                         interval(c.improvement.mean, c.improvement.mean_low, c.improvement.mean_high), "", "", "",
                         ""});

  ReportTable limits{"Limits in conditions the search has not seen",
                     "The bound is the largest share of such conditions that may break the limit, at 95 % confidence "
                     "(Clopper-Pearson).",
                     {"", "limit", "broken by the plan", "share at most", "allowed", "broken by the baseline", "worst"},
                     {}};
  for (const Certificate::OfLimit& l : c.limits)
    limits.rows.push_back({l.metric,
                           fmt::format("{} {:.4g} {}", l.is_max ? "≤" : "≥", l.limit, l.unit == "1" ? "" : l.unit),
                           fmt::format("{} of {}", l.broken, c.scenarios.size()),
                           fmt::format("{:.1f} %", 100.0 * l.bound), fmt::format("{:.1f} %", 100.0 * l.allowed),
                           fmt::format("{}", l.baseline_broken), fmt::format("{:.4g}", l.value.worst)});
  return {values, limits};
}

}  // namespace stillhook
