#include "sim/hull/silent_modes.h"

#include <algorithm>
#include <cmath>

namespace stillhook {
namespace {

constexpr double kNoRadiation = 1e-5;

/// Largest |X| of the modes of a hull that are forces, or moments, as mode is.
double largest_excitation(const ExcitationTable& X, int first, int count) {
  double largest = 0.0;
  for (std::size_t n = 0; n < X.value.size(); ++n) {
    const int mode = static_cast<int>(n) % X.modes;
    if (mode >= first && mode < first + count) largest = std::max(largest, std::abs(X.value[n]));
  }
  return largest;
}

}  // namespace

double displaced_inertia(const HydrodynamicCoefficients& c, int mode) {
  const std::size_t hull = static_cast<std::size_t>(mode / 6);
  const double mass = c.density * c.volume[hull];
  if (mode % 6 < 3) return mass;
  double square = std::pow(0.25 * c.length, 2);
  if (mode % 6 == 5 && hull < c.waterplane.size()) square += std::pow(c.waterplane[hull] / c.length, 2) / 12.0;
  return mass * square;
}

std::vector<bool> silent_modes(const HydrodynamicCoefficients& c) {
  std::vector<bool> silent(static_cast<std::size_t>(c.modes()), !c.frequency.empty() || !c.retardation.empty());
  for (int i = 0; i < c.modes(); ++i) {
    const double m = displaced_inertia(c, i);
    bool quiet = silent[static_cast<std::size_t>(i)];
    for (const FrequencyCoefficients& f : c.frequency)
      quiet = quiet && std::abs(f.B(i, i)) <= kNoRadiation * f.frequency * m &&
              std::abs(f.A(i, i) - c.A_inf(i, i)) <= kNoRadiation * m;
    // A kernel of peak K does no more than K (a second)^2 of inertia.
    if (c.frequency.empty())
      for (const RetardationKernel& kernel : c.retardation.kernels)
        if (kernel.i == i && kernel.j == i)
          for (const double K : kernel.value) quiet = quiet && std::abs(K) <= kNoRadiation * m;
    silent[static_cast<std::size_t>(i)] = quiet;
  }
  return silent;
}

HydrodynamicCoefficients without_noise(HydrodynamicCoefficients c) {
  const std::vector<bool> silent = silent_modes(c);
  for (int i = 0; i < c.modes(); ++i) {
    if (!silent[static_cast<std::size_t>(i)]) continue;
    if (std::abs(c.A_inf(i, i)) <= kNoRadiation * displaced_inertia(c, i)) {
      c.A_inf.row(i).setZero();
      c.A_inf.col(i).setZero();
    }
    for (FrequencyCoefficients& f : c.frequency) {
      f.A.row(i) = c.A_inf.row(i);
      f.A.col(i) = c.A_inf.col(i);
      f.B.row(i).setZero();
      f.B.col(i).setZero();
    }
    std::erase_if(c.retardation.kernels, [&](const RetardationKernel& k) { return k.i == i || k.j == i; });
    const int first = i - i % 3;
    const double noise = kNoRadiation * largest_excitation(c.excitation, first, 3);
    if (!c.excitation.empty() && largest_excitation(c.excitation, i, 1) <= noise)
      for (std::size_t n = static_cast<std::size_t>(i); n < c.excitation.value.size();
           n += static_cast<std::size_t>(c.excitation.modes))
        c.excitation.value[n] = 0.0;
  }
  return c;
}

}  // namespace stillhook
