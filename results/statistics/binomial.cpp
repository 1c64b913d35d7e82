#include "results/statistics/binomial.h"

#include <cmath>

namespace stillhook {
namespace {

/// Root of a function that falls with p: bisection to the last bits.
template <class F>
double falls_to(double wanted, double low, F value) {
  double high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double p = 0.5 * (low + high);
    (value(p) > wanted ? low : high) = p;
  }
  return high;
}

}  // namespace

double binomial_cdf(int k, int n, double p) {
  if (k < 0) return 0.0;
  if (k >= n || p <= 0.0) return 1.0;
  if (p >= 1.0) return 0.0;
  double sum = 0.0;
  for (int i = 0; i <= k; ++i)
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) + i * std::log(p) +
                    (n - i) * std::log1p(-p));
  return sum;
}

double broken_share_bound(int broken, int runs, double confidence) {
  if (broken >= runs) return 1.0;
  return falls_to(1.0 - confidence, static_cast<double>(broken) / runs,
                  [&](double p) { return binomial_cdf(broken, runs, p); });
}

Interval share_interval(int broken, int runs, double confidence) {
  const double tail = 0.5 * (1.0 - confidence);
  Interval interval{0.0, broken_share_bound(broken, runs, 1.0 - tail)};
  // P(X >= broken) rises with p, so P(X <= broken - 1) falls.
  if (broken > 0 && runs > 0)
    interval.low = falls_to(1.0 - tail, 0.0, [&](double p) { return binomial_cdf(broken - 1, runs, p); });
  return interval;
}

QuantileRanks quantile_ranks(int n, double share, double confidence) {
  QuantileRanks ranks;
  for (int r = 1; r <= n && 1.0 - binomial_cdf(r - 1, n, share) >= confidence; ++r) ranks.lower = r;
  for (int s = 1; s <= n && ranks.upper == 0; ++s)
    if (binomial_cdf(s - 1, n, share) >= confidence) ranks.upper = s;
  return ranks;
}

}  // namespace stillhook
