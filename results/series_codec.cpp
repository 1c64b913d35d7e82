#include "results/series_codec.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace stillhook {
namespace {

constexpr std::uint16_t kGap = 65535;
constexpr double kLevels = 65534.0;

/// Small numbers of either sign as small unsigned ones: 0, -1, 1, -2 -> 0, 1, 2, 3.
template <class Unsigned>
Unsigned zigzag(Unsigned difference) {
  constexpr int kTop = std::numeric_limits<Unsigned>::digits - 1;
  const Unsigned sign = static_cast<Unsigned>(-(difference >> kTop));
  return static_cast<Unsigned>(static_cast<Unsigned>(difference << 1) ^ sign);
}

template <class Unsigned>
std::vector<Unsigned> differences(const std::vector<Unsigned>& values) {
  std::vector<Unsigned> out(values.size());
  Unsigned before = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    out[i] = static_cast<Unsigned>(values[i] - before);
    before = values[i];
  }
  return out;
}

template <class Unsigned>
std::string planes(const std::vector<Unsigned>& coded) {
  std::string bytes(coded.size() * sizeof(Unsigned), '\0');
  for (std::size_t plane = 0; plane < sizeof(Unsigned); ++plane)
    for (std::size_t i = 0; i < coded.size(); ++i)
      bytes[plane * coded.size() + i] = static_cast<char>(coded[i] >> (8 * plane) & 0xff);
  return bytes;
}

std::vector<std::uint16_t> levels(std::span<const double> values, double low, double step) {
  std::vector<std::uint16_t> q(values.size(), kGap);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i]))
      q[i] = step > 0.0 ? static_cast<std::uint16_t>(std::lround((values[i] - low) / step)) : std::uint16_t{0};
  return q;
}

}  // namespace

PackedSeries pack_series(std::span<const double> values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double v : values)
    if (std::isfinite(v)) {
      low = std::min(low, v);
      high = std::max(high, v);
    }
  PackedSeries packed;
  if (low <= high) {
    packed.low = low;
    packed.step = (high - low) / kLevels;
  }
  std::vector<std::uint16_t> first = differences(levels(values, packed.low, packed.step));
  std::vector<std::uint16_t> second = differences(first);
  double first_sum = 0.0, second_sum = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    first_sum += first[i] = zigzag(first[i]);
    second_sum += second[i] = zigzag(second[i]);
  }
  packed.order = second_sum < first_sum ? 2 : 1;
  packed.bytes = planes(packed.order == 2 ? second : first);
  return packed;
}

std::string pack_integers(std::span<const std::uint32_t> values) {
  std::vector<std::uint32_t> coded = differences(differences(std::vector<std::uint32_t>(values.begin(), values.end())));
  for (std::uint32_t& v : coded) v = zigzag(v);
  return planes(coded);
}

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  const int code = compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                             static_cast<uLong>(bytes.size()), 6);
  if (code != Z_OK) throw std::runtime_error("the replay data cannot be compressed: zlib code " + std::to_string(code));
  out.resize(size);
  return out;
}

std::string base64(std::string_view bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += k <= n ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

}  // namespace stillhook
