#include "problems/case_findings.h"

#include <algorithm>

#include <fmt/core.h>

#include "problems/case.h"

namespace stillhook {

void Findings::add(const Position& position, const std::string& section, const std::string& key,
                   const std::string& sentence) {
  std::string text = position.origin.empty()
                         ? fmt::format("{}:{}:{}: ", file_, std::max(1, position.line), std::max(1, position.column))
                         : position.origin + ": ";
  if (!section.empty()) text += "[" + section + "]" + (key.empty() ? ": " : " ");
  if (!key.empty()) text += key + ": ";
  text += sentence;
  for (const Line& line : lines_)
    if (line.text == text) return;
  lines_.push_back({position, std::move(text)});
}

void Findings::throw_if_any() const {
  if (lines_.empty()) return;
  constexpr std::size_t most = 20;
  std::vector<Line> lines = lines_;
  std::stable_sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
    if (a.position.origin.empty() != b.position.origin.empty()) return b.position.origin.empty();
    if (!a.position.origin.empty()) return false;
    return a.position.line != b.position.line ? a.position.line < b.position.line
                                              : a.position.column < b.position.column;
  });
  std::string all;
  for (std::size_t i = 0; i < std::min(most, lines.size()); ++i) all += (i ? "\n" : "") + lines[i].text;
  if (lines.size() > most) all += fmt::format("\n... and {} more", lines.size() - most);
  throw CaseError(all);
}

}  // namespace stillhook
