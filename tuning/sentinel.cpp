#include "tuning/sentinel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace stillhook {
namespace {

/// Magnitudes that loggers, databases and NetCDF's default write where nothing was measured.
constexpr std::array kUsual = {99.0,    99.9,         99.99,        999.0,   999.25,   999.9,     999.99,     9999.0,
                               9999.9,  9999.99,      99999.0,      99999.9, 999999.0, 9999999.0, 99999999.0, 32767.0,
                               32768.0, 2147483647.0, 2147483648.0, 1e10,    1e20,     1e30,      1e35,       1e36,
                               1e37,    1e38,         8888.0,       88888.0, 7777.0,   77777.0};

bool is_usual(double value) {
  const double size = std::abs(value);
  // Of single precision they keep seven digits.
  return std::any_of(kUsual.begin(), kUsual.end(), [&](double u) { return std::abs(size - u) <= 1e-7 * u; });
}

}  // namespace

std::optional<Sentinel> sentinel_in(const std::vector<double>& values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values)
    if (!std::isnan(value) && !is_usual(value)) low = std::min(low, value), high = std::max(high, value);
  if (!(low <= high)) return std::nullopt;
  const double span = high - low;
  std::optional<Sentinel> found;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = values[i];
    const bool far_off = value < low - span || value > high + span;
    if (std::isnan(value) || !far_off || !is_usual(value)) continue;
    if (!found) found = {value, i, 0};
    if (value == found->value) ++found->count;
  }
  return found;
}

}  // namespace stillhook
