// Start values from a decay's p-q line.
#pragma once

#include <map>
#include <string>

#include "tuning/decay.h"
#include "tuning/prediction.h"

namespace stillhook {

/// The p-q lines of a decay record's channel, as measured and as simulated with the case's own values.
struct DecayComparison {
  std::string channel;
  DecayLine measured, simulated;
};

/// Of every channel that is a position or an angle of the free body. `simulated`: the prediction at the case's values.
std::vector<DecayComparison> compare_decays(const RecordModel& model, const Prediction& simulated);

/// Values, in their keys' units, of added mass or inertia and of linear and quadratic damping that bring the simulated
/// period and p-q line to the measured ones. Keys are those of `kind = "constant"` and of viscous damping. Builds the
/// model for its inertia.
std::map<std::string, double> start_from_decay(const RecordModel& model, const std::vector<DecayComparison>& lines);

}  // namespace stillhook
