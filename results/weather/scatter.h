// Counts of sea states by height, period, direction and month, when a record over time is not at hand.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "results/weather/workability.h"

namespace stillhook {

struct ScatterBin {
  int month = 0;      // 1 to 12; 0: of the whole year
  double from = 0.0;  // rad, compass direction that the waves come from, middle of the bin; NaN: of all directions
  double height_low = 0.0, height_high = 0.0;  // m
  double period_low = 0.0, period_high = 0.0;  // s, peak period
  double count = 0.0;                          // of samples, or a share
};

struct ScatterTable {
  std::vector<ScatterBin> bins;
  std::vector<std::string> remarks = {};
  double total() const;
  bool has_months() const;
  bool has_directions() const;
  /// P(Hs > height), the counts of a bin spread evenly over its heights.
  double exceedance(double height) const;
};

struct ScatterWorkability {
  double share = 0.0;         // bins that the limit cuts are shared linearly
  double share_centre = 0.0;  // bins counted whole, by their middle: what tables on paper do
  double outside = 0.0;       // counts at periods that the limits do not cover; not workable
  double total = 0.0;
  std::array<double, 12> by_month{};  // NaN for a month without counts
};

/// The limit of a bin is that in the middle of its period and direction. The rules' wind and daylight cannot be
/// applied.
ScatterWorkability judge_scatter(const ScatterTable& table, const OperationLimits& limits, const WeatherRules& rules);

/// Weibull distribution of heights, P(Hs > h) = exp(-((h - location)/scale)^shape).
struct WeibullHeights {
  double location = 0.0, scale = 1.0, shape = 1.0;
  double exceedance(double height) const;
  double height_exceeded(double probability) const;
  double mean() const;
};

/// Fitted to the exceedances at the upper edges of the table's bins, each weighted alike, by least squares on ln(-ln P)
/// over ln(h - location); the location is the best on a grid below the lowest edge. Nothing for fewer than four edges
/// with 0 < P < 1.
std::optional<WeibullHeights> fit_heights(const ScatterTable& table);

/// How long calms below a height last, from the distribution of heights alone: the empirical NMI law of Kuwashima &
/// Hogben (Coastal Eng. 9 (1986) 511), an estimate. With P the exceedance of the height, g = k + 1.8 x0/(hm - x0):
///
///     tau = 35 g^-0.5 (1 - P)/(P (-ln P)^(0.6 g^0.287)) h      mean length of a calm
///     P(longer than t) = exp(-C (t/tau)^al),  al = 0.267 g (height/hm)^-0.4,  C = Gamma(1 + 1/al)^al
class CalmLaw {
 public:
  CalmLaw(const WeibullHeights& heights, double height);
  double mean_h() const { return mean_h_; }
  double longer_than(double hours) const;

 private:
  double mean_h_ = 0.0, exponent_ = 1.0, factor_ = 1.0;
};

}  // namespace stillhook
