// Measured files that a test writes, and a seeded noise that is the same everywhere.
#pragma once

#include <fmt/core.h>

#include <cmath>
#include <random>

#include "tests/sim/temporary_folder.h"

namespace stillhook {

/// Standard normal numbers by Box and Muller from a 64-bit Mersenne twister: the same on every platform.
class Noise {
 public:
  explicit Noise(unsigned seed) : engine_(seed) {}
  double operator()() {
    if (kept_) {
      kept_ = false;
      return spare_;
    }
    const double u = (static_cast<double>(engine_() >> 11) + 0.5) / 9007199254740992.0;
    const double v = (static_cast<double>(engine_() >> 11) + 0.5) / 9007199254740992.0;
    const double size = std::sqrt(-2.0 * std::log(u)), angle = 6.283185307179586 * v;
    spare_ = size * std::sin(angle);
    kept_ = true;
    return size * std::cos(angle);
  }

 private:
  std::mt19937_64 engine_;
  double spare_ = 0.0;
  bool kept_ = false;
};

/// "t_s,<name>" and a row each.
template <class F>
std::string csv_of(const std::string& name, double duration, double interval, F value) {
  std::string text = "t_s," + name + "\n";
  for (int i = 0; i * interval <= duration + 1e-9; ++i)
    text += fmt::format("{:.6g},{:.12g}\n", i * interval, value(i * interval));
  return text;
}

}  // namespace stillhook
