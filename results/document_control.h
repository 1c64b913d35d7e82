// What a controlled document says of itself: in the head of a page, and in the margins of every printed sheet.
#pragma once

#include <string>

namespace stillhook {

struct DocumentControl {
  std::string project, revision, author, checked_by;  // as the case gives them; empty = not given
  std::string date;                                   // of the run, "2026-03-01 14:05 UTC"; empty = not known
  std::string case_hash;                              // SHA-256 of the run's case.toml, hexadecimal; empty = not known
};

/// The line under the title: project, revision, author, checked by, date, case, program. HTML.
std::string control_html(const DocumentControl& control, const std::string& program_version);

/// CSS for the margins of printed pages: the same, with the title and the number of the page. `title` is plain text.
std::string control_style(const DocumentControl& control, const std::string& title, const std::string& program_version);

}  // namespace stillhook
