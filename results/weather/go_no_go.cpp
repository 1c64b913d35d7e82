#include "results/weather/go_no_go.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

OperationLimits limits_of_phase(const OperationLimits& limits, const std::string& phase) {
  OperationLimits own, whole;
  for (const PhaseLimit& limit : limits.phases) {
    if (phase.empty() || limit.phase == phase) own.phases.push_back(limit);
    if (limit.phase.empty()) whole.phases.push_back(limit);
  }
  if (own.phases.empty()) own = whole;
  if (own.phases.empty()) throw std::invalid_argument("the limits have none for phase \"" + phase + "\"");
  return own;
}

std::vector<ForecastSample> judge_phase(const WeatherRecord& forecast, const OperationLimits& limits,
                                        const GoNoGoRules& rules) {
  const Workability at_limit = judge_weather(forecast, limits, rules.weather);
  std::vector<ForecastSample> samples;
  for (std::size_t i = 0; i < forecast.size(); ++i) {
    ForecastSample s{at_limit.limit[i], kNaN, kNaN, at_limit.state[i]};
    if (!std::isnan(s.limit)) {
      // A sample counts until its end.
      const double lead_h = static_cast<double>(i + 1) * forecast.step_h();
      const double time_h = rules.by_lead_time ? std::min(lead_h, rules.period.planned_h) : rules.period.planned_h;
      s.alpha = rules.alpha.factor(time_h, s.limit);
      s.allowed = s.alpha * s.limit;
      if (s.state == SampleState::workable && !(forecast.height[i] <= s.allowed)) s.state = SampleState::too_high;
    }
    samples.push_back(s);
  }
  return samples;
}

PhaseDecision decide_phase(const WeatherRecord& forecast, const std::vector<ForecastSample>& samples,
                           const PlannedPhase& phase, double contingency_h, std::size_t start) {
  PhaseDecision d;
  d.phase = phase.name;
  const double step = forecast.step_h();
  d.first = start + static_cast<std::size_t>(std::floor(phase.start_h / step + 1e-9));
  const std::size_t last = start + static_cast<std::size_t>(std::ceil((phase.end_h + contingency_h) / step - 1e-9));
  d.last = std::max(last, d.first + 1);
  d.within_forecast = d.last <= samples.size();
  d.tightest = std::min(d.first, samples.size() - 1);
  double most = -1.0;
  for (std::size_t i = d.first; i < std::min(d.last, samples.size()); ++i) {
    if (samples[i].state != SampleState::workable && !d.first_broken) d.first_broken = i;
    const double use = forecast.height[i] / samples[i].allowed;
    if (use > most) {
      most = use;
      d.tightest = i;
    }
  }
  return d;
}

}  // namespace

GoNoGo decide(const WeatherRecord& forecast, const OperationLimits& limits, const std::vector<PlannedPhase>& phases,
              const GoNoGoRules& rules) {
  if (rules.period.planned_h > kLongestForecastOperation)
    throw std::invalid_argument(
        fmt::format("an operation of {:g} h is longer than the {:g} h for which a forecast can be relied on: plan it "
                    "as unrestricted "
                    "by weather, or cut it into operations with safe conditions between them",
                    rules.period.planned_h, kLongestForecastOperation));
  if (forecast.size() == 0 || phases.empty()) throw std::invalid_argument("a decision needs a forecast and a phase");
  GoNoGo result;
  result.phases = phases;
  for (const PlannedPhase& phase : phases)
    result.samples.push_back(judge_phase(forecast, limits_of_phase(limits, phase.name), rules));
  result.start_allowed.assign(forecast.size(), 0);
  for (std::size_t i = 0; i < forecast.size(); ++i) {
    std::vector<PhaseDecision> decisions;
    for (std::size_t p = 0; p < phases.size(); ++p)
      decisions.push_back(decide_phase(forecast, result.samples[p], phases[p], rules.period.contingency_h, i));
    const auto all = [&](auto test) { return std::all_of(decisions.begin(), decisions.end(), test); };
    if (all([](const PhaseDecision& d) { return d.within_forecast; })) ++result.starts_told;
    const bool go = all([](const PhaseDecision& d) { return d.go(); });
    result.start_allowed[i] = go ? 1 : 0;
    if (i == 0) result.now = decisions;
    if (go && !result.first_start) {
      result.first_start = i;
      result.then = decisions;
    }
  }
  return result;
}

}  // namespace stillhook
