#include "planner/verbs/operability/operability_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "planner/text_number.h"
#include "results/json_number.h"
#include "results/summary_envelope.h"

namespace stillhook {
namespace {

std::string heading_text(double heading) { return fmt::format("{:g}", degrees_of(heading)); }

bool has_flag(const std::vector<std::string>& flags, const char* flag) {
  return std::find(flags.begin(), flags.end(), flag) != flags.end();
}

std::string flags_text(const std::vector<std::string>& flags) {
  std::string text;
  for (std::string flag : flags) {
    std::replace(flag.begin(), flag.end(), '_', ' ');
    text += (text.empty() ? "" : ", ") + flag;
  }
  return text;
}

constexpr const char* kMarks =
    "≥: the limit lies higher; ?: no lower bound at 95 %; !: a run crashed; ~: not monotone; …: incomplete.";

ReportTable place_matrix(const OperabilityStudy& study, std::size_t place, const std::string& title, bool letters) {
  const OperabilityPlan& plan = study.plan();
  ReportTable table{title, kMarks, {"heading, deg"}, {}};
  for (const double tp : plan.peak_periods) table.header.push_back(fmt::format("Tp {:g} s", tp));
  for (std::size_t h = plan.headings.size(); h-- > 0;) {
    std::vector<std::string>& row = table.rows.emplace_back();
    row.push_back(heading_text(plan.headings[h]));
    for (std::size_t p = 0; p < plan.peak_periods.size(); ++p) {
      const std::string letter = criterion_letter(study, study.limit(p, h, place).limit.governing);
      row.push_back(limit_text(study, study.task_at(p, h), place) + (letters && !letter.empty() ? " " + letter : ""));
    }
  }
  return table;
}

/// Criteria that govern the lift or a phase in some condition, in the order of the case.
std::vector<std::string> governing_somewhere(const OperabilityStudy& study) {
  std::vector<std::string> names, used;
  for (const Criterion& criterion : study.plan().criteria) names.push_back(criterion.name);
  names.emplace_back("crashed");
  for (const std::string& name : names)
    for (std::size_t task = 0; task < study.collected.columns.size() && (used.empty() || used.back() != name); ++task) {
      const std::vector<TargetLimit>& targets = study.collected.columns[task].result.targets;
      const auto governs = [&](const TargetLimit& t) { return t.limit.governing == name; };
      const auto end = targets.begin() + static_cast<std::ptrdiff_t>(study.plan().places());
      if (std::any_of(targets.begin(), end, governs)) used.push_back(name);
    }
  return used;
}

struct Extremes {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  std::size_t period = 0, heading = 0;  // of the least
};

Extremes extremes_of(const OperabilityStudy& study) {
  Extremes e;
  for (std::size_t p = 0; p < study.plan().peak_periods.size(); ++p)
    for (std::size_t h = 0; h < study.plan().headings.size(); ++h) {
      const double limit = study.limit(p, h).limit.height;
      if (std::isnan(limit)) continue;
      e.most = std::max(e.most, limit);
      if (limit >= e.least) continue;
      e.least = limit;
      e.period = p;
      e.heading = h;
    }
  return e;
}

/// "rehits in 7 of 12 conditions, offlead_max in 5"
std::string governing_text(const OperabilityStudy& study) {
  std::map<std::string, int> counts;
  int conditions = 0;
  for (const auto& row : study.plan().column_at)
    for (const std::size_t task : row) {
      const std::string& governing = study.collected.columns[task].result.targets[0].limit.governing;
      ++conditions;
      if (!governing.empty()) ++counts[governing];
    }
  std::vector<std::pair<std::string, int>> ordered(counts.begin(), counts.end());
  std::stable_sort(ordered.begin(), ordered.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [criterion, count] : ordered)
    text += text.empty() ? fmt::format("{} governs in {} of {} conditions", criterion, count, conditions)
                         : fmt::format(", {} in {}", criterion, count);
  return text;
}

}  // namespace

std::string operability_verdict(const OperabilityStudy& study) {
  const OperabilityPlan& plan = study.plan();
  const Extremes e = extremes_of(study);
  if (!(e.least < std::numeric_limits<double>::infinity())) return "No limit is known yet: no column has runs enough.";
  const TargetLimit& least = study.limit(e.period, e.heading);
  std::string text =
      fmt::format("Limiting Hs {}{:.2f} m at Tp {:g} s, heading {} deg", least.at_least ? "at least " : "", e.least,
                  plan.peak_periods[e.period], heading_text(plan.headings[e.heading]));
  if (!std::isnan(least.limit.low))
    text += std::isnan(least.limit.high) ? fmt::format(" (at least {:.2f})", least.limit.low)
                                         : fmt::format(" ({:.2f} to {:.2f})", least.limit.low, least.limit.high);
  text += e.most > e.least ? fmt::format(", the lowest; up to {:.2f} m elsewhere.", e.most) : ".";
  if (const std::string governing = governing_text(study); !governing.empty()) text += " " + governing + ".";
  if (!certified(study)) text += " Not every limit is certified.";
  return text;
}

std::string limit_text(const OperabilityStudy& study, std::size_t task, std::size_t place) {
  const TargetLimit& limit = study.collected.columns[task].result.targets[place];
  if (std::isnan(limit.limit.height)) return "-";
  const std::vector<std::string> flags = flags_of(study, task, place);
  std::string text = limit.at_least ? "≥ " : "";
  text += cell(limit.limit.height, 2);
  if (has_flag(flags, "not_certified")) text += "?";
  if (has_flag(flags, "crashed")) text += "!";
  if (has_flag(flags, "not_monotone")) text += "~";
  if (has_flag(flags, "incomplete")) text += "…";
  return text;
}

std::string criterion_letter(const OperabilityStudy& study, const std::string& criterion) {
  const std::vector<std::string> used = governing_somewhere(study);
  const auto at = std::find(used.begin(), used.end(), criterion);
  if (at == used.end()) return {};
  const auto place = at - used.begin();
  std::string letter(1, static_cast<char>('A' + place % 26));
  if (place >= 26) letter += std::to_string(place / 26);
  return letter;
}

std::string letters_text(const OperabilityStudy& study) {
  std::string text;
  for (const std::string& name : governing_somewhere(study))
    text += (text.empty() ? "" : ", ") + criterion_letter(study, name) + " " + name;
  return text;
}

ReportTable limits_matrix(const OperabilityStudy& study) {
  return place_matrix(
      study, 0, fmt::format("Limiting significant wave height, m, at level {:g}", study.plan().rules.level), true);
}

ReportTable phase_matrix(const OperabilityStudy& study, std::size_t place) {
  return place_matrix(study, place, "Phase " + place_name(study.plan(), place) + ", m", true);
}

ReportTable limits_list(const OperabilityStudy& study) {
  ReportTable table{
      "Limits with their intervals",
      "low and high: 95 % bounds by order statistics, free of any distribution. share: of the seeds that break "
      "at or below the limit, those that the criterion breaks.",
      {"Tp, s", "heading, deg", "limit, m", "low", "high", "governing", "share", "seeds", "state"},
      {}};
  for (std::size_t task = 0; task < study.plan().columns.size(); ++task) {
    const OperabilityColumn& column = study.plan().columns[task];
    const ColumnResult& result = study.collected.columns[task].result;
    const LimitingHeight& l = result.targets[0].limit;
    table.rows.push_back({fmt::format("{:g}", column.peak_period), heading_text(column.heading),
                          limit_text(study, task, 0), cell(l.low, 3), cell(l.high, 3), l.governing,
                          cell(l.governing_share, 2), std::to_string(result.seeds),
                          flags_text(flags_of(study, task, 0))});
  }
  return table;
}

ReportTable runs_table(const OperabilityStudy& study) {
  ReportTable table{
      "Runs", "", {"Tp, s", "heading, deg", "seeds", "runs", "crashed", "attempts", "time, s", "a run, s"}, {}};
  for (std::size_t task = 0; task < study.plan().columns.size(); ++task) {
    const OperabilityColumn& column = study.plan().columns[task];
    const CollectedColumn& c = study.collected.columns[task];
    const double runs = static_cast<double>(c.parts.runs.size());
    table.rows.push_back({fmt::format("{:g}", column.peak_period), heading_text(column.heading),
                          std::to_string(c.result.seeds), fmt::format("{:g}", runs), std::to_string(c.result.crashed),
                          std::to_string(c.parts.attempts), cell(c.parts.wall, 1),
                          cell(runs > 0.0 ? c.parts.wall / runs : std::nan(""), 3)});
  }
  return table;
}

ReportTable operability_settings(const OperabilityStudy& study) {
  const OperabilityPlan& plan = study.plan();
  ReportTable table{"Settings", "", {"setting", "value"}, {}};
  const auto add = [&](const std::string& name, const std::string& value) { table.rows.push_back({name, value}); };
  add("sea state that gives the spectrum", plan.sea);
  add("level: share of the seeds that keep the limits", fmt::format("{:g}", plan.rules.level));
  add("looks, seeds", fmt::format("{}", fmt::join(plan.rules.looks, ", ")));
  add("tolerance of the limit, half its interval", fmt::format("{:g}", plan.rules.tolerance));
  add("resolution of a seed's height", fmt::format("{:g}", plan.rules.resolution));
  add("seeds", fmt::format("{} to {}", plan.seed(0), plan.seed(plan.rules.looks.back() - 1)));
  add("phases", plan.phases_alone ? fmt::format("{}, each alone from rest", fmt::join(plan.phases, ", "))
                                  : "the whole operation in one run");
  for (const Criterion& k : plan.criteria)
    if (k.name != kNotCompleted) add(k.metric, fmt::format("{} {:g}", k.is_max ? "at most" : "at least", k.limit));
  add("results, SHA-256", study.collected.results_sha256);
  return table;
}

std::string cost_json(const OperabilityPlan& plan, const CostEstimate& cost) {
  const RunsExpected runs = runs_expected(plan.rules);
  const double tasks = static_cast<double>(plan.columns.size());
  const auto hours = [&](double each) { return json_number(tasks * each * cost.run_s / 3600.0); };
  const auto bytes = [&](double each) { return json_number(tasks * each * static_cast<double>(cost.bytes_a_run)); };
  return summary_text({{"tasks", plan.columns.size()},
                       {"run_s", json_number(cost.run_s)},
                       {"runs_a_task", {runs.least, runs.most}},
                       {"core_hours", {hours(runs.least), hours(runs.most)}},
                       {"bytes", {bytes(runs.least), bytes(runs.most)}}});
}

std::string cost_text(const OperabilityPlan& plan, const CostEstimate& cost) {
  const RunsExpected runs = runs_expected(plan.rules);
  const double tasks = static_cast<double>(plan.columns.size());
  const double least = tasks * runs.least * cost.run_s / 3600.0, most = tasks * runs.most * cost.run_s / 3600.0;
  const double jobs = std::min(static_cast<double>(cost.jobs), tasks * static_cast<double>(plan.rules.looks.front()));
  return fmt::format(
      "{} tasks (periods x headings{}), {:.0f} to {:.0f} runs each\n"
      "one run ({}, Hs {:.2f} m) takes {:.3g} s: {:.3g} to {:.3g} core-hours, {} to {} with {} at once\n"
      "disk: {:.1f} to {:.1f} MB\n",
      plan.columns.size(), plan.headings.size() * plan.peak_periods.size() > plan.columns.size() ? ", mirrored" : "",
      runs.least, runs.most, column_text(cost.column), cost.height, cost.run_s, least, most,
      duration_text(3600.0 * least / jobs), duration_text(3600.0 * most / jobs), cost.jobs,
      tasks * runs.least * static_cast<double>(cost.bytes_a_run) / 1e6,
      tasks * runs.most * static_cast<double>(cost.bytes_a_run) / 1e6);
}

}  // namespace stillhook
