#include "results/document_control.h"

#include <fmt/core.h>

#include "results/html.h"

namespace stillhook {
namespace {

constexpr std::size_t kShownDigits = 12;  // of the hash in margins; the head has all of it

/// A text as a CSS string that neither ends the string nor the style element it stands in.
std::string css_string(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f || c == '"' || c == '\\' || c == '<' || c == '>')
      out += fmt::format("\\{:06x}", byte == '\n' ? 0x20u : byte);
    else
      out += c;
  }
  return out + "\"";
}

/// What is there of some texts, with dots between.
std::string joined(std::initializer_list<std::string> parts) {
  std::string out;
  for (const std::string& part : parts)
    if (!part.empty()) out += (out.empty() ? "" : " · ") + part;
  return out;
}

std::string named(const char* name, const std::string& value) {
  return value.empty() ? std::string() : name + (" " + value);
}

/// A document that names any of these shows where the others are missing.
bool controlled(const DocumentControl& c) {
  return !(c.project.empty() && c.revision.empty() && c.author.empty() && c.checked_by.empty());
}

}  // namespace

std::string control_html(const DocumentControl& control, const std::string& program_version) {
  std::string out;
  const auto entry = [&](const char* name, const std::string& value) {
    out += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", name, value.empty() ? "–" : escape_html(value));
  };
  if (controlled(control)) {
    entry("Project", control.project);
    entry("Revision", control.revision);
    entry("Author", control.author);
    entry("Checked by", control.checked_by);
  }
  if (!control.date.empty()) entry("Run", control.date);
  if (!control.case_hash.empty())
    out += fmt::format("<div><dt>Case</dt><dd><span title=\"SHA-256 of case.toml: {0}\">{1}…</span></dd></div>",
                       control.case_hash, control.case_hash.substr(0, kShownDigits));
  entry("Program", "stillhook " + program_version);
  return "<dl class=\"control\">" + out + "</dl>";
}

std::string control_style(const DocumentControl& control, const std::string& title,
                          const std::string& program_version) {
  const std::string hash =
      control.case_hash.empty() ? "" : "case.toml SHA-256 " + control.case_hash.substr(0, kShownDigits) + "…";
  const bool all = controlled(control);
  const auto person = [&](const char* name, const std::string& value) {
    return all ? named(name, value.empty() ? "–" : value) : std::string();
  };
  return fmt::format(
      "@page{{@top-left{{content:{};width:62%}}@top-right{{content:{}}}@bottom-left{{content:{};width:80%}}"
      "@bottom-right{{content:\"page \" counter(page) \" of \" counter(pages)}}}}",
      css_string(joined({control.project, title})),
      css_string(joined({person("revision", control.revision), control.date})),
      css_string(joined({person("author", control.author), person("checked by", control.checked_by), hash,
                         "stillhook " + program_version})));
}

}  // namespace stillhook
