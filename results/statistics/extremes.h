// Largest values: the Gumbel distribution P(max <= x) = exp(-exp(-(x - location)/scale)), and what a Gaussian process
// reaches in a given time.
//
// Moments: scale = sd sqrt(6)/pi, location = mean - 0.5772 scale. L-moments (Hosking, J. R. Stat. Soc. B 52 (1990)
// 105): scale = l2/ln 2. Likelihood: scale = mean - sum(x e^(-x/scale))/sum(e^(-x/scale)), location = -scale ln
// mean(e^(-x/scale)). A Gaussian process of N cycles stays below L with P = exp(-N exp(-L^2/(2 sigma^2))) (Ochi, J.
// Ship Res. 17 (1973) 116).
#pragma once

#include <vector>

namespace stillhook {

inline constexpr double kEulerGamma = 0.57721566490153286;

struct Gumbel {
  double location = 0.0;  // the most probable maximum
  double scale = 0.0;     // > 0
  double quantile(double p) const;
  double probability(double x) const;  // of a value of at most x
};

/// From at least two values that differ; NaN otherwise.
Gumbel gumbel_by_moments(const std::vector<double>& values);
Gumbel gumbel_by_l_moments(std::vector<double> values);
Gumbel gumbel_by_likelihood(const std::vector<double>& values);

/// Standard deviation of the p quantile as estimated by likelihood from n values:
/// scale sqrt((1.10867 + 0.51404 y + 0.60793 y^2)/n), y = -ln(-ln p).
double gumbel_quantile_error(const Gumbel& gumbel, int n, double p);

/// The distribution of the largest value in a time `ratio` times as long, of a stationary process.
Gumbel over_longer_time(const Gumbel& gumbel, double ratio);

/// True if the values are not Gumbel distributed, by Anderson & Darling's test at 5 % with both parameters estimated by
/// likelihood: A^2 (1 + 0.2/sqrt(n)) > 0.757 (Stephens, Biometrika 64 (1977) 583). Values that are all equal are not.
bool gumbel_is_rejected(std::vector<double> values);

/// What the largest of N cycles stays below with probability p; sigma of the process in any unit. The most probable
/// maximum is p = 1/e.
double gaussian_largest(double sigma, double cycles, double p);

/// Significant wave height at which the largest of N cycles of a linear response stays below `limit` with probability
/// p; `sigma` of the response is that at Hs = 1 m.
double gaussian_limiting_height(double limit, double sigma, double cycles, double p);

}  // namespace stillhook
