#include "results/report.h"

#include <fmt/core.h>

#include <cctype>

#include "results/files.h"
#include "results/flow_words.h"
#include "results/html.h"
#include "results/replay.h"
#include "results/report_parts.h"
#include "results/sea_words.h"
#include "results/summary.h"
#include "results/viewer_bundle.h"

namespace stillhook {

namespace {

/// A key of the case may be broken after its dots and underscores, or a table of long keys would not fit on the page.
std::string breakable(const std::string& text) {
  const std::string escaped = escape_html(text);
  std::string out;
  for (std::size_t i = 0; i < escaped.size(); ++i) {
    out += escaped[i];
    const bool in_word =
        i > 0 && i + 1 < escaped.size() && std::isalpha(static_cast<unsigned char>(escaped[i - 1])) != 0;
    if ((escaped[i] == '.' || escaped[i] == '_') && in_word) out += "<wbr>";
  }
  return out;
}

}  // namespace

std::string table_html(const ReportTable& t, int numeric_from) {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  for (const std::string& cell : t.header) header.push_back(breakable(cell));
  for (const auto& row : t.rows) {
    rows.emplace_back();
    for (const std::string& cell : row)
      rows.back().push_back(rows.back().empty() ? breakable(cell) : escape_html(cell));
  }
  std::string out = t.title.empty() ? "" : "<h3>" + escape_html(t.title) + "</h3>";
  if (!rows.empty()) out += html_table(header, rows, numeric_from);
  return out + (t.note.empty() ? "" : "<p><small>" + escape_html(t.note) + "</small></p>");
}

namespace {

std::string extra_tables(const ReportData& data) {
  std::string out;
  for (const ReportTable& t : data.tables) out += table_html(t);
  return out;
}

std::string statement(const ReportData& data) {
  std::string out;
  std::size_t from = 0;
  while (from < data.statement.size()) {  // an empty line starts a new paragraph
    std::size_t to = data.statement.find("\n\n", from);
    if (to == std::string::npos) to = data.statement.size();
    out += "<p class=\"asked\">" + escape_html(std::string_view(data.statement).substr(from, to - from)) + "</p>";
    from = to + 2;
  }
  return out;
}

std::string warnings(const ReportData& data) {
  if (data.warnings.empty()) return {};
  std::string out = "<div class=\"verdict warn\"><b>Warnings</b><ul>";
  for (const std::string& warning : data.warnings) out += "<li>" + escape_html(warning) + "</li>";
  return out + "</ul></div>";
}

std::string cost(const ReportData& data) {
  const Trajectory& run = data.trajectory;
  const double simulated = run.phases.empty() ? 0.0 : run.phases.back().end - run.phases.front().start;
  std::string out = fmt::format("{} s simulated, {} steps", fixed_number(simulated, 0), run.steps);
  if (run.wall > 0.0)
    out += fmt::format(", {} s of computing: {} times real time", readable_number(run.wall, 3),
                       readable_number(simulated / run.wall, 3));
  return out;
}

std::string licences() {
  return "<details><summary>Licences of the libraries in this page</summary><pre tabindex=\"0\">" +
         escape_html(viewer_licences()) + "</pre></details>";
}

}  // namespace

std::string page_head(const std::string& title, const std::string& program_version, bool with_viewer,
                      const std::string& more_style) {
  // Nothing may be fetched from anywhere; the one script that may run is named by its hash.
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; img-src "
      "data:{}; base-uri 'none'; form-action 'none'\">"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><meta name=\"generator\" "
      "content=\"stillhook {}\"><link rel=\"icon\" href=\"data:,\"><title>{}</title><style>{}",
      with_viewer ? fmt::format("; script-src '{}'", viewer_hash()) : "", escape_html(program_version), title,
      report_style() + more_style);
  if (with_viewer) out += viewer_style();
  return out + "</style></head>\n";
}

std::string report_html(const ReportData& data) {
  const RunView view(data.specification, data.trajectory);
  const std::vector<ReportFigure> figures = report_figures(data, view);
  const Scene scene = build_scene(data.specification, data.trajectory);
  const bool replay = !viewer_script().empty() && data.trajectory.time.size() >= 2;
  std::string body, nav;
  const auto section = [&](const char* id, const char* title, const std::string& content) {
    if (content.empty()) return;
    nav += fmt::format("<a href=\"#{}\">{}</a>", id, title);
    body += html_section(id, title, content);
  };
  section("statement", "What is asked", statement(data));
  if (data.search) section("search", "Baseline and plan", search_part(*data.search));
  section("limits", "Limits", limits_part(data));
  section("loads", "Weights, hook loads and amplification", loads_part(data, view));
  section("procedure", "Procedure step by step", procedure_part(data, view));
  section("basis", "Design basis", basis_part(data));
  section("plots", "Plots", plots_part(figures));
  section("metrics", "Metrics", metrics_part(data));
  section("contacts", "Contacts", contacts_part(data));
  section("poses", "Static poses", poses_part(data, scene));
  section("tables", "Further tables", extra_tables(data));
  section("assumptions", "Assumptions and deviations", assumptions_part(data));
  if (!data.case_text.empty())
    section("case", "Case as resolved",
            "<details><summary>Show the case file</summary><pre tabindex=\"0\">" + escape_html(data.case_text) +
                "</pre></details>");

  const std::string plain_title = data.title.empty() ? data.specification.name : data.title;
  const std::string title = escape_html(plain_title);
  std::string conditions = sea_sentence(data.specification.sea, data.north);
  for (const std::string& flow :
       {wind_sentence(data.specification, data.north), current_sentence(data.specification.sea, data.north)})
    if (!flow.empty()) conditions += ". " + flow;
  std::string page = fmt::format(
      "{}<body><header><h1>{}</h1>{}<p class=\"muted\">{}</p></header>\n<main><section id=\"overview\" "
      "aria-label=\"Overview\"><div class=\"judgement\">{}</div>{}</section>\n<nav "
      "aria-label=\"Contents\">{}</nav>{}</main>\n<footer>stillhook {} · {} · {}{}</footer>",
      page_head(title, data.program_version, replay, control_style(data.control, plain_title, data.program_version)),
      title, control_html(data.control, data.program_version), escape_html(conditions),
      verdict_part(data) + warnings(data), replay_part(data, replay), nav, body, escape_html(data.program_version),
      escape_html(data.specification.name), cost(data), replay ? licences() : "");
  if (replay) {
    page += "<script type=\"text/plain\" id=\"replay-data\">" + replay_text(data, view, scene, figures) +
            "</script>\n<script>";
    page += viewer_script();
    page += "</script>";
  }
  return page + "</body></html>\n";
}

void write_report(const ReportData& data, const std::string& path) { write_file(path, report_html(data)); }

}  // namespace stillhook
