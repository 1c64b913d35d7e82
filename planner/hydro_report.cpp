#include "planner/hydro_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "planner/hydro_tables.h"
#include "planner/text_number.h"
#include "planner/version.h"
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

std::string html_of(const ReportTable& t, int numeric_from = 1) {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  for (const std::string& cell : t.header) header.push_back(escape_html(cell));
  for (const auto& row : t.rows) {
    rows.emplace_back();
    for (const std::string& cell : row) rows.back().push_back(escape_html(cell));
  }
  std::string out = "<h3>" + escape_html(t.title) + "</h3>";
  if (!rows.empty()) out += html_table(header, rows, numeric_from);
  return out + (t.note.empty() ? "" : "<p><small>" + escape_html(t.note) + "</small></p>");
}

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
  if (result.warnings.empty()) return out;
  out += "<div class=\"verdict warn\"><b>To be known</b><ul>";
  for (const std::string& warning : result.warnings) out += "<li>" + escape_html(warning) + "</li>";
  return out + "</ul></div>";
}

std::string set_html(const HydroResult& result, std::size_t k) {
  const HydroSet& set = result.sets[k];
  std::string out = "<p>" + escape_html(set.set->description) + "</p>" + checks_html(set);
  if (!result.convergence[k].empty()) out += html_of(convergence_table(set, result.convergence[k].front()));
  out += html_of(fit_table(set)) + coefficient_plots(set);
  std::string tables;
  for (const ReportTable& table : coefficient_tables(set)) tables += html_of(table);
  out += "<details><summary>Coefficients as tables</summary>" + tables + "</details>";
  if (!set.bands.empty()) out += html_of(panel_table(set));
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

std::string hydro_report(const Case& c, const HydroResult& result, const std::vector<std::string>& files) {
  std::string body, nav;
  const auto section = [&](const std::string& id, const std::string& title, const std::string& content) {
    if (content.empty()) return;
    nav += fmt::format("<a href=\"#{}\">{}</a>", escape_html(id), escape_html(title));
    body += html_section(escape_html(id), escape_html(title), content);
  };
  if (!result.responses.frequencies.empty())
    section(
        "response", "Response amplitude operators",
        "<p>Linear motions of the moored, jointed lift about its initial equilibrium, per metre of wave amplitude, of "
        "each body's centre of gravity along its own heading. Waves travel towards the headings given, in the "
        "world.</p>" +
            response_plots(result.responses));
  std::string periods;
  for (const ReportTable& table : result.periods) periods += html_of(table);
  section("periods", "Natural periods", periods);
  for (std::size_t k = 0; k < result.sets.size(); ++k)
    section("set-" + result.sets[k].name(), "Coefficients of " + readable_name(result.sets[k].title()),
            set_html(result, k));
  section("files", "Files", files_html(files));

  const std::string title = escape_html("Hydrodynamics of " + (c.title.empty() ? c.name : c.title));
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; img-src "
      "data:; base-uri 'none'; form-action 'none'\">"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><meta name=\"generator\" "
      "content=\"stillhook {0}\"><link rel=\"icon\" href=\"data:,\"><title>{1}</title><style>{2}{3}</style></head>\n"
      "<body><header><h1>{1}</h1>{4}</header>\n<main><nav aria-label=\"Contents\">{5}</nav>{6}</main>\n"
      "<footer>stillhook {0} · {7}</footer></body></html>\n",
      kVersion, title, report_style(), kStyle, head(result), nav, body, escape_html(c.name));
}

}  // namespace stillhook
