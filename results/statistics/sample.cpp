#include "results/statistics/sample.h"

#include <algorithm>
#include <random>

#include "sim/spatial/constants.h"

namespace stillhook {

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return values.empty() ? kNaN : sum / static_cast<double>(values.size());
}

double quantile_of(std::vector<double> values, double q) {
  if (values.empty()) return kNaN;
  std::sort(values.begin(), values.end());
  const double place = q * static_cast<double>(values.size() - 1);
  const std::size_t below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  const double part = place - static_cast<double>(below);
  if (part == 0.0 || values[below] == values[above]) return values[below];  // infinite ones have no difference
  return values[below] + part * (values[above] - values[below]);
}

Interval bootstrap_interval(std::size_t size, const std::function<double(const std::vector<std::size_t>&)>& statistic,
                            int resamples) {
  std::mt19937_64 random(20180401);
  std::vector<double> results;
  std::vector<std::size_t> drawn(size);
  for (int k = 0; k < resamples && size > 0; ++k) {
    // Modulo by hand: the standard's distributions differ between libraries.
    for (std::size_t& index : drawn) index = random() % size;
    results.push_back(statistic(drawn));
  }
  return {quantile_of(results, 0.05), quantile_of(results, 0.95)};
}

}  // namespace stillhook
