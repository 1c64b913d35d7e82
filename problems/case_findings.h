// What is wrong with a case, collected while reading so that a user sees everything at once.
#pragma once

#include <string>
#include <vector>

#include "problems/case_document.h"

namespace stillhook {

class Findings {
 public:
  explicit Findings(std::string file) : file_(std::move(file)) {}

  /// Adds "file:line:col: [section] key: sentence"; section and key may be empty.
  void add(const Position& position, const std::string& section, const std::string& key, const std::string& sentence);
  bool any() const { return !lines_.empty(); }
  /// Throws CaseError with one line per finding, up to 20 of them in the order of the file.
  void throw_if_any() const;

 private:
  struct Line {
    Position position;
    std::string text;
  };
  std::string file_;
  std::vector<Line> lines_;
};

}  // namespace stillhook
