#include "results/weather/alpha.h"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace stillhook {

ReferencePeriod reference_period(double planned_h, double contingency_share) {
  return {planned_h, std::max(contingency_share * planned_h, 6.0)};
}

AlphaTable::AlphaTable()
    : AlphaTable(std::vector<Row>{{12, 1, 0.65}, {12, 2, 0.76}, {12, 4, 0.79}, {12, 6, 0.80}, {24, 1, 0.63},
                                  {24, 2, 0.73}, {24, 4, 0.76}, {24, 6, 0.78}, {36, 1, 0.62}, {36, 2, 0.71},
                                  {36, 4, 0.73}, {36, 6, 0.76}, {48, 1, 0.60}, {48, 2, 0.68}, {48, 4, 0.71},
                                  {48, 6, 0.74}, {72, 1, 0.55}, {72, 2, 0.63}, {72, 4, 0.68}, {72, 6, 0.72}}) {}

AlphaTable::AlphaTable(std::vector<Row> rows) : rows_(std::move(rows)) {
  if (rows_.empty()) throw std::invalid_argument("the table of alpha factors has no rows");
  std::sort(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) {
    return std::tie(a.planned_at_most_h, a.height) < std::tie(b.planned_at_most_h, b.height);
  });
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    if (!(row.factor > 0.0 && row.factor <= 1.0))
      throw std::invalid_argument(fmt::format("an alpha factor must be in (0, 1], got {:g}", row.factor));
    if (i > 0 && rows_[i - 1].planned_at_most_h == row.planned_at_most_h && rows_[i - 1].height == row.height)
      throw std::invalid_argument(fmt::format("there are two alpha factors for {:g} h and {:g} m, keep one of them",
                                              row.planned_at_most_h, row.height));
  }
}

double AlphaTable::factor(double time_h, double height) const {
  const auto first =
      std::find_if(rows_.begin(), rows_.end(), [&](const Row& row) { return time_h <= row.planned_at_most_h + 1e-9; });
  if (first == rows_.end())
    throw std::invalid_argument(
        fmt::format("{:g} h is beyond the table of alpha factors, which ends at {:g} h", time_h, longest_h()));
  const Row* below = &*first;
  for (auto row = first; row != rows_.end() && row->planned_at_most_h == first->planned_at_most_h; ++row) {
    if (height <= row->height) {
      if (row == first) return row->factor;
      const double part = (height - below->height) / (row->height - below->height);
      return below->factor + part * (row->factor - below->factor);
    }
    below = &*row;
  }
  return below->factor;
}

}  // namespace stillhook
