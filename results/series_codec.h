// Numbers over time as few bytes, for a page that carries its own data.
//
//   v ~ low + step q,  q = 0 .. 65534, 65535 = no value;  |error| <= step/2, step = (largest - smallest)/65534
//
// q is stored as differences of first or second order (whichever are smaller), modulo 2^16, zigzag-coded so that small
// ones of either sign have a zero high byte, all low bytes first, then all high bytes. A smooth signal becomes long
// runs of nearly equal bytes, which deflate packs well. The same is read back by viewer/source/payload.js.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stillhook {

struct PackedSeries {
  double low = 0.0, step = 0.0;  // step 0: constant
  int order = 1;                 // of the differences
  std::string bytes;             // 2 a value
};

/// Values that are not finite become gaps.
PackedSeries pack_series(std::span<const double> values);

/// Whole numbers as second differences modulo 2^32, zigzag-coded, in four planes of bytes.
std::string pack_integers(std::span<const std::uint32_t> values);

/// zlib's format (RFC 1950), which browsers call "deflate". Throws std::runtime_error.
std::string deflated(std::string_view bytes);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace stillhook
