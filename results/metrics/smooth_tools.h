// What smooth metrics are made of (smooth_metrics.h has the formulas).
#pragma once

#include <functional>
#include <vector>

#include "results/metrics/metric_run.h"

namespace stillhook {

using ValueInPhase = std::function<double(std::size_t phase, std::size_t sample)>;
using Tables = std::vector<std::vector<double>>;  // [phase][sample]

/// Mean over the phases, whose ends may lie between samples; NaN without length.
double window_mean(const RunView& view, const Phases& phases, const ValueInPhase& f);

/// The log-sum-exp of f over the phases.
double soft_peak(const RunView& view, const Phases& phases, double sharpness, const ValueInPhase& f);

/// f by sample and phase, computed once: the functions above ask for a value again and again.
Tables tabulated(const RunView& view, const Phases& phases, const ValueInPhase& f);

/// x for x > w, 0 for x < -w, a parabola in between.
double soft_positive(double x, double w);

/// A value of a search, empty for one that is not there.
std::optional<double> if_any(double value);

}  // namespace stillhook
