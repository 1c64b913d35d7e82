// Limiting significant wave heights over peak period and heading, by phase of an operation.
//
// Between the given periods and headings a limit is bilinear, in heading around the circle; below the shortest and
// above the longest period there is none. Headings are the direction that waves travel towards, relative to the bow,
// positive to port (counter-clockwise from above): 180 deg from ahead, 0 from astern, +90 from starboard abeam.
#pragma once

#include <string>
#include <vector>

namespace stillhook {

class LimitSurface {
 public:
  LimitSurface() = default;
  /// A limit that holds in every sea.
  explicit LimitSurface(double height);
  /// `periods` s, ascending; empty: the limit does not depend on the period. `headings` rad, ascending within [0, 2
  /// pi); empty: not on the heading. `heights` m, [period][heading], with one entry where an axis is empty. Throws
  /// std::invalid_argument for sizes that do not fit.
  LimitSurface(std::vector<double> periods, std::vector<double> headings, std::vector<std::vector<double>> heights);

  /// NaN outside the periods, and for a period or heading that is NaN though the limit depends on it.
  double at(double period, double heading) const;
  /// Lowest limit over all headings (those given: between them it is linear).
  double lowest(double period) const;

  const std::vector<double>& periods() const { return periods_; }
  const std::vector<double>& headings() const { return headings_; }
  const std::vector<std::vector<double>>& heights() const { return heights_; }

 private:
  /// Limit of a row of headings.
  double along(const std::vector<double>& row, double heading) const;
  template <class RowValue>
  double between_periods(double period, RowValue value) const;

  std::vector<double> periods_, headings_;
  std::vector<std::vector<double>> heights_;
};

/// The limits of a phase; the name is empty when the limits are of the whole operation.
struct PhaseLimit {
  std::string phase;
  LimitSurface limit;
};

/// The limits of an operation: all of them hold at once for work in any sample.
struct OperationLimits {
  std::vector<PhaseLimit> phases;  // at least one
  bool depends_on_period() const;
  bool depends_on_heading() const;
  /// Lowest of the phases' limits; NaN if one of them has none there.
  double at(double period, double heading) const;
  double lowest(double period) const;
  /// The best heading of the operation in waves of this period: the largest lowest limit. Exact for a limit without
  /// phases; with several, searched at every given heading and every degree.
  double highest(double period) const;
};

}  // namespace stillhook
