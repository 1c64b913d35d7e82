#include "sim/sea/dispersion.h"

#include <algorithm>
#include <cmath>

namespace stillhook {

double wave_number(double frequency, double gravity, double depth) {
  const double deep = frequency * frequency / gravity;
  if (std::isinf(depth) || deep * depth > kDeepWater) return deep;
  // Newton on f(k) = k tanh(k h) - w2/g from above, where f is convex: no step overshoots.
  double k = std::max(deep, std::sqrt(deep / depth)) * 1.2;
  for (int n = 0; n < 60; ++n) {
    const double t = std::tanh(k * depth);
    const double step = (k * t - deep) / (t + k * depth * (1.0 - t * t));
    k -= step;
    if (std::abs(step) < 1e-14 * k) break;
  }
  return k;
}

double wave_frequency(double wavenumber, double gravity, double depth) {
  return std::sqrt(gravity * wavenumber * (std::isinf(depth) ? 1.0 : std::tanh(wavenumber * depth)));
}

double group_velocity(double frequency, double gravity, double depth) {
  const double k = wave_number(frequency, gravity, depth), kh = k * depth;
  const double bed = kh > kDeepWater ? 0.0 : 2.0 * kh / std::sinh(2.0 * kh);
  return 0.5 * frequency / k * (1.0 + bed);
}

double bed_reflection(double wavenumber, double depth) {
  const double kh = wavenumber * depth;
  return kh > kDeepWater ? 0.0 : std::exp(-2.0 * kh);
}

}  // namespace stillhook
