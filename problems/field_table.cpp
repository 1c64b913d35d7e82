#include "problems/field_table.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>
#include <set>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "problems/not_modelled.h"

namespace stillhook {
namespace {

/// Optimal string alignment distance: insertions, deletions, substitutions, swaps of neighbours.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before = last;
    last = now;
  }
  return last[b.size()];
}

/// True if every word of "kg_per_m3" is one a unit is made of.
bool looks_like_unit(const std::string& suffix) {
  static const std::set<std::string> words = {
      "t",   "te",      "kg",      "g",     "lb",     "n",      "kn",      "mn",     "kgf",     "tf",      "m",
      "mm",  "cm",      "km",      "ft",    "in",     "s",      "sec",     "secs",   "min",     "h",       "hr",
      "ms",  "seconds", "minutes", "hz",    "deg",    "rad",    "degrees", "per",    "m2",      "m3",      "m4",
      "s2",  "pa",      "kpa",     "nm",    "knm",    "tonnes", "tons",    "degree", "radians", "percent", "share",
      "rpm", "rad2",    "knot",    "knots", "meters", "metres", "tm",      "tm2",    "kgm2",    "mps"};
  std::size_t start = 0;
  while (start <= suffix.size()) {
    const std::size_t end = std::min(suffix.find('_', start), suffix.size());
    std::string word = suffix.substr(start, end - start);
    std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
    if (!words.count(word)) return false;
    start = end + 1;
  }
  return true;
}

}  // namespace

std::string Range::text(const Unit& unit) const {
  const std::string tail = unit.text.empty() ? "" : " " + unit.text;
  const bool below = std::isfinite(low), above = std::isfinite(high);
  if (below && above) return fmt::format("in [{:.6g}, {:.6g}]{}", low, high, tail);
  if (below) return fmt::format("{} {:.6g}{}", low_open ? ">" : ">=", low, tail);
  if (above) return fmt::format("<= {:.6g}{}", high, tail);
  return {};
}

const Field* Table::find(const std::string& key) const {
  for (const Field& field : fields)
    if (field.key == key) return &field;
  return nullptr;
}

std::optional<Value> Table::default_of(const Field& field) const {
  if (!field.get || field.required || (!field.group.empty() && field.group_required)) return std::nullopt;
  std::optional<Value> value = field.get(make().get());
  if (!value) return value;
  if (double* number = std::get_if<double>(&*value)) *number /= field.unit.factor;
  if (auto* numbers = std::get_if<std::vector<double>>(&*value))
    for (double& number : *numbers) number /= field.unit.factor;
  return value;
}

std::optional<std::string> nearest(const std::string& word, const std::vector<std::string>& candidates) {
  // "Z" for "z": one letter changed is a whole word changed, but it is the same word.
  const auto same_letter = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
  for (const std::string& candidate : candidates)
    if (candidate != word && std::equal(word.begin(), word.end(), candidate.begin(), candidate.end(), same_letter))
      return candidate;
  std::optional<std::string> best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word.substr(0, 100), candidate);
    if (distance < least && distance < std::max(word.size(), candidate.size())) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates) {
  const auto found = nearest(word, candidates);
  return found ? fmt::format(", did you mean \"{}\"?", *found) : std::string();
}

std::string base_of(const Field& field) {
  const std::string tail = "_" + field.unit.suffix;
  if (field.unit.suffix.empty() || field.key.size() <= tail.size()) return field.key;
  if (field.key.compare(field.key.size() - tail.size(), tail.size(), tail) != 0) return field.key;
  return field.key.substr(0, field.key.size() - tail.size());
}

std::string as_step(const std::string& name) { return name.find('.') == std::string::npos ? name : "\"" + name + "\""; }

namespace {

/// Keys of the same quantity; `key` names it with another unit or without.
std::vector<std::string> same_quantity(const Table& table, const std::string& key) {
  std::vector<std::string> keys;
  for (const Field& field : table.fields) {
    const std::string base = base_of(field);
    const bool without_unit = key == base && base != field.key;
    const bool other_unit = key.size() > base.size() + 1 && key.compare(0, base.size() + 1, base + "_") == 0 &&
                            looks_like_unit(key.substr(base.size() + 1));
    if (without_unit || other_unit) keys.push_back(field.key);
  }
  return keys;
}

/// Symbols by which the field calls quantities whose keys have whole words.
constexpr std::pair<const char*, const char*> kSymbols[] = {
    {"hs", "significant_height"}, {"hm0", "significant_height"}, {"tp", "peak_period"},
    {"tz", "peak_period"},        {"t02", "peak_period"},        {"h", "height"},
    {"t", "period"},              {"dir", "heading"},            {"direction", "heading"},
    {"ea", "axial_stiffness"},    {"mbl", "breaking_load"},      {"dt", "time_step"}};

/// The zero-crossing period is shorter than the peak period: to call one by the other's name would be a wrong sea.
bool is_zero_crossing(const std::string& key) {
  const std::string word = key.substr(0, key.find('_'));
  return word == "tz" || word == "Tz" || word == "t02" || word == "T02";
}

/// The key that a symbol with or without a unit stands for, "hs_m" for "significant_height_m"; empty if there is none.
std::string by_symbol(const Table& table, const std::string& key) {
  std::string lower = key;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const auto& [symbol, base] : kSymbols) {
    const std::string with_unit = std::string(symbol) + "_";
    const bool is_symbol =
        lower == symbol || (lower.starts_with(with_unit) && looks_like_unit(lower.substr(with_unit.size())));
    if (!is_symbol) continue;
    for (const Field& field : table.fields)
      if (base_of(field) == base) return field.key;
  }
  return {};
}

std::vector<std::string> keys_of(const Table& table) {
  std::vector<std::string> keys;
  for (const Field& field : table.fields) keys.push_back(field.key);
  return keys;
}

}  // namespace

std::vector<std::string> meant_keys(const Table& table, const std::string& key) {
  std::vector<std::string> keys = same_quantity(table, key);
  if (!keys.empty() || !not_modelled(key).empty()) return keys;
  if (const std::string meant = by_symbol(table, key); !meant.empty()) return {meant};
  if (const auto near = nearest(key, keys_of(table)); keys.empty() && near) keys.push_back(*near);
  return keys;
}

std::string unknown_key_sentence(const Table& table, const std::string& key) {
  const std::vector<std::string> same = same_quantity(table, key);
  if (!same.empty()) {
    const bool without_unit = std::any_of(table.fields.begin(), table.fields.end(),
                                          [&key](const Field& f) { return base_of(f) == key && f.key != key; });
    const std::string list = fmt::format("\"{}\"", fmt::join(same, "\" or \""));
    return without_unit ? "the key must carry its unit: write " + list : "wrong unit in the key: write " + list;
  }
  if (const std::string missing = not_modelled(key); !missing.empty()) return "unknown key: " + missing;
  const std::vector<std::string> known = keys_of(table);
  if (const std::string meant = by_symbol(table, key); !meant.empty())
    return fmt::format("unknown key, did you mean \"{}\"?{}", meant,
                       is_zero_crossing(key) ? " It is not Tz: Tp is 1.286 Tz for JONSWAP with gamma 3.3, 1.405 Tz for "
                                               "Pierson-Moskowitz"
                                             : "");
  if (const auto near = nearest(key, known)) return fmt::format("unknown key, did you mean \"{}\"?", *near);
  return fmt::format("unknown key, known are {}", fmt::join(known, ", "));
}

}  // namespace stillhook
