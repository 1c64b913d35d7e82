// A name for what a computation depends on.
#pragma once

#include <cstdint>
#include <iomanip>
#include <sstream>
#include <string>

#include "sim/spatial/pose.h"

namespace stillhook {

/// FNV-1a, 64 bit.
class ContentHash {
 public:
  void add(const void* data, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; ++i) {
      value_ ^= static_cast<const unsigned char*>(data)[i];
      value_ *= 1099511628211ull;
    }
  }
  void add(double value) { add(&value, sizeof value); }
  void add(const Vector3& v) { add(v.data(), 3 * sizeof(double)); }
  void add(const MatrixX& M) { add(M.data(), static_cast<std::size_t>(M.size()) * sizeof(double)); }
  void add(const std::string& text) { add(text.data(), text.size()); }
  std::string text() const {
    std::ostringstream out;
    out << std::hex << std::setw(16) << std::setfill('0') << value_;
    return out.str();
  }

 private:
  std::uint64_t value_ = 14695981039346656037ull;
};

}  // namespace stillhook
