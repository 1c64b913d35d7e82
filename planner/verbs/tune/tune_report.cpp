#include "planner/verbs/tune/tune_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/verbs/plan/plan_results.h"
#include "planner/report_page.h"
#include "planner/version.h"
#include "results/html.h"
#include "results/quantity.h"

namespace stillhook {
namespace {

std::string share(double v) { return std::isnan(v) ? "–" : fmt::format("{:.2f} %", 100.0 * v); }

/// The swing that is damped least, before and after, as a sentence for the first screen; empty if it is not known.
std::string swing_sentence(const GainTuning& result) {
  const auto least = [](const std::vector<SwingMode>& modes) {
    double share = std::numeric_limits<double>::quiet_NaN();
    for (const SwingMode& mode : modes)
      if (!(share <= mode.linear_lines)) share = mode.linear_lines;
    return share;
  };
  const double before = least(result.before), after = least(result.after);
  if (std::isnan(before) || std::isnan(after)) return {};
  return fmt::format("The swing that is damped least has {:.2f} % of critical damping with the tuned gains, {:.2f} % with "
                     "those of the case (linear).",
                     100.0 * after, 100.0 * before);
}

std::string paragraph(const std::string& text) { return text.empty() ? text : "<p>" + escape_html(text) + "</p>"; }

/// Colours of the map from the lowest objective to the highest; a cross where a limit is broken.
std::string map_svg(const Evaluator& evaluator, const GainTuning& result) {
  const GainMap& map = result.map;
  const Eigen::Index n = map.objective.rows();
  if (n < 2) return {};
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (Eigen::Index i = 0; i < map.objective.size(); ++i) {
    const double v = map.objective.data()[i];
    if (std::isnan(v)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  if (!(low <= high)) return "<p>No point of the map could be evaluated, so there is none to draw.</p>";
  const double cell = 400.0 / static_cast<double>(n), left = 70.0, top = 10.0;
  std::string svg = fmt::format(
      "<figure><svg viewBox=\"0 0 560 470\" role=\"img\" style=\"max-width:36rem\"><title>Objective over the "
      "gains</title>");
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const double v = map.objective(i, j);
      const double x = left + cell * static_cast<double>(j), y = top + 400.0 - cell * static_cast<double>(i + 1);
      const double t = high > low ? (v - low) / (high - low) : 0.0;
      const std::string colour =
          std::isnan(v) ? "#ddd" : fmt::format("rgb({:.0f},{:.0f},{:.0f})", 20 + 225 * t, 90 + 140 * t, 150 + 60 * t);
      svg += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>", x, y,
                         cell + 0.3, cell + 0.3, colour);
      if (!std::isnan(v) && map.violation(i, j) > 0.0)
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"9\" text-anchor=\"middle\">×</text>",
                           x + 0.5 * cell, y + 0.5 * cell + 3.0);
    }
  const auto mark = [&](const Eigen::VectorXd& g, const char* label, double below) {
    const double x = left + 400.0 * (g[0] - map.x.front()) / (map.x.back() - map.x.front());
    const double y = top + 400.0 - 400.0 * (g[1] - map.y.front()) / (map.y.back() - map.y.front());
    svg += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" fill=\"white\" stroke=\"black\"/><text x=\"{:.1f}\" y=\"{:.1f}\" "
        "font-size=\"12\" fill=\"white\" stroke=\"black\" stroke-width=\"3\" paint-order=\"stroke\">{}</text>",
        x, y, x + 8.0, y + below, label);
  };
  mark(result.start, "case", 16.0);  // below and above: the points may be close together
  mark(result.gains, "tuned", -6.0);
  const auto& v = evaluator.base().plan.variables;
  svg += fmt::format(
      "<text x=\"{0}\" y=\"428\" font-size=\"12\">{1:.4g}</text><text x=\"{2}\" y=\"428\" font-size=\"12\" "
      "text-anchor=\"end\">{3:.4g}</text><text x=\"270\" y=\"448\" font-size=\"12\" text-anchor=\"middle\">{4}</text>",
      left, map.x.front(), left + 400.0, map.x.back(), escape_html(v[0].key));
  svg += fmt::format(
      "<text x=\"64\" y=\"410\" font-size=\"12\" text-anchor=\"end\">{:.4g}</text><text x=\"64\" y=\"22\" "
      "font-size=\"12\" text-anchor=\"end\">{:.4g}</text><text x=\"18\" y=\"210\" font-size=\"12\" "
      "text-anchor=\"middle\" transform=\"rotate(-90 18 210)\">{}</text>",
      map.y.front(), map.y.back(), escape_html(v[1].key));
  svg += fmt::format(
      "<text x=\"482\" y=\"24\" font-size=\"12\">worst {:.4g}</text><text x=\"482\" y=\"410\" font-size=\"12\">best "
      "{:.4g}</text>",
      high, low);
  return svg +
         "</svg><figcaption>Objective over the first two gains (dark is better); × breaks a "
         "limit.</figcaption></figure>";
}

}  // namespace

std::string tuning_verdict(const GainTuning& result) {
  if (!result.baseline.usable) return "The lift with the gains of the case does not run: " + result.baseline.message;
  if (!result.improved)
    return fmt::format("No gains better than those of the case were found (objective {:.4f}); they stay.",
                       result.baseline.objective);
  const double share = 1.0 - result.tuned.objective / result.baseline.objective;
  return fmt::format("Objective {:.4f} with the tuned gains, {:.4f} with those of the case{}{}.",
                     result.tuned.objective, result.baseline.objective,
                     std::isfinite(share) && result.baseline.objective > 0.0
                         ? fmt::format(": {:.1f} % better", 100.0 * share)
                         : std::string(),
                     result.tuned.violation() > 0.0 ? "; a hard limit is broken with either" : "");
}

std::string tuning_scope(const Evaluator& evaluator) {
  const OperationPart& part = evaluator.base().plan.part;
  if (part.whole()) return {};
  const std::string& phase = evaluator.base().specification.operation.phases[static_cast<std::size_t>(part.phase)].name;
  if (part.hold > 0.0)
    return fmt::format("At rest in the pose that {} ends in, {:.4g} s in the sea.", phase, part.hold);
  return fmt::format("Phase {} alone, begun at rest.", phase);
}

std::string schedule_verdict(const GainTuning& result) {
  if (!result.schedule) return {};
  const GainSchedule& s = *result.schedule;
  if (!s.message.empty()) return "No gain schedule: " + s.message + ".";
  return fmt::format("Gains over the fall length: objective {:.4f} with a schedule, {:.4f} with one pair; {}.",
                     s.evaluation.objective, result.tuned.objective,
                     s.worth_it ? "the schedule is in the tuned case" : "not worth it, the tuned case has one pair");
}

ReportTable schedule_table(const GainTuning& result) {
  ReportTable table{"Gains over the fall length",
                    "Factors on the tuned gains, linear between the two lengths.",
                    {"", "fall, m", "factor on kp", "factor on kd"},
                    {}};
  if (result.schedule)
    for (const GainSchedule::Point& p : result.schedule->points)
      table.rows.push_back({p.name, fmt::format("{:.2f}", p.fall), fmt::format("{:.3f}", p.kp_factor),
                            fmt::format("{:.3f}", p.kd_factor)});
  return table;
}

ReportTable gain_table(const Evaluator& evaluator, const GainTuning& result) {
  ReportTable table{"Gains", "", {"", "case", "tuned", "lower bound", "upper bound"}, {}};
  const auto& variables = evaluator.base().plan.variables;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const Eigen::Index k = static_cast<Eigen::Index>(i);
    table.rows.push_back({variables[i].key, fmt::format("{:.5g}", result.start[k]),
                          fmt::format("{:.5g}", result.gains[k]), fmt::format("{:.5g}", variables[i].lower),
                          fmt::format("{:.5g}", variables[i].upper)});
  }
  return table;
}

ReportTable tuning_objective_table(const Evaluator& evaluator, const GainTuning& result) {
  ReportTable table{"Objective",
                    "Contribution = weight × value / scale.",
                    {"", "case", "tuned", "contribution, case", "contribution, tuned"},
                    {}};
  const std::vector<TermValue> before = evaluator.terms(result.baseline), after = evaluator.terms(result.tuned);
  for (std::size_t i = 0; i < before.size(); ++i)
    table.rows.push_back({before[i].term.metric, fmt::format("{:.5g}", before[i].value),
                          fmt::format("{:.5g}", after[i].value), fmt::format("{:.4f}", before[i].contribution),
                          fmt::format("{:.4f}", after[i].contribution)});
  return table;
}

ReportTable swing_table(const GainTuning& result) {
  ReportTable table{
      "Damping of the swing",
      "Share of critical about the static pose that ends each phase. Linear: from the linearised lift, a line that can "
      "only pull counted with half its gains. Decay: from the decrement of a simulated swing of one degree in calm "
      "water, winch and all; none where the load touches on its way. A stable swing has a positive share.",
      {"", "period, s", "no lines, linear", "no lines, decay", "case, linear", "case, decay", "tuned, linear",
       "tuned, decay"},
      {}};
  for (std::size_t i = 0; i < result.after.size() && i < result.before.size(); ++i) {
    const SwingMode &b = result.before[i], &a = result.after[i];
    table.rows.push_back({a.pose + ", " + a.direction, fmt::format("{:.2f}", a.period), share(b.linear_free),
                          share(b.decay_free), share(b.linear_lines), share(b.decay_lines), share(a.linear_lines),
                          share(a.decay_lines)});
  }
  return table;
}

ReportTable winch_table(const GainTuning& result) {
  ReportTable table{"Winches of the taglines",
                    "At the tuned gains. Wanted: what a winch without limits would do in the worst scenario.",
                    {"", "saturated", "speed, m/min", "wanted, m/min", "pull, t", "wanted, t", "keeps up with what is wanted"},
                    {}};
  for (const WinchDemand& w : result.winches)
    table.rows.push_back({w.line, fmt::format("{:.1f} %", 100.0 * w.saturated),
                          w.speed_limit > 0.0 ? fmt::format("{:.3g}", w.speed_limit / kPerMinute) : "no limit",
                          fmt::format("{:.3g}", w.speed_wanted / kPerMinute),
                          fmt::format("{:.3g}", w.pull_limit / kTonneForce), fmt::format("{:.3g}", w.pull_wanted / kTonneForce),
                          w.too_slow() ? "no, too slow for this sea: no gain can help" : "yes"});
  return table;
}

std::string tuning_report(const Evaluator& evaluator, const GainTuning& result, const DocumentControl& control,
                          const std::vector<std::string>& warnings) {
  const Case& c = evaluator.base();
  ReportPage page;
  page.section("gains", "Gains",
               paragraph(tuning_scope(evaluator)) + table_html(gain_table(evaluator, result)) +
                   table_html(tuning_objective_table(evaluator, result)) + paragraph(schedule_verdict(result)) +
                   (result.schedule ? table_html(schedule_table(result)) : std::string()) + map_svg(evaluator, result));
  page.section("swing", "Damping of the swing", table_html(swing_table(result)));
  page.section("winches", "Winches", table_html(winch_table(result)));
  std::string scenarios = "<ul>";
  for (const ScenarioSpec& s : evaluator.scenarios()) scenarios += "<li>" + escape_html(scenario_text(s)) + "</li>";
  page.section("scenarios", "Scenarios", scenarios + "</ul>");
  const std::string head = fmt::format("<div class=\"verdict {}\">{}</div>",
                                       result.improved && result.tuned.violation() <= 0.0 ? "pass" : "warn",
                                       escape_html(tuning_verdict(result)) + paragraph(swing_sentence(result))) +
                           warnings_html(warnings);
  return page.html("Tagline gains of " + (c.title.empty() ? c.name : c.title), "", head, c.name, control);
}

Summary tuning_summary(const Evaluator& evaluator, const GainTuning& result, double wall) {
  Summary s;
  s.case_name = evaluator.base().name;
  s.verb = "tune";
  s.sea = evaluator.base().specification.sea.active;
  s.program_version = kVersion;
  s.status = result.report.status == SearchStatus::interrupted ? RunStatus::interrupted : RunStatus::completed;
  s.message = tuning_verdict(result);
  s.wall = wall;
  s.limits = deciding_limits(evaluator, result.tuned);
  s.metrics = deciding_metrics(evaluator, result.tuned);
  if (s.status != RunStatus::interrupted) s.status = s.metrics.status;
  s.objective = ObjectiveSummary{result.baseline.objective, result.tuned.objective};
  s.search =
      SearchSummary{result.report.algorithm, result.report.evaluations, result.simulations, evaluator.base().plan.seed};
  const auto& variables = evaluator.base().plan.variables;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const Eigen::Index k = static_cast<Eigen::Index>(i);
    s.variables.push_back({variables[i].key, variables[i].lower, variables[i].upper, result.start[k], result.gains[k]});
  }
  for (const WinchDemand& w : result.winches)
    if (w.too_slow())
      s.warnings.push_back(
          fmt::format("{} is too slow for this sea: it is at its limit for {:.0f} % of the time and would "
                      "need {:.3g} m/min and {:.3g} t",
                      w.line, 100.0 * w.saturated, w.speed_wanted / kPerMinute, w.pull_wanted / kTonneForce));
  return s;
}

}  // namespace stillhook
