// The part of a coefficient set that can be trusted, where its lowest or highest frequencies cannot: panel codes fail
// at irregular frequencies and where their panels are too long for the waves, and in water whose bottom the waves feel.
#pragma once

#include <string>

#include "sim/hull/coefficients/coefficients.h"
#include "sim/hull/hull_spec.h"

namespace stillhook {

/// All self-checks pass but those that the case accepts.
bool passes_checks(const HydrodynamicCoefficients& set, const PanelMethodSpec& method);

/// "; from a to b rad/s they pass: ..." with the keys that leave the rest out, for the longest band of frequencies in
/// which every one passes its own checks and all together pass theirs; empty when there is none of at least a third of
/// the frequencies.
std::string passing_band(const HydrodynamicCoefficients& set, const PanelMethodSpec& method);

/// The names in a list with commas.
std::vector<std::string> listed_checks(const std::string& text);

}  // namespace stillhook
