#include "results/weather/scatter.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

/// Share of a bin's heights at or below a limit.
double share_below(const ScatterBin& bin, double limit) {
  return std::clamp((limit - bin.height_low) / (bin.height_high - bin.height_low), 0.0, 1.0);
}

struct LineFit {
  double slope = 0.0, offset = 0.0, squares = 0.0;
};

LineFit fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sx += x[i];
    sy += y[i];
    sxx += x[i] * x[i];
    sxy += x[i] * y[i];
  }
  LineFit fit;
  fit.slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  fit.offset = (sy - fit.slope * sx) / n;
  for (std::size_t i = 0; i < x.size(); ++i) fit.squares += std::pow(y[i] - fit.offset - fit.slope * x[i], 2);
  return fit;
}

}  // namespace

double ScatterTable::total() const {
  double sum = 0.0;
  for (const ScatterBin& bin : bins) sum += bin.count;
  return sum;
}

bool ScatterTable::has_months() const {
  return std::any_of(bins.begin(), bins.end(), [](const ScatterBin& bin) { return bin.month > 0; });
}

bool ScatterTable::has_directions() const {
  return std::any_of(bins.begin(), bins.end(), [](const ScatterBin& bin) { return !std::isnan(bin.from); });
}

double ScatterTable::exceedance(double height) const {
  double above = 0.0;
  for (const ScatterBin& bin : bins) above += bin.count * (1.0 - share_below(bin, height));
  return above / total();
}

ScatterWorkability judge_scatter(const ScatterTable& table, const OperationLimits& limits, const WeatherRules& rules) {
  ScatterWorkability result;
  std::array<double, 12> counts{}, workable{};
  double linear = 0.0, centre = 0.0;
  for (const ScatterBin& bin : table.bins) {
    const double limit = limit_in(limits, rules, 0.5 * (bin.period_low + bin.period_high), bin.from);
    const double part = std::isnan(limit) ? 0.0 : share_below(bin, limit);
    result.total += bin.count;
    if (std::isnan(limit)) result.outside += bin.count;
    linear += bin.count * part;
    if (0.5 * (bin.height_low + bin.height_high) <= limit) centre += bin.count;
    if (bin.month == 0) continue;
    counts[static_cast<std::size_t>(bin.month - 1)] += bin.count;
    workable[static_cast<std::size_t>(bin.month - 1)] += bin.count * part;
  }
  result.share = linear / result.total;
  result.share_centre = centre / result.total;
  for (std::size_t m = 0; m < 12; ++m) result.by_month[m] = counts[m] > 0.0 ? workable[m] / counts[m] : kNaN;
  return result;
}

double WeibullHeights::exceedance(double height) const {
  return height <= location ? 1.0 : std::exp(-std::pow((height - location) / scale, shape));
}

double WeibullHeights::height_exceeded(double probability) const {
  return location + scale * std::pow(-std::log(probability), 1.0 / shape);
}

double WeibullHeights::mean() const { return location + scale * std::tgamma(1.0 + 1.0 / shape); }

std::optional<WeibullHeights> fit_heights(const ScatterTable& table) {
  std::set<double> edges;
  for (const ScatterBin& bin : table.bins) edges.insert(bin.height_high);
  std::vector<double> heights, y;
  for (const double edge : edges)
    if (const double p = table.exceedance(edge); p > 0.0 && p < 1.0) {
      heights.push_back(edge);
      y.push_back(std::log(-std::log(p)));
    }
  if (heights.size() < 4) return std::nullopt;
  std::optional<WeibullHeights> best;
  double least = 0.0;
  constexpr int kSteps = 100;  // of the location: finer than the tables
  for (int i = 0; i < kSteps; ++i) {
    const double location = heights.front() * i / kSteps;
    std::vector<double> x;
    for (const double h : heights) x.push_back(std::log(h - location));
    const LineFit fit = fit_line(x, y);
    if (!(fit.slope > 0.0) || (best && fit.squares >= least)) continue;
    least = fit.squares;
    best = WeibullHeights{location, std::exp(-fit.offset / fit.slope), fit.slope};
  }
  return best;
}

CalmLaw::CalmLaw(const WeibullHeights& heights, double height) {
  const double p = heights.exceedance(height), mean = heights.mean();
  const double g = heights.shape + 1.8 * heights.location / (mean - heights.location);
  mean_h_ = 35.0 / std::sqrt(g) * (1.0 - p) / (p * std::pow(-std::log(p), 0.6 * std::pow(g, 0.287)));
  exponent_ = 0.267 * g * std::pow(height / mean, -0.4);
  factor_ = std::pow(std::tgamma(1.0 + 1.0 / exponent_), exponent_);
}

double CalmLaw::longer_than(double hours) const { return std::exp(-factor_ * std::pow(hours / mean_h_, exponent_)); }

}  // namespace stillhook
