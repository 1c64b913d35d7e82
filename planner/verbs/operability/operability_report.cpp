#include "planner/verbs/operability/operability_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/report_page.h"
#include "planner/verbs/operability/operability_tables.h"
#include "problems/case_sources.h"
#include "results/html.h"

namespace stillhook {
namespace {

std::string limits_figure(const std::string& svg) {
  return svg.empty() ? "" : "<figure><div class=\"scroll\" tabindex=\"0\">" + svg + "</div></figure>";
}

std::string without_title(ReportTable table) {
  table.title.clear();
  return table_html(table);
}

std::string prose(const std::string& text) { return text.empty() ? "" : "<p>" + escape_html(text) + "</p>"; }

/// The column with the lowest limit.
std::size_t lowest_column(const OperabilityStudy& study) {
  std::size_t lowest = 0;
  double least = 1e300;
  for (std::size_t task = 0; task < study.collected.columns.size(); ++task) {
    const double limit = study.collected.columns[task].result.targets[0].limit.height;
    if (limit < least) {
      least = limit;
      lowest = task;
    }
  }
  return lowest;
}

/// The seed that breaks first in the column with the lowest limit, as a run that can be looked at.
std::string worst_run(const OperabilityStudy& study, std::size_t task) {
  const OperabilityPlan& plan = study.plan();
  const std::vector<SeedBracket>& seeds = study.collected.columns[task].result.targets[0].seeds;
  const auto first = std::min_element(seeds.begin(), seeds.end(),
                                      [](const SeedBracket& a, const SeedBracket& b) { return a.high < b.high; });
  if (first == seeds.end() || !first->found() || plan.phases_alone) return {};
  const OperabilityColumn& column = plan.columns[task];
  const std::string state = "sea.states." + plan.sea;
  const std::string command = fmt::format(
      "stillhook simulate case.toml --set sea.active={0} --set {1}.significant_height_m={2} --set "
      "{1}.peak_period_s={3} "
      "--set {1}.heading_deg={4} --set {1}.seed={5} --out worst",
      plan.sea, state, first->high, column.peak_period, degrees_of(column.heading),
      plan.seed(static_cast<int>(first - seeds.begin())));
  return "<p>The seed that breaks first in " + escape_html(column_text(column)) +
         ", as a run of its own, in this folder:</p><pre>" + escape_html(command) + "</pre>";
}

std::string bullet_list(const std::vector<std::string>& items) {
  std::string out;
  for (const std::string& item : items) out += "<li>" + escape_html(item) + "</li>";
  return out.empty() ? "" : "<ul>" + out + "</ul>";
}

constexpr const char* kMethod =
    "<p>Every seed has a height at which its run first breaks a hard limit or does not complete. The same seed draws "
    "the "
    "same phases at every height, so that this height has no noise; it is found by root-finding. The limit at a level "
    "of "
    "0.90 is the height below which 10 % of the seeds break. Its 95 % bounds are order statistics, free of any "
    "distribution; the search ends when they are close enough, never because the limit is good enough. Seeds that "
    "cannot "
    "decide the limit are not refined. All columns use the same seeds, which no search for a plan has seen.</p>";

}  // namespace

std::string operability_report(const OperabilityStudy& study, const std::vector<std::string>& files,
                               const DocumentControl& control) {
  ReportPage page;
  const OperabilityPlan& plan = study.plan();
  const std::string letters = prose(letters_text(study));
  page.section("limits", "Limits",
               limits_figure(limits_drawing(study, 0)) + letters + without_title(limits_list(study)));
  page.section("headings", "By heading", limits_figure(polar_drawing(study)));
  page.section("periods", "By period", limits_figure(limit_curves(study)));
  std::string phases;
  for (std::size_t place = 1; place < plan.places() && plan.phases.size() > 1; ++place)
    phases += limits_figure(limits_drawing(study, place));
  if (!phases.empty() && !plan.rules.every_target)
    phases = prose(
                 "Heights were refined for the whole lift alone: those of a phase are known to be kept (≥). "
                 "operability.criteria = \"all\" refines them.") +
             phases + letters;
  page.section("phases", "By phase", phases);
  const std::size_t lowest = lowest_column(study);
  page.section("statistics", "Seeds", limits_figure(broken_share_drawing(study, lowest)) + worst_run(study, lowest));
  page.section("method", "Method", kMethod);
  page.section("basis", "Basis", table_html(operability_settings(study), -1));
  page.section("runs", "Runs", without_title(runs_table(study)));
  page.section("notes", "Notes", bullet_list(study.notes));
  std::string list;
  for (const std::string& file : files) list += fmt::format("<li><a href=\"{0}\">{0}</a></li>", escape_html(file));
  page.section("files", "Files", "<ul>" + list + "</ul>");
  const char* kind = !certified(study) ? " fail" : study.warnings.empty() ? "" : " warn";
  const std::string head = fmt::format("<div class=\"verdict{}\" role=\"status\"><strong>{}</strong></div>", kind,
                                       escape_html(operability_verdict(study))) +
                           warnings_html(study.warnings);
  const Case& c = study.campaign.lift;
  return page.html("Limiting sea states: " + (c.title.empty() ? c.name : c.title), "pre{overflow-x:auto}", head, c.name,
                   control);
}

}  // namespace stillhook
