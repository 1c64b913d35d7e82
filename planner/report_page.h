// The frame of a report that is not of one run: title, verdict, contents, sections.
#pragma once

#include <string>

#include "results/document_control.h"
#include "results/report_parts.h"

namespace stillhook {

class ReportPage {
 public:
  /// Adds a section with an entry in the contents; empty content adds nothing.
  void section(const std::string& id, const std::string& title, const std::string& content);
  /// The whole page. `style`: rules beside the common ones; `head`: HTML under the title; `foot`: a word at the end.
  std::string html(const std::string& title, const std::string& style, const std::string& head, const std::string& foot,
                   const DocumentControl& control = {}) const;

 private:
  std::string nav_, body_;
};

/// "Warnings": a box of sentences, or nothing.
std::string warnings_html(const std::vector<std::string>& warnings);

}  // namespace stillhook
