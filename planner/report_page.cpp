#include "planner/report_page.h"

#include <fmt/format.h>

#include "planner/version.h"
#include "results/html.h"
#include "results/report_parts.h"

namespace stillhook {

std::string table_html(const ReportTable& t, int numeric_from) {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  for (const std::string& cell : t.header) header.push_back(escape_html(cell));
  for (const auto& row : t.rows) {
    rows.emplace_back();
    for (const std::string& cell : row) rows.back().push_back(escape_html(cell));
  }
  std::string out = t.title.empty() ? "" : "<h3>" + escape_html(t.title) + "</h3>";
  if (!rows.empty()) out += html_table(header, rows, numeric_from);
  return out + (t.note.empty() ? "" : "<p><small>" + escape_html(t.note) + "</small></p>");
}

void ReportPage::section(const std::string& id, const std::string& title, const std::string& content) {
  if (content.empty()) return;
  nav_ += fmt::format("<a href=\"#{}\">{}</a>", escape_html(id), escape_html(title));
  body_ += html_section(escape_html(id), escape_html(title), content);
}

std::string ReportPage::html(const std::string& title, const std::string& style, const std::string& head,
                             const std::string& foot) const {
  return fmt::format(
      "{}<body><header><h1>{}</h1>{}</header>\n<main><nav aria-label=\"Contents\">{}</nav>{}</main>\n"
      "<footer>stillhook {} · {}</footer></body></html>\n",
      page_head(escape_html(title), kVersion, false, style), escape_html(title), head, nav_, body_, kVersion,
      escape_html(foot));
}

std::string warnings_html(const std::vector<std::string>& warnings) {
  if (warnings.empty()) return {};
  std::string out = "<div class=\"verdict warn\"><b>To be known</b><ul>";
  for (const std::string& warning : warnings) out += "<li>" + escape_html(warning) + "</li>";
  return out + "</ul></div>";
}

}  // namespace stillhook
