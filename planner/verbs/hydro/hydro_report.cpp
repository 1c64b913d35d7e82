#include "planner/verbs/hydro/hydro_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "planner/verbs/hydro/hydro_tables.h"
#include "planner/report_page.h"
#include "planner/text_number.h"
#include "results/html.h"
#include "results/report_parts.h"

namespace stillhook {
namespace {

constexpr const char* kStyle = R"css(
.pairs{display:grid;grid-template-columns:repeat(auto-fit,minmax(26rem,1fr));gap:.2rem 1rem}
.pairs figure{margin:.4rem 0;min-width:0}
.pairs svg.plot{min-width:0}
@media(max-width:480px){.pairs{grid-template-columns:1fr}}
@media print{.pairs{grid-template-columns:1fr 1fr}}
)css";

std::string checks_html(const HydroSet& set) {
  const ReportTable table = check_table(set);
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const std::vector<std::string>& row = table.rows[i];
    const bool passed = set.checks[i].passed();
    rows.push_back({escape_html(row[0]), row[1], row[2],
                    fmt::format("<span class=\"{}\">{}</span>", passed ? "pass" : "warn", row[3]),
                    escape_html(row[4])});
  }
  return "<h3>Self-checks</h3>" + html_table(table.header, rows, -1);
}

/// The verdict on the first screen.
std::string head(const HydroResult& result) {
  std::size_t failed = 0, checks = 0;
  std::string lines;
  for (std::size_t k = 0; k < result.sets.size(); ++k) {
    const HydroSet& set = result.sets[k];
    checks += set.checks.size();
    failed += static_cast<std::size_t>(
        std::count_if(set.checks.begin(), set.checks.end(), [](const SelfCheck& c) { return !c.passed(); }));
    lines += "<p>" + escape_html(origin_sentence(set)) + "</p>";
    if (!result.convergence[k].empty())
      lines += "<p>" + escape_html(result.convergence[k].front().conclusion(set)) + "</p>";
  }
  const bool apart = std::any_of(result.convergence.begin(), result.convergence.end(),
                                 [](const auto& one) { return !one.empty() && !one.front().within_limit(); });
  std::string out = fmt::format(
      "<div class=\"verdict{}\" role=\"status\"><strong>{}</strong>{}</div>", failed > 0 || apart ? " warn" : "",
      failed > 0 ? fmt::format("{} of {} self-checks fail and are accepted by name", failed, checks)
                 : fmt::format("All {} self-checks pass", checks),
      lines);
  return out + warnings_html(result.warnings);
}

std::string set_html(const HydroResult& result, std::size_t k) {
  const HydroSet& set = result.sets[k];
  std::string out = "<p>" + escape_html(set.set->description) + "</p>" + checks_html(set);
  if (!result.convergence[k].empty()) out += table_html(convergence_table(set, result.convergence[k].front()));
  out += table_html(fit_table(set)) + coefficient_plots(set);
  std::string tables;
  for (const ReportTable& table : coefficient_tables(set)) tables += table_html(table);
  out += "<details><summary>Coefficients as tables</summary>" + tables + "</details>";
  if (!set.bands.empty()) out += table_html(panel_table(set));
  return out;
}

std::string files_html(const std::vector<std::string>& files) {
  std::string out = "<ul>";
  for (const std::string& file : files) out += fmt::format("<li><a href=\"{0}\">{0}</a></li>", escape_html(file));
  return out +
         "</ul><p><small>.csv: the project's own format, <code>kind = \"table\"</code> reads it. .h5: BEMIO, for "
         "WEC-Sim. "
         ".1, .3, .hst: WAMIT, ULEN 1 m, periods. Conventions are in docs/hydrodynamics.md.</small></p>";
}

}  // namespace

std::string hydro_report(const Case& c, const HydroResult& result, const std::vector<std::string>& files,
                         const DocumentControl& control) {
  ReportPage page;
  if (!result.responses.frequencies.empty())
    page.section(
        "response", "Response amplitude operators",
        "<p>Linear motions of the moored, jointed lift about its initial equilibrium, per metre of wave amplitude, of "
        "each body's centre of gravity along its own heading. Waves travel towards the headings given, in the "
        "world.</p>" +
            response_plots(result.responses));
  std::string periods;
  for (const ReportTable& table : result.periods) periods += table_html(table);
  page.section("periods", "Natural periods", periods);
  for (std::size_t k = 0; k < result.sets.size(); ++k)
    page.section("set-" + result.sets[k].name(), "Coefficients of " + readable_name(result.sets[k].title()),
            set_html(result, k));
  page.section("files", "Files", files_html(files));

  return page.html("Hydrodynamics of " + (c.title.empty() ? c.name : c.title), kStyle, head(result), c.name, control);
}

}  // namespace stillhook
