#include "problems/shallow_water.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/sea/dispersion.h"
#include "sim/sea/sea_statistics.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

/// Of a box barge, 110 m x 46 m, draft 4 m, heave over deep water: |X3| in beam seas and B33, computed with HAMS (Liu
/// 2019) on three meshes each and extrapolated; rows of 40, 20 and 10 m of water.
constexpr std::array<double, 7> kFrequency = {0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0};  // rad/s
constexpr std::array<double, 3> kDepth = {40.0, 20.0, 10.0};                       // m
using Ratios = std::array<std::array<double, 7>, 3>;
constexpr Ratios kForce = {{{1.07, 1.14, 1.17, 1.15, 1.10, 1.07, 1.05},
                            {1.07, 1.22, 1.36, 1.38, 1.35, 1.33, 1.32},
                            {1.10, 1.34, 1.51, 1.52, 1.51, 1.57, 1.80}}};
constexpr Ratios kDamping = {{{1.86, 1.40, 1.22, 1.14, 1.11, 1.10, 1.10},
                              {3.02, 2.17, 1.81, 1.63, 1.56, 1.55, 1.58},
                              {4.88, 3.35, 2.70, 2.41, 2.36, 2.45, 2.77}}};

/// Linear in frequency and in the logarithm of the depth; outside the table its edge.
double between(const Ratios& table, double frequency, double depth) {
  const double w = std::clamp(frequency, kFrequency.front(), kFrequency.back());
  const double h = std::clamp(depth, kDepth.back(), kDepth.front());
  std::size_t i = 0, j = 0;
  while (i + 2 < kFrequency.size() && kFrequency[i + 1] < w) ++i;
  while (j + 2 < kDepth.size() && kDepth[j + 1] > h) ++j;
  const double s = (w - kFrequency[i]) / (kFrequency[i + 1] - kFrequency[i]);
  const double r = std::log(h / kDepth[j]) / std::log(kDepth[j + 1] / kDepth[j]);
  return (1.0 - r) * ((1.0 - s) * table[j][i] + s * table[j][i + 1]) +
         r * ((1.0 - s) * table[j + 1][i] + s * table[j + 1][i + 1]);
}

/// The hulls whose coefficients know of no bed, with commas in between.
std::string without_bed(const Model& model) {
  std::string names;
  const std::vector<BodySpec>& bodies = model.specification().bodies;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!bodies[k].floats() || bodies[k].hydrodynamics.kind == HydrodynamicsSpec::Kind::none) continue;
    const auto& set = model.coefficients(static_cast<int>(k)).set;
    if (!set || std::isinf(set->depth)) names += (names.empty() ? "" : ", ") + bodies[k].name;
  }
  return names;
}

std::string of_hulls(const std::string& names, double frequency, double depth) {
  const auto percent = [&](const Ratios& table) { return 100.0 * (between(table, frequency, depth) - 1.0); };
  const char* than = depth > kDepth.front() ? "less than " : depth < kDepth.back() ? "more than " : "";
  return fmt::format(
      "what {} does to them is calculated without the bed, where a box barge of 110 m x 46 m with a draft of 4 m, "
      "for one, lacks {}{:.0f} % of the heave force it has in beam seas of this period and {}{:.0f} % of its heave "
      "damping; "
      "kind = \"panels\" is computed over the bed",
      names, than, 100.0 - 1e4 / (100.0 + percent(kForce)), than, 100.0 - 1e4 / (100.0 + percent(kDamping)));
}

}  // namespace

std::vector<std::string> shallow_water_gaps(const Model& model) {
  const SeaSpec& sea = model.specification().sea;
  const SeaStateSpec* state = sea.active_state();
  if (!state || !(sea.depth > 0.0)) return {};
  const std::vector<SeaStatistics> numbers = sea_statistics(*state);
  if (numbers.empty() || !(numbers.back().significant_height > 0.0)) return {};
  // Of several systems the longest feels the bottom first, though another may hold the energy.
  double period = 0.0;
  for (const SeaStatistics& system : numbers) period = std::max(period, system.long_period);
  const double omega = kTwoPi / period, h = sea.depth;
  const double deep = kTwoPi * sea.gravity / (omega * omega);
  if (!(h < 0.5 * deep)) return {};
  const double length = kTwoPi / wave_number(omega, sea.gravity, h);
  std::vector<std::string> gaps;
  if (sea.deep_waves)
    gaps.push_back(
        fmt::format("the waves feel the bottom: those of {:.1f} s are {:.0f} m long in {:.1f} m of water; they are "
                    "calculated as waves of deep water, {:.0f} m long, because of sea.deep_waves, and hulls as in deep "
                    "water",
                    period, length, h, deep));
  else if (const std::string names = without_bed(model); !names.empty())
    gaps.push_back(fmt::format(
        "the waves feel the bottom: those of {:.1f} s are {:.0f} m long in {:.1f} m of water, {:.1f} % shorter than in "
        "deep water; {}",
        period, length, h, 100.0 * (1.0 - length / deep), of_hulls(names, omega, h)));
  // Height of the largest wave there is, or of the mean of the highest third.
  const bool regular = state->type == SeaStateSpec::Type::regular;
  const double height = regular ? 2.0 * state->amplitude : numbers.back().significant_height;
  constexpr double kUrsell = 26.0;
  if (const double ursell = height * length * length / (h * h * h); ursell > kUrsell && !sea.deep_waves)
    gaps.push_back(
        fmt::format("the waves are too high for linear theory in so little water: height x length^2 / depth^3 (Ursell) "
                    "is {:.0f}, at "
                    "most 26; real crests are higher and shorter and troughs flatter, and forces differ accordingly",
                    ursell));
  return gaps;
}

}  // namespace stillhook
