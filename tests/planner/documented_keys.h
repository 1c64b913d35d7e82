// Which keys of a summary the documentation does not know.
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace stillhook {

/// Words in `backticks` of docs/summary.md.
inline std::set<std::string> documented_words() {
  std::ifstream in(std::string(STILLHOOK_SOURCE_DIR) + "/docs/summary.md");
  std::set<std::string> words;
  bool code = false;
  std::string word;
  for (char c; in.get(c);) {
    if (code && (std::isalnum(static_cast<unsigned char>(c)) || c == '_')) {
      word += c;
      continue;
    }
    if (!word.empty()) words.insert(word);
    word.clear();
    if (c == '`') code = !code;
  }
  return words;
}

/// Keys of a document, however deep, that the page does not name. Names of metrics are another list's concern, those of
/// phases the case's.
inline void add_undocumented(const nlohmann::json& document, const std::set<std::string>& known,
                             std::set<std::string>& missing, bool names = false) {
  if (document.is_array())
    for (const auto& entry : document) add_undocumented(entry, known, missing);
  if (!document.is_object()) return;
  for (const auto& [key, value] : document.items()) {
    if (!names && !known.contains(key)) missing.insert(key);
    add_undocumented(value, known, missing, !names && (key == "metrics" || key == "by_phase"));
  }
}

inline std::set<std::string> undocumented_keys(const nlohmann::json& document) {
  std::set<std::string> missing;
  add_undocumented(document, documented_words(), missing);
  return missing;
}

}  // namespace stillhook
