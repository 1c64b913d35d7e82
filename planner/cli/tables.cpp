#include "planner/cli/tables.h"

#include <fmt/format.h>

#include <cmath>

#include "planner/cli/colour.h"
#include "planner/cli/text_table.h"
#include "planner/text_number.h"

namespace stillhook {
namespace {

std::string verdict(const LimitCheck& check) {
  if (check.pass) return coloured(Colour::good, "ok");
  return check.hard ? coloured(Colour::bad, "FAIL") : coloured(Colour::caution, "warning");
}

std::string yes_no(bool feasible) { return feasible ? coloured(Colour::good, "yes") : coloured(Colour::bad, "no"); }

/// A pure number has no unit to show.
std::string unit_text(const std::string& unit) { return unit == "1" ? "" : unit; }

/// "daf_total (largest total hook load over static)"
std::string metric_text(const std::string& name) {
  const MetricDefinition* definition = metric_definition(name);
  return definition ? name + " (" + definition->description + ")" : name;
}

std::string terms_text(const SearchSection& s) {
  TextTable table({"term", "unit", "weight / scale", "baseline", "plan", "baseline part", "plan part"});
  for (const SearchSection::Term& t : s.terms)
    table.add({t.metric, unit_text(t.unit), fmt::format("{:g} / {:g}", t.weight, t.scale),
               short_number(t.baseline_value), short_number(t.plan_value), cell(t.baseline_contribution, 4),
               cell(t.plan_contribution, 4)});
  table.add({"objective", "", "", "", "", cell(s.baseline_objective, 4), cell(s.plan_objective, 4)});
  return "Objective: the weighted sum of its terms, over the scenarios as plan.aggregate says\n" + table.text();
}

std::string comparison_text(const SearchSection& s) {
  TextTable table({"", "objective", "within limits"});
  const auto add = [&](const char* name, double objective, bool feasible) {
    table.add({name, cell(objective, 4), yes_no(feasible)});
  };
  add("baseline", s.baseline_objective, s.baseline_feasible);
  add("plan", s.plan_objective, s.plan_feasible);
  const bool compared = !s.random_history.empty();
  if (compared) add("random search", s.random_objective, s.random_feasible);
  return fmt::format("After {} evaluations ({}; {:g} simulations){}\n{}", s.evaluations, s.algorithm,
                     s.simulation_equivalents, compared ? ", random search with as many" : "", table.text());
}

std::string variables_text(const SearchSection& s) {
  TextTable table({"variable", "from", "to", "baseline", "plan"});
  for (const SearchSection::Variable& v : s.variables)
    table.add({v.key, short_number(v.lower), short_number(v.upper), short_number(v.baseline), short_number(v.plan)});
  return "Variables, in the unit of their key\n" + table.text();
}

std::string limits_comparison_text(const SearchSection& s) {
  const bool several = s.scenarios.size() > 1;
  TextTable table(several ? std::vector<std::string>{"limit", "unit", "bound", "baseline", "", "plan", "", "decided in"}
                          : std::vector<std::string>{"limit", "unit", "bound", "baseline", "", "plan", ""});
  for (std::size_t i = 0; i < s.plan_limits.size() && i < s.baseline_limits.size(); ++i) {
    const LimitCheck &before = s.baseline_limits[i], &after = s.plan_limits[i];
    std::vector<std::string> row = {after.metric,
                                    unit_text(after.unit),
                                    fmt::format("{} {:g}", after.is_max ? "<=" : ">=", after.limit),
                                    short_number(before.value),
                                    verdict(before),
                                    short_number(after.value),
                                    verdict(after)};
    if (several) row.push_back(after.scenario);
    table.add(row);
  }
  if (table.empty()) return "";
  return (several ? "Limits, each in the scenario that decides whether it is kept\n" : "Limits\n") + table.text();
}

}  // namespace

std::string table_text(const ReportTable& table) {
  TextTable text(table.header);
  for (const std::vector<std::string>& row : table.rows) text.add(row);
  return table.title + "\n" + text.text() + (table.note.empty() ? "" : "  " + table.note + "\n");
}

std::string metrics_text(const Metrics& metrics) {
  TextTable table({"metric", "value", "unit", "time s", "phase"});
  for (const Metric& m : metrics.items) {
    const MetricDefinition* definition = metric_definition(m.name);
    if (definition && definition->element != MetricElement::none) continue;
    if (m.name == "event_timeouts" && m.value == 0.0) continue;  // no event was waited for in vain: nothing to tell
    table.add({m.name, short_number(m.value), unit_text(m.unit), cell(m.time, 1), m.phase});
  }
  return "Metrics\n" + table.text();
}

std::string limits_text(const std::vector<LimitCheck>& limits) {
  if (limits.empty()) return "The case has no limits.\n";
  TextTable table({"limit", "unit", "bound", "value", "margin", "verdict", "time s", "phase"});
  for (const LimitCheck& c : limits)
    table.add({c.metric, unit_text(c.unit), fmt::format("{} {:g}", c.is_max ? "<=" : ">=", c.limit),
               short_number(c.value), short_number(c.margin), verdict(c), cell(c.time, 1), c.phase});
  return "Limits\n" + table.text();
}

std::string verdict_text(const Metrics& metrics, const std::vector<LimitCheck>& limits) {
  if (metrics.status == RunStatus::failed) return coloured(Colour::bad, "FAILED") + ": " + metrics.message;
  if (limits.empty()) return "No limits to keep.";
  const LimitCheck* governing = governing_check(limits);
  const std::string unit = governing->unit == "1" ? "" : " " + governing->unit;
  const std::string value = std::isfinite(governing->value) ? short_number(governing->value) + unit : "no value";
  const std::string use = limit_use_text(*governing);
  const std::string by = fmt::format(", governed by {}: {}, limit {}{}{}", metric_text(governing->metric), value,
                                     short_number(governing->limit), unit, use.empty() ? "" : " (" + use + ")");
  if (metrics.status != RunStatus::completed) return coloured(Colour::bad, "NOT COMPLETED") + by;
  return (within_limits(metrics, limits) ? coloured(Colour::good, "WITHIN LIMITS")
                                         : coloured(Colour::bad, "NOT WITHIN LIMITS")) +
         by;
}

std::string search_text(const SearchSection& s) {
  std::string text = terms_text(s) + "\n" + comparison_text(s) + "\n" + variables_text(s);
  const std::string limits = limits_comparison_text(s);
  return limits.empty() ? text : text + "\n" + limits;
}

}  // namespace stillhook
