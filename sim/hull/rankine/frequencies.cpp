#include "sim/hull/rankine/frequencies.h"

#include <algorithm>
#include <cmath>

#include "sim/sea/dispersion.h"

namespace stillhook::rankine {
namespace {

double largest_diagonal(const Layout& layout) {
  double diagonal = 0.0;
  for (const Placement& p : layout.hulls) diagonal = std::max(diagonal, std::hypot(p.length, p.breadth));
  return diagonal;
}

/// Of one hull that takes as many panels as all together.
double joint_diagonal(const Layout& layout) {
  double squares = 0.0;
  for (const Placement& p : layout.hulls) squares += p.length * p.length + p.breadth * p.breadth;
  return std::sqrt(squares);
}

}  // namespace

double deep_frequency(double frequency, double gravity, double depth) {
  return std::isinf(depth) ? frequency : std::sqrt(gravity * wave_number(frequency, gravity, depth));
}

double frequency_over_bed(double deep, double gravity, double depth) {
  return std::isinf(depth) ? deep : wave_frequency(deep * deep / gravity, gravity, depth);
}

double highest_frequency(double diagonal, const PanelMethodOptions& options) {
  if (options.highest > 0.0) return options.highest;
  const double affordable =
      frequency_over_bed(std::sqrt(2.0 * kHighestPhase * options.gravity / diagonal), options.gravity, options.depth);
  // Never so low that the band has no room above its lowest frequency.
  return std::max(2.0 * options.lowest, std::min(std::max(kHighest, options.sea_highest), affordable));
}

double highest_frequency(const Layout& layout, const PanelMethodOptions& options) {
  return highest_frequency(joint_diagonal(layout), options);
}

std::vector<double> frequencies_of(const Layout& layout, const PanelMethodOptions& options) {
  if (!options.chosen.empty()) return options.chosen;
  const double highest = highest_frequency(layout, options), range = std::log(highest / options.lowest);
  if (options.frequencies > 0) {
    std::vector<double> frequencies(options.frequencies);
    for (int i = 0; i < options.frequencies; ++i)
      frequencies[i] = options.lowest * std::exp(range * i / (options.frequencies - 1.0));
    return frequencies;
  }
  const double lowest = deep_frequency(options.lowest, options.gravity, options.depth);
  const double end = deep_frequency(highest, options.gravity, options.depth);
  // The number of steps from the lowest frequency to w, as a continuous function of w: where a step in the logarithm
  // takes the phase k l/2 by more than kPhase, as many as there are steps of that.
  const double step = std::log(kHighest / 0.2) / (kFrequencies - 1.0);
  const double phase = 0.5 * largest_diagonal(layout) / options.gravity;  // per (rad/s)2
  const double turn = std::sqrt(kPhase / (2.0 * phase * step));           // rad/s: d(phase)/d(log w) step = kPhase
  const auto steps_to = [&](double w) {
    const double even = std::log(std::min(w, std::max(turn, lowest)) / lowest) / step;
    const double from = std::max(turn, lowest);
    return w <= from ? even : even + phase * (w * w - from * from) / kPhase;
  };
  const int count = std::max(4, static_cast<int>(std::ceil(steps_to(end) - 1e-9)) + 1);
  std::vector<double> frequencies{options.lowest};
  double w = lowest;
  for (int i = 1; i + 1 < count; ++i) {
    const double wanted = steps_to(end) * i / (count - 1.0);
    double low = w, high = end;
    for (int halving = 0; halving < 60; ++halving) (steps_to(w = 0.5 * (low + high)) < wanted ? low : high) = w;
    frequencies.push_back(frequency_over_bed(w, options.gravity, options.depth));
  }
  frequencies.push_back(highest);
  return frequencies;
}

}  // namespace stillhook::rankine
