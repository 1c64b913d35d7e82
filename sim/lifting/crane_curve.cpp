#include "sim/lifting/crane_curve.h"

#include <algorithm>

#include "sim/sea/sea_statistics.h"
#include "sim/spatial/constants.h"
#include "sim/specification.h"

namespace stillhook {

double capacity_at(const CraneCurveSpec& curve, double radius) {
  if (curve.radius.empty() || !(radius >= curve.radius.front() && radius <= curve.radius.back())) return kNaN;
  return nearest_capacity(curve, radius);
}

double nearest_capacity(const CraneCurveSpec& curve, double radius) {
  const auto above = std::upper_bound(curve.radius.begin(), curve.radius.end(), radius);
  if (above == curve.radius.begin()) return curve.capacity.front();
  if (above == curve.radius.end()) return curve.capacity.back();
  const std::size_t i = static_cast<std::size_t>(above - curve.radius.begin());
  const double share = (radius - curve.radius[i - 1]) / (curve.radius[i] - curve.radius[i - 1]);
  return curve.capacity[i - 1] + share * (curve.capacity[i] - curve.capacity[i - 1]);
}

double curve_sea_height(const Specification& s) {
  const SeaStateSpec* state = s.sea.active_state();
  if (!state || state->type == SeaStateSpec::Type::calm) return 0.0;
  if (state->type == SeaStateSpec::Type::regular) return 2.0 * state->amplitude;
  const std::vector<SeaStatistics> all = sea_statistics(*state);
  return all.empty() ? 0.0 : all.back().significant_height;
}

const CraneCurveSpec* curve_of(const Specification& s, const std::string& crane) {
  const double height = curve_sea_height(s);
  const CraneCurveSpec* best = nullptr;
  for (const CraneCurveSpec& curve : s.crane_curves)
    if (curve.crane == crane && height <= curve.significant_height * (1.0 + 1e-9) &&
        (!best || curve.significant_height < best->significant_height))
      best = &curve;
  return best;
}

std::vector<std::string> cranes_with_curves(const Specification& s) {
  std::vector<std::string> names;
  for (const CraneCurveSpec& curve : s.crane_curves)
    if (std::find(names.begin(), names.end(), curve.crane) == names.end()) names.push_back(curve.crane);
  return names;
}

}  // namespace stillhook
