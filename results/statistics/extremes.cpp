#include "results/statistics/extremes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "results/statistics/sample.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

bool all_equal(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [&](double v) { return v == values.front(); });
}

constexpr Gumbel kNoGumbel{kNaN, kNaN};

}  // namespace

double Gumbel::quantile(double p) const { return location - scale * std::log(-std::log(p)); }

double Gumbel::probability(double x) const { return std::exp(-std::exp(-(x - location) / scale)); }

Gumbel gumbel_by_moments(const std::vector<double>& values) {
  if (values.size() < 2 || all_equal(values)) return kNoGumbel;
  const double mean = mean_of(values);
  double squares = 0.0;
  for (const double v : values) squares += (v - mean) * (v - mean);
  const double scale = std::sqrt(squares / static_cast<double>(values.size() - 1)) * std::sqrt(6.0) / std::numbers::pi;
  return {mean - kEulerGamma * scale, scale};
}

Gumbel gumbel_by_l_moments(std::vector<double> values) {
  if (values.size() < 2 || all_equal(values)) return kNoGumbel;
  std::sort(values.begin(), values.end());
  const double n = static_cast<double>(values.size());
  double first = 0.0;  // the probability-weighted moment b1
  for (std::size_t i = 0; i < values.size(); ++i) first += static_cast<double>(i) * values[i];
  first /= n * (n - 1.0);
  const double mean = mean_of(values), scale = (2.0 * first - mean) / std::numbers::ln2;
  return {mean - kEulerGamma * scale, scale};
}

Gumbel gumbel_by_likelihood(const std::vector<double>& values) {
  const Gumbel start = gumbel_by_moments(values);
  if (!(start.scale > 0.0)) return kNoGumbel;
  const double mean = mean_of(values), least = *std::min_element(values.begin(), values.end());
  // mean - weighted mean - scale falls from mean - min (scale towards 0) to -infinity: one root.
  const auto excess = [&](double scale) {
    double weights = 0.0, weighted = 0.0;
    for (const double v : values) {
      const double w = std::exp(-(v - least) / scale);
      weights += w;
      weighted += w * v;
    }
    return mean - weighted / weights - scale;
  };
  double low = 1e-3 * start.scale, high = start.scale;
  while (excess(low) < 0.0) low *= 0.5;
  while (excess(high) > 0.0) high *= 2.0;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0.0 ? low : high) = middle;
  }
  double sum = 0.0;
  for (const double v : values) sum += std::exp(-(v - least) / high);
  return {least - high * std::log(sum / static_cast<double>(values.size())), high};
}

double gumbel_quantile_error(const Gumbel& gumbel, int n, double p) {
  const double y = -std::log(-std::log(p));
  return gumbel.scale * std::sqrt((1.10867 + 0.51404 * y + 0.60793 * y * y) / n);
}

Gumbel over_longer_time(const Gumbel& gumbel, double ratio) {
  return {gumbel.location + gumbel.scale * std::log(ratio), gumbel.scale};
}

bool gumbel_is_rejected(std::vector<double> values) {
  const Gumbel fitted = gumbel_by_likelihood(values);
  if (!(fitted.scale > 0.0)) return true;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  const auto within = [&](std::size_t i) { return std::clamp(fitted.probability(values[i]), 1e-300, 1.0 - 1e-16); };
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    sum += (2.0 * static_cast<double>(i) + 1.0) * (std::log(within(i)) + std::log1p(-within(n - 1 - i)));
  const double count = static_cast<double>(n), squared = -count - sum / count;
  return squared * (1.0 + 0.2 / std::sqrt(count)) > 0.757;
}

double gaussian_largest(double sigma, double cycles, double p) {
  return sigma * std::sqrt(2.0 * std::log(cycles / -std::log(p)));
}

double gaussian_limiting_height(double limit, double sigma, double cycles, double p) {
  return limit / gaussian_largest(sigma, cycles, p);
}

}  // namespace stillhook
