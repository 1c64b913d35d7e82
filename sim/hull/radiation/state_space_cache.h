// The state space of a coefficient set, found once: fitting coupled hulls takes longer than a run.
//
// Kept in memory for this process and on disk for the next, in the folder of computed coefficients
// (coefficient_source.h), under a hash of A, B, A_inf, K and the tolerance. That none was found is kept as well.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "sim/hull/radiation/state_space_fit.h"

namespace stillhook {

/// A fit, or why there is none.
struct KnownStateSpace {
  std::shared_ptr<const StateSpaceFit> fit;
  std::string fault;
};

/// As fit_state_space() with this tolerance; never throws for a set that cannot be fitted.
KnownStateSpace known_state_space(const HydrodynamicCoefficients& set, double tolerance);

/// Where it is kept on disk; empty where there is no such place.
std::string state_space_file(const HydrodynamicCoefficients& set, double tolerance);
/// Nothing when the file is none that known_state_space() has written for a set of so many modes.
std::optional<KnownStateSpace> read_state_space(const std::string& path, int modes);

}  // namespace stillhook
