// What a count of "broken" among independent runs says: shares by Clopper & Pearson, Biometrika 26 (1934) 404, and
// quantiles by order statistics, Wilks, Ann. Math. Stat. 12 (1941) 91. Neither assumes a distribution of the values.
#pragma once

#include "results/statistics/sample.h"

namespace stillhook {

/// P(X <= k) for X binomial of n trials with probability p. 0 for k < 0, 1 for k >= n.
double binomial_cdf(int k, int n, double p);

/// Upper bound of a probability after `broken` of `runs`, one-sided: the quantile of Beta(broken + 1, runs - broken). 1
/// for no runs.
double broken_share_bound(int broken, int runs, double confidence = 0.95);

/// Two-sided interval of that probability, half of the doubt at each end.
Interval share_interval(int broken, int runs, double confidence = 0.90);

/// Ranks, from 1 in ascending order, of the values of a sample of n between which the quantile of a share lies: it is
/// at least the value of rank `lower` and at most that of rank `upper`, each with the one-sided confidence. 0: the
/// sample is too small to say. lower is the largest r with P(Bin(n, share) >= r) >= confidence, upper the smallest s
/// with P(Bin(n, share) <= s - 1) >= confidence.
struct QuantileRanks {
  int lower = 0, upper = 0;
};
QuantileRanks quantile_ranks(int n, double share, double confidence = 0.95);

}  // namespace stillhook
