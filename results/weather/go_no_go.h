// Go or no-go: the first start in a forecast from which every phase of an operation finds the sea that it needs.
//
// A phase planned from s to e hours after the start may happen, with the contingency T_C, anywhere between s and e +
// T_C: in all samples of that time Hs must not exceed OP_WF = alpha OP_LIM of that phase. So a lift may start before
// the sea of its set-down has come.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/weather/alpha.h"
#include "results/weather/workability.h"

namespace stillhook {

/// When a phase is planned, in hours after the start, and whose limits hold then (of OperationLimits, by name). Without
/// a name it is the whole operation, in which all limits hold.
struct PlannedPhase {
  std::string name;
  double start_h = 0.0, end_h = 0.0;
};

struct GoNoGoRules {
  WeatherRules weather;
  ReferencePeriod period;
  AlphaTable alpha;
  bool by_lead_time =
      false;  // alpha by how far ahead in the forecast a sample lies, at most T_POP, instead of by T_POP
};

/// What the forecast of one sample means to one phase.
struct ForecastSample {
  double limit = 0.0;    // OP_LIM, m; NaN where there is none
  double alpha = 0.0;    // NaN likewise
  double allowed = 0.0;  // OP_WF, m; NaN likewise
  SampleState state = SampleState::missing;
};

/// One phase under one start.
struct PhaseDecision {
  std::string phase;
  std::size_t first = 0, last = 0;          // samples in which the phase may happen; last is beyond them
  bool within_forecast = true;              // the forecast is long enough for it
  std::optional<std::size_t> first_broken;  // the first of them that does not allow it
  std::size_t tightest = 0;                 // the one with the largest Hs / OP_WF
  bool go() const { return within_forecast && !first_broken; }
};

struct GoNoGo {
  std::vector<PlannedPhase> phases;
  std::vector<std::vector<ForecastSample>> samples;  // [phase][sample]
  std::vector<PhaseDecision> now;                    // for a start at the forecast's first sample
  std::vector<char> start_allowed;                   // of each sample that the operation may start in
  std::size_t starts_told = 0;                       // samples for which the forecast is long enough
  std::optional<std::size_t> first_start;
  std::vector<PhaseDecision> then;  // for that start
  bool go_now() const { return first_start == std::size_t{0}; }
};

/// `phases`: in order. Limits without a name hold in every phase. Throws std::invalid_argument for a phase without a
/// limit, and for an operation that is too long for a forecast.
GoNoGo decide(const WeatherRecord& forecast, const OperationLimits& limits, const std::vector<PlannedPhase>& phases,
              const GoNoGoRules& rules);

}  // namespace stillhook
