// Baseline against plan: objective term by term, variables in their bounds, limits side by side, convergence.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "results/html.h"
#include "results/report_parts.h"

namespace stillhook {
namespace {

/// `broken`: the change ends outside a limit, which is the only thing that is shown in red.
std::string difference(double before, double after, bool smaller_is_better, bool broken = false) {
  if (!std::isfinite(before) || !std::isfinite(after)) return "–";
  const double change = after - before;
  const bool same = std::abs(change) <= 1e-9 * std::max(std::abs(before), std::abs(after));
  if (same) return "=";
  const bool good = (change < 0.0) == smaller_is_better;
  std::string text = fmt::format("{}{}", change > 0.0 ? "+" : "", readable_number(change, 3));
  if (before != 0.0)
    text += fmt::format(" ({}{} %)", change / std::abs(before) > 0 ? "+" : "",
                        fixed_number(100.0 * change / std::abs(before), 1));
  return fmt::format("<span{}>{} {}</span>",
                     good     ? " class=\"pass\""
                     : broken ? " class=\"fail\""
                              : "",
                     text, good ? "better" : "worse");
}

/// Where a variable stands between its bounds: hollow = baseline, solid = plan.
std::string range_drawing(const SearchSection::Variable& v) {
  if (!(v.upper > v.lower)) return {};
  const auto place = [&](double x) { return 8.0 + 94.0 * std::clamp((x - v.lower) / (v.upper - v.lower), 0.0, 1.0); };
  return fmt::format(
      "<svg class=\"range\" viewBox=\"0 0 110 14\" role=\"img\"><title>between its bounds</title>"
      "<path d=\"M8 3v8M102 3v8M8 7H102\" stroke=\"#7c8894\" fill=\"none\"/>"
      "<circle cx=\"{:.1f}\" cy=\"7\" r=\"4\" fill=\"#fff\" stroke=\"#1c2329\" stroke-width=\"1.5\"/>"
      "<circle cx=\"{:.1f}\" cy=\"7\" r=\"4\" fill=\"#0072b2\"/></svg>",
      place(v.baseline), place(v.plan));
}

/// Best feasible objective after each evaluation.
PlotLine best_so_far(const std::string& label, const std::vector<SearchSection::Point>& history) {
  PlotLine line{label, {}, {}};
  double best = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < history.size(); ++i) {
    if (!line.time.empty()) {  // a step, not a slope, from one evaluation to the next
      line.time.push_back(static_cast<double>(i + 1));
      line.value.push_back(best);
    }
    if (history[i].feasible && std::isfinite(history[i].objective) && !(best <= history[i].objective))
      best = history[i].objective;
    line.time.push_back(static_cast<double>(i + 1));
    line.value.push_back(best);
  }
  return line;
}

std::string convergence_plot(const SearchSection& search) {
  if (search.history.empty() && search.random_history.empty()) return {};
  const auto within = [](const std::vector<SearchSection::Point>& points) {
    return std::any_of(points.begin(), points.end(), [](auto& p) { return p.feasible && std::isfinite(p.objective); });
  };
  if (!within(search.history) && !within(search.random_history))
    return "<p>No evaluation was within the limits, so there is no curve of the best one to draw.</p>";
  Plot plot;
  plot.title = "Convergence: best objective within the limits so far";
  plot.x_label = "evaluation";
  plot.y_label = "objective";
  plot.lines = {best_so_far("search", search.history)};
  if (!search.random_history.empty()) plot.lines.push_back(best_so_far("random search", search.random_history));
  if (std::isfinite(search.baseline_objective)) plot.limits.push_back({"baseline", search.baseline_objective});
  return "<figure><div class=\"scroll\" tabindex=\"0\">" + draw_plot(plot) + "</div></figure>";
}

std::string objective_table(const SearchSection& search) {
  std::vector<std::vector<std::string>> rows;
  for (const SearchSection::Term& t : search.terms) {
    const Shown before = show_metric(t.metric, t.baseline_value), after = show_metric(t.metric, t.plan_value);
    rows.push_back(
        {escape_html(t.metric) + (after.unit.empty() ? "" : ", " + after.unit), before.value, after.value,
         readable_number(t.weight), readable_number(t.scale), readable_number(t.baseline_contribution),
         readable_number(t.plan_contribution),
         difference(t.baseline_contribution, t.plan_contribution, t.weight >= 0.0 || t.baseline_contribution < 0.0)});
  }
  rows.push_back({"<b>objective</b>", "", "", "", "", "<b>" + readable_number(search.baseline_objective) + "</b>",
                  "<b>" + readable_number(search.plan_objective) + "</b>",
                  difference(search.baseline_objective, search.plan_objective, true)});
  return html_table({"term", "value, baseline", "value, plan", "weight", "scale", "contribution, baseline",
                     "contribution, plan", "change"},
                    rows);
}

std::string limits_table(const SearchSection& search) {
  std::vector<std::vector<std::string>> rows;
  const auto verdict = [](const LimitCheck& c) {
    return c.pass ? std::string("<span class=\"pass\">✓</span> ") : std::string("<span class=\"fail\">✗</span> ");
  };
  for (std::size_t i = 0; i < search.plan_limits.size() && i < search.baseline_limits.size(); ++i) {
    const LimitCheck& before = search.baseline_limits[i];
    const LimitCheck& after = search.plan_limits[i];
    const std::string unit = show_metric(after.metric, after.limit).unit;
    rows.push_back({escape_html(after.metric) + (unit.empty() ? "" : ", " + unit) +
                        (after.scenario.empty() ? "" : " <small>(" + escape_html(after.scenario) + ")</small>"),
                    (after.is_max ? "≤ " : "≥ ") + show_metric(after.metric, after.limit).value,
                    verdict(before) + show_metric(before.metric, before.value).value,
                    verdict(after) + show_metric(after.metric, after.value).value,
                    difference(before.value, after.value, after.is_max, !after.pass)});
  }
  if (rows.empty()) return {};
  return "<h3>Limits</h3>" + html_table({"criterion", "limit", "baseline", "plan", "change"}, rows);
}

std::string outcome(const char* name, double objective, bool feasible) {
  return fmt::format("<div class=\"tile\"><b>{}</b><div>{}: {}</div></div>", readable_number(objective), name,
                     !std::isfinite(objective) ? "none"
                     : feasible                ? "within the limits"
                                               : "<span class=\"fail\">outside the limits</span>");
}

}  // namespace

std::string search_part(const SearchSection& search) {
  std::string out = "<div class=\"tiles\">" +
                    outcome("objective, baseline", search.baseline_objective, search.baseline_feasible) +
                    outcome("objective, plan", search.plan_objective, search.plan_feasible) +
                    (search.random_history.empty()
                         ? std::string()
                         : outcome("objective, random search", search.random_objective, search.random_feasible)) +
                    "</div>";
  out += fmt::format("<p>{}; {} evaluations, {} simulations' worth of work, seed {}{}. {}</p>",
                     escape_html(search.algorithm), search.evaluations, fixed_number(search.simulation_equivalents, 0),
                     search.seed,
                     std::isfinite(search.wall) ? ", " + clock_time(search.wall) + " of computing (h:min:s)" : "",
                     escape_html(search.status));
  if (!search.scenarios.empty()) {
    out += "<p>Evaluated in:</p><ul>";
    for (const std::string& s : search.scenarios) out += "<li>" + escape_html(s) + "</li>";
    out += "</ul>";
  }
  out += "<h3>Objective, term by term</h3>" + objective_table(search) + limits_table(search);
  std::vector<std::vector<std::string>> rows;
  for (const SearchSection::Variable& v : search.variables)
    rows.push_back({escape_html(v.key), readable_number(v.lower), readable_number(v.upper), readable_number(v.baseline),
                    readable_number(v.plan), range_drawing(v)});
  if (!rows.empty())
    out +=
        "<h3>Design variables</h3>" + html_table({"case key", "lowest", "highest", "baseline ○", "plan ●", ""}, rows);
  out += convergence_plot(search);
  if (search.sensitivities) out += sensitivity_part(*search.sensitivities);
  if (search.pareto) out += pareto_part(*search.pareto);
  return out;
}

}  // namespace stillhook
