#include "sim/hull/coefficients/database_band.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "sim/hull/coefficients/database_frame.h"
#include "sim/hull/radiation/causal_kernels.h"

namespace stillhook {
namespace {

constexpr std::size_t kLeastShare = 3;  // one in so many frequencies

/// What can be judged of one frequency alone.
bool passes_alone(const HydrodynamicCoefficients& set, std::size_t n, const PanelMethodSpec& method) {
  HydrodynamicCoefficients one = set;
  one.retardation = {};
  one.frequency = {set.frequency[n]};
  const double w = set.frequency[n].frequency;
  ExcitationTable& X = one.excitation;
  X.frequencies.clear();
  X.value.clear();
  for (std::size_t f = 0; f < set.excitation.frequencies.size(); ++f) {
    if (std::abs(set.excitation.frequencies[f] - w) > 1e-6 * w) continue;
    X.frequencies = {w};
    const auto row = static_cast<std::ptrdiff_t>(X.headings.size() * static_cast<std::size_t>(X.modes));
    const auto from = set.excitation.value.begin() + static_cast<std::ptrdiff_t>(f) * row;
    X.value.assign(from, from + row);
  }
  const std::vector<std::string> accepted = listed_checks(method.accepted_checks);
  return std::ranges::none_of(self_checks(one, method.tolerances), [&](const SelfCheck& check) {
    const bool judged = check.key == "symmetry" || check.key == "damping" || check.key == "haskind";
    return judged && !check.passed() && std::ranges::find(accepted, check.key) == accepted.end();
  });
}

/// The longest run of true: first and one past its last.
std::pair<std::size_t, std::size_t> longest_run(const std::vector<bool>& good) {
  std::pair<std::size_t, std::size_t> best{0, 0};
  for (std::size_t n = 0, from = 0; n <= good.size(); ++n) {
    if (n < good.size() && good[n]) continue;
    if (n - from > best.second - best.first) best = {from, n};
    from = n + 1;
  }
  return best;
}

}  // namespace

std::vector<std::string> listed_checks(const std::string& text) {
  std::vector<std::string> names(1);
  for (const char letter : text) {
    if (letter == ',')
      names.emplace_back();
    else if (letter != ' ')
      names.back() += letter;
  }
  std::erase(names, "");
  return names;
}

bool passes_checks(const HydrodynamicCoefficients& set, const PanelMethodSpec& method) {
  const std::vector<std::string> accepted = listed_checks(method.accepted_checks);
  return std::ranges::all_of(self_checks(set, method.tolerances), [&](const SelfCheck& check) {
    return check.passed() || std::ranges::find(accepted, check.key) != accepted.end();
  });
}

std::string passing_band(const HydrodynamicCoefficients& set, const PanelMethodSpec& method) {
  std::vector<bool> good;
  for (std::size_t n = 0; n < set.frequency.size(); ++n) good.push_back(passes_alone(set, n, method));
  const auto [first, end] = longest_run(good);
  if (end - first == good.size() || (end - first) * kLeastShare < good.size() || end - first < 3) return {};
  // Limits between the frequencies, so that what is printed with four digits leaves out the same.
  const auto between = [&](std::size_t n) {
    return 0.5 * (set.frequency[n - 1].frequency + set.frequency[n].frequency);
  };
  const auto printed = [](double w) {
    std::ostringstream text;
    text.precision(4);
    text << w;
    return text.str();
  };
  // The fewest left out first: what is judged alone may fail by noise that does not matter beside the others.
  for (const auto& [low, high] : {std::pair{false, true}, std::pair{true, false}, std::pair{true, true}}) {
    if ((low && first == 0) || (high && end == good.size())) continue;
    DatabaseFrame frame;
    std::string keys;
    if (low) {
      keys = "database_lowest_rad_per_s = " + printed(between(first));
      frame.lowest = std::stod(printed(between(first)));
    }
    if (high) {
      keys += (keys.empty() ? "" : " and ") + ("database_highest_rad_per_s = " + printed(between(end)));
      frame.highest = std::stod(printed(between(end)));
    }
    HydrodynamicCoefficients part = set;
    try {
      cut_frequencies(part, frame, set.source);
      part.retardation = causal_kernels(part);
    } catch (const std::exception&) {
      continue;
    }
    if (passes_checks(part, method)) return "; without its other frequencies it passes: " + keys;
  }
  return {};
}

}  // namespace stillhook
