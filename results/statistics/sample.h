// Mean, quantile and resampling of a sample.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace stillhook {

/// Both ends of an interval; NaN where there is no such end.
struct Interval {
  double low = 0.0, high = 0.0;
};

/// NaN for no values.
double mean_of(const std::vector<double>& values);

/// Quantile of a sample, 0 <= q <= 1: linear between order statistics (type 7 of Hyndman & Fan, Am. Stat. 50 (1996)
/// 361). NaN for no values.
double quantile_of(std::vector<double> values, double q);

/// 90 % interval of a statistic of `size` things by resampling them with replacement (Efron & Tibshirani 1993). The
/// statistic gets the indices drawn. Resampling is seeded: same sample, same interval.
///
/// Where several results come from the same things (columns of a table that were simulated in the same seeds), one
/// drawing for all of them keeps what their errors have in common.
Interval bootstrap_interval(std::size_t size, const std::function<double(const std::vector<std::size_t>&)>& statistic,
                            int resamples = 2000);

}  // namespace stillhook
