#include "results/statistics/limiting_height.h"

#include <algorithm>
#include <limits>
#include <map>

#include "results/statistics/binomial.h"
#include "results/statistics/extremes.h"

namespace stillhook {
namespace {

/// Exact where the response is linear in Hs: 1/h is then its largest value at Hs = 1 m.
double gumbel_limit(const std::vector<Crossing>& crossings, double level) {
  std::vector<double> inverse;
  for (const Crossing& c : crossings) {
    if (!c.found || !c.smooth || !(c.height > 0.0)) return kNaN;
    inverse.push_back(1.0 / c.height);
  }
  if (gumbel_is_rejected(inverse)) return kNaN;
  return 1.0 / gumbel_by_l_moments(inverse).quantile(level);
}

void find_governing(const std::vector<Crossing>& crossings, LimitingHeight& result) {
  std::map<std::string, int> counts;
  int broken = 0, most = 0;
  for (const Crossing& c : crossings)
    if (c.found && c.height <= result.height) {
      ++broken;
      ++counts[c.criterion];
    }
  for (const auto& [criterion, count] : counts)
    if (count > most) {
      most = count;
      result.governing = criterion;
    }
  if (broken > 0) result.governing_share = static_cast<double>(most) / broken;
}

}  // namespace

LimitingHeight limiting_height(const std::vector<Crossing>& crossings, double level) {
  LimitingHeight result;
  result.seeds = static_cast<int>(crossings.size());
  if (crossings.empty()) return result;
  std::vector<double> heights;
  for (const Crossing& c : crossings) heights.push_back(c.found ? c.height : std::numeric_limits<double>::infinity());
  std::sort(heights.begin(), heights.end());
  const auto finite = [](double v) { return v < std::numeric_limits<double>::infinity() ? v : kNaN; };
  const auto ranked = [&](int rank) { return rank == 0 ? kNaN : finite(heights[static_cast<std::size_t>(rank - 1)]); };
  result.height = finite(quantile_of(heights, 1.0 - level));
  const QuantileRanks ranks = quantile_ranks(result.seeds, 1.0 - level);
  result.low = ranked(ranks.lower);
  result.high = ranked(ranks.upper);
  result.gumbel = gumbel_limit(crossings, level);
  find_governing(crossings, result);
  return result;
}

}  // namespace stillhook
