#include "planner/report_page.h"

#include <fmt/format.h>

#include "planner/version.h"
#include "results/html.h"
#include "results/report_parts.h"

namespace stillhook {

void ReportPage::section(const std::string& id, const std::string& title, const std::string& content) {
  if (content.empty()) return;
  nav_ += fmt::format("<a href=\"#{}\">{}</a>", escape_html(id), escape_html(title));
  body_ += html_section(escape_html(id), escape_html(title), content);
}

std::string ReportPage::html(const std::string& title, const std::string& style, const std::string& head,
                             const std::string& foot, const DocumentControl& control) const {
  return fmt::format(
      "{}<body><header><h1>{}</h1>{}{}</header>\n<main><nav aria-label=\"Contents\">{}</nav>{}</main>\n"
      "<footer>stillhook {} · {}</footer></body></html>\n",
      page_head(escape_html(title), kVersion, false, style + control_style(control, title, kVersion)),
      escape_html(title), control_html(control, kVersion), head, nav_, body_, kVersion, escape_html(foot));
}

std::string warnings_html(const std::vector<std::string>& warnings) {
  if (warnings.empty()) return {};
  std::string out = "<div class=\"verdict warn\"><b>Warnings</b><ul>";
  for (const std::string& warning : warnings) out += "<li>" + escape_html(warning) + "</li>";
  return out + "</ul></div>";
}

}  // namespace stillhook
