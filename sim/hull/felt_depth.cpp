#include "sim/hull/felt_depth.h"

#include <algorithm>
#include <cmath>

#include "sim/sea/dispersion.h"

namespace stillhook {
namespace {

constexpr double kLong = 1.0;    // of k length
constexpr double kDeep = 0.1;    // how far k / Vg may be from that of deep water, relative
constexpr double kAgree = 0.1;   // of the next frequency with the depth of the first
constexpr double kLeast = 1e-4;  // of the largest B_33: less is rounding

struct Ratio {
  double frequency = 0.0;  // rad/s
  double value = 0.0;      // k / Vg of the set, of that in deep water
};

std::vector<Ratio> ratios(const HydrodynamicCoefficients& set) {
  const ExcitationTable& X = set.excitation;
  double largest = 0.0;
  for (const FrequencyCoefficients& f : set.frequency) largest = std::max(largest, f.B(2, 2));
  std::vector<Ratio> result;
  for (const FrequencyCoefficients& f : set.frequency) {
    const double w = f.frequency, B = f.B(2, 2);
    const auto at = std::ranges::find_if(X.frequencies, [&](double x) { return std::abs(x - w) <= 1e-6 * w; });
    if (at == X.frequencies.end() || w * w / set.gravity * set.length > kLong || !(B > kLeast * largest)) continue;
    double square = 0.0;
    for (std::size_t h = 0; h < X.headings.size(); ++h)
      square += std::norm(X.at(static_cast<int>(at - X.frequencies.begin()), static_cast<int>(h), 2));
    square /= static_cast<double>(X.headings.size());
    if (square > 0.0)
      result.push_back({w, 2.0 * set.density * std::pow(set.gravity, 3) * B / (std::pow(w, 3) * square)});
  }
  return result;
}

/// k / Vg at a depth, of that in deep water.
double ratio_at(double frequency, double gravity, double depth) {
  const double deep = frequency * frequency / gravity, k = wave_number(frequency, gravity, depth);
  return k / group_velocity(frequency, gravity, depth) / (2.0 * deep * frequency / gravity);
}

/// Falls with the depth from infinity, a little below 1, and rises to it again: the shallow branch.
double depth_of(const Ratio& r, double gravity) {
  double shallow = 1e-3, deep = gravity / (r.frequency * r.frequency);
  for (int n = 0; n < 80; ++n) {
    const double middle = std::sqrt(shallow * deep);
    (ratio_at(r.frequency, gravity, middle) > r.value ? shallow : deep) = middle;
  }
  return shallow;
}

}  // namespace

std::optional<double> felt_depth(const HydrodynamicCoefficients& set) {
  if (set.hulls() != 1 || set.excitation.empty()) return std::nullopt;
  const std::vector<Ratio> found = ratios(set);
  if (found.size() < 2 || !(found[0].value > 1.0 + kDeep)) return std::nullopt;
  const double depth = depth_of(found[0], set.gravity);
  const double next = ratio_at(found[1].frequency, set.gravity, depth);
  if (std::abs(found[1].value - next) > kAgree * next) return std::nullopt;
  return depth;
}

}  // namespace stillhook
