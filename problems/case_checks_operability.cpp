#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "problems/case_checks.h"
#include "problems/case_key.h"

namespace stillhook {
namespace {

template <class T>
bool in_ascending_order(const std::vector<T>& values) {
  return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
}

/// The heading within [0, 2 pi), rounded so that 360 deg is 0.
double heading_within_turn(double heading) {
  const double turn = 2.0 * std::numbers::pi, within = std::fmod(std::fmod(heading, turn) + turn, turn);
  return within > turn - 1e-9 ? 0.0 : within;
}

bool all_differ(const std::vector<double>& headings) {
  for (std::size_t i = 0; i < headings.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::abs(heading_within_turn(headings[i]) - heading_within_turn(headings[j])) < 1e-9) return false;
  return true;
}

}  // namespace

void check_operability(const Case& c, const Node& root, Findings& findings) {
  const OperabilitySpec& spec = c.operability;
  if (spec.peak_periods.empty()) return;  // the case has no such section
  const auto report = [&](const std::string& key, const std::string& sentence) {
    findings.add(position_of_key(root, "operability", key), "operability", key, sentence);
  };
  const std::string& sea = spec.sea.empty() ? c.specification.sea.active : spec.sea;
  const auto& states = c.specification.sea.states;
  const auto state = std::find_if(states.begin(), states.end(), [&](const SeaStateSpec& s) { return s.name == sea; });
  using Type = SeaStateSpec::Type;
  if (state == states.end() || (state->type != Type::jonswap && state->type != Type::pierson_moskowitz))
    report("sea", fmt::format("must name a sea state of type jonswap or pierson_moskowitz, whose height and period "
                              "can be set{}",
                              sea.empty() ? "; the case has no active sea" : ", \"" + sea + "\" is none"));
  if (!in_ascending_order(spec.peak_periods)) report("peak_periods_s", "must ascend");
  if (!all_differ(spec.headings)) report("headings_deg", "has a heading twice");
  const double steps = spec.heading_step > 0.0 ? 2.0 * std::numbers::pi / spec.heading_step : 1.0;
  if (std::abs(steps - std::round(steps)) > 1e-6)
    report("heading_step_deg",
           fmt::format("must divide 360 deg, got {:g} deg", spec.heading_step * 180.0 / std::numbers::pi));
  if (!in_ascending_order(spec.seeds)) report("seeds", "must ascend");
  for (const double seeds : spec.seeds)
    if (seeds != std::floor(seeds)) report("seeds", fmt::format("must be whole numbers, got {:g}", seeds));
  if (std::none_of(c.limits.begin(), c.limits.end(), [](const LimitSpec& l) { return l.hard; }))
    report("criteria", "needs a hard limit in [limits]: without one no height is too high");
  for (std::size_t i = 0; i < spec.phases.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (spec.phases[i].name == spec.phases[j].name) report("phases", "names \"" + spec.phases[i].name + "\" twice");
}

}  // namespace stillhook
