#include "planner/operability/operability_plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "results/statistics/binomial.h"

namespace stillhook {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kSameAngle = 1e-9;  // rad; headings come from degrees

double heading_within_turn(double heading) {
  const double within = std::fmod(std::fmod(heading, kTurn) + kTurn, kTurn);
  return within > kTurn - kSameAngle ? 0.0 : within;
}

std::vector<double> headings_of(const OperabilitySpec& spec) {
  std::vector<double> headings;
  if (spec.heading_step > 0.0) {
    const int steps = static_cast<int>(std::round(kTurn / spec.heading_step));
    for (int i = 0; i < steps; ++i) headings.push_back(kTurn * i / steps);
  }
  for (const double heading : spec.headings) headings.push_back(heading_within_turn(heading));
  if (spec.mirror) {
    const std::vector<double> given = headings;
    for (const double heading : given) {
      const double other = heading_within_turn(-heading);
      const auto same = [&](double h) { return std::abs(h - other) < kSameAngle; };
      if (std::none_of(headings.begin(), headings.end(), same)) headings.push_back(other);
    }
  }
  std::sort(headings.begin(), headings.end());
  return headings;
}

/// The heading that is simulated for this one.
double simulated_heading(const OperabilitySpec& spec, double heading) {
  return spec.mirror && heading > std::numbers::pi + kSameAngle ? kTurn - heading : heading;
}

void add_columns(const OperabilitySpec& spec, OperabilityPlan& plan) {
  for (const double tp : plan.peak_periods) {
    std::vector<std::size_t>& row = plan.column_at.emplace_back();
    const std::size_t first = plan.columns.size();
    const double steepest = steepest_height(tp), highest = std::min(steepest, spec.height_max.value_or(steepest));
    for (const double heading : plan.headings) {
      const double own = simulated_heading(spec, heading);
      const auto same = [&](const OperabilityColumn& c) { return std::abs(c.heading - own) < kSameAngle; };
      const auto found =
          std::find_if(plan.columns.begin() + static_cast<std::ptrdiff_t>(first), plan.columns.end(), same);
      row.push_back(static_cast<std::size_t>(found - plan.columns.begin()));
      if (found == plan.columns.end()) plan.columns.push_back({tp, own, highest});
    }
  }
}

void choose_phases(const Case& c, OperabilityPlan& plan) {
  plan.phases_alone = !c.operability.phases.empty();
  for (const PhaseSpec& phase : c.specification.operation.phases) {
    const auto asked = [&](const OperabilityPhaseSpec& p) { return p.name == phase.name; };
    const auto& phases = c.operability.phases;
    if (!plan.phases_alone || std::any_of(phases.begin(), phases.end(), asked)) plan.phases.push_back(phase.name);
  }
}

}  // namespace

double degrees_of(double radians) {
  return std::round(radians * 180.0 / std::numbers::pi * 1e6) / 1e6;  // as the case has them, without the last bits
}

double steepest_height(double tp) {
  const double steepness = tp <= 8.0    ? 1.0 / 15.0
                           : tp >= 15.0 ? 1.0 / 25.0
                                        : 1.0 / 15.0 + (tp - 8.0) / 7.0 * (1.0 / 25.0 - 1.0 / 15.0);
  constexpr double kGravity = 9.80665;
  return steepness * kGravity * tp * tp / kTurn;
}

ColumnRules OperabilityPlan::rules_of(std::size_t column) const {
  ColumnRules own = rules;
  own.highest = columns[column].highest;
  // A sea that may not be higher than a few centimetres has its whole range below the usual lowest height.
  own.lowest = std::min(own.lowest, 0.1 * own.highest);
  return own;
}

int OperabilityPlan::seed(int index) const {
  return static_cast<int>((static_cast<std::int64_t>(first_seed) + index) % 2147483648LL);
}

OperabilityPlan operability_plan(const Case& c) {
  const OperabilitySpec& spec = c.operability;
  if (spec.peak_periods.empty())
    throw CaseError(c.file +
                    ": has no section [operability]: it says for which peak periods and headings limits are "
                    "wanted, as in --set operability.peak_periods_s=[6,8,10] --set operability.headings_deg=[180]");
  OperabilityPlan plan;
  plan.sea = spec.sea.empty() ? c.specification.sea.active : spec.sea;
  plan.peak_periods = spec.peak_periods;
  plan.headings = headings_of(spec);
  add_columns(spec, plan);
  plan.criteria = criteria_of(c);
  choose_phases(c, plan);
  plan.rules.looks.clear();
  for (const double seeds : spec.seeds) plan.rules.looks.push_back(static_cast<int>(seeds));
  plan.rules.level = spec.level;
  plan.rules.tolerance = spec.tolerance;
  plan.rules.resolution = spec.resolution;
  plan.rules.guess = spec.guess;
  plan.rules.every_target = spec.criteria == OperabilitySpec::Criteria::all;
  constexpr std::int64_t kFreshSeeds = 1'000'003;  // those of a certificate: far from the seeds of a search
  for (const SeaStateSpec& state : c.specification.sea.states)
    if (state.name == plan.sea) plan.first_seed = static_cast<int>((state.seed + kFreshSeeds) % 2147483648LL);
  return plan;
}

/// Two rungs of all seeds, the look for islands, and three runs for each rank up to two beyond the upper one.
RunsExpected runs_expected(const ColumnRules& rules) {
  const auto runs = [&](int seeds) {
    const int upper = quantile_ranks(seeds, 1.0 - rules.level).upper;
    const int refined = upper == 0 ? seeds : std::min(seeds, upper + 2);
    return 2.0 * seeds + rules.looks.front() + 3.0 * refined;
  };
  return {runs(rules.looks.front()), runs(rules.looks.back())};
}

std::string column_text(const OperabilityColumn& column) {
  return fmt::format("Tp {:g} s, heading {:g} deg", column.peak_period, degrees_of(column.heading));
}

}  // namespace stillhook
