// The time that an operation is planned to need, and the factor on its limit for the doubt in a forecast.
#pragma once

#include <vector>

namespace stillhook {

/// Longest planned operation that a forecast can carry, h. A longer one is weather-unrestricted and has no alpha
/// factor.
inline constexpr double kLongestForecastOperation = 72.0;

/// T_R = T_POP + T_C.
struct ReferencePeriod {
  double planned_h = 0.0;      // T_POP
  double contingency_h = 0.0;  // T_C
  double total_h() const { return planned_h + contingency_h; }
};

/// T_C = max(share T_POP, 6 h).
ReferencePeriod reference_period(double planned_h, double contingency_share = 0.5);

/// Factors by planned operation period and by limiting height: linear between heights, constant beyond them.
class AlphaTable {
 public:
  struct Row {
    double planned_at_most_h = 0.0, height = 0.0, factor = 1.0;
  };
  /// The built-in table: for a forecast without a meteorologist or measurements on site, from general knowledge of
  /// DNV-OS-H101. To be replaced by the table of a licensed copy.
  AlphaTable();
  /// Throws std::invalid_argument: no rows, a factor outside (0, 1], two rows for one period and height.
  explicit AlphaTable(std::vector<Row> rows);

  /// Of a limit (m) and a time (h, of the operation or ahead in the forecast). Throws std::invalid_argument for a time
  /// beyond the table.
  double factor(double time_h, double height) const;
  double longest_h() const { return rows_.back().planned_at_most_h; }
  const std::vector<Row>& rows() const { return rows_; }

 private:
  std::vector<Row> rows_;  // by period, then height
};

}  // namespace stillhook
