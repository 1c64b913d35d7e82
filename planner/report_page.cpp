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
  std::string out = "<h3>" + escape_html(t.title) + "</h3>";
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
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; img-src "
      "data:; base-uri 'none'; form-action 'none'\">"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><meta name=\"generator\" "
      "content=\"stillhook {0}\"><link rel=\"icon\" href=\"data:,\"><title>{1}</title><style>{2}{3}</style></head>\n"
      "<body><header><h1>{1}</h1>{4}</header>\n<main><nav aria-label=\"Contents\">{5}</nav>{6}</main>\n"
      "<footer>stillhook {0} · {7}</footer></body></html>\n",
      kVersion, escape_html(title), report_style(), style, head, nav_, body_, escape_html(foot));
}

std::string warnings_html(const std::vector<std::string>& warnings) {
  if (warnings.empty()) return {};
  std::string out = "<div class=\"verdict warn\"><b>To be known</b><ul>";
  for (const std::string& warning : warnings) out += "<li>" + escape_html(warning) + "</li>";
  return out + "</ul></div>";
}

}  // namespace stillhook
