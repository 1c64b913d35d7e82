// The state space of a coefficient set, found once: fitting coupled hulls takes longer than a run.
//
// Kept in memory for this process and on disk for the next, in the folder of computed coefficients
// (coefficient_source.h), under a hash of A, B, A_inf, K and the tolerance. That none was found is kept as well.
#pragma once

#include <memory>
#include <string>

#include "sim/hull/state_space_fit.h"

namespace stillhook {

/// A fit, or why there is none.
struct KnownStateSpace {
  std::shared_ptr<const StateSpaceFit> fit;
  std::string fault;
};

/// As fit_state_space() with this tolerance; never throws for a set that cannot be fitted.
KnownStateSpace known_state_space(const HydrodynamicCoefficients& set, double tolerance);

}  // namespace stillhook
