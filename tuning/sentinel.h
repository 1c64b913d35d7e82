// Numbers that stand for "nothing measured", as -9999, in files that have no way to say so.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace stillhook {

struct Sentinel {
  double value = 0.0;
  std::size_t first = 0;  // row
  std::size_t count = 0;
};

/// The number of this kind that stands in a column, if there is one: a usual one, and farther from all the others than
/// these are from each other. NaN are gaps and do not count.
std::optional<Sentinel> sentinel_in(const std::vector<double>& values);

}  // namespace stillhook
