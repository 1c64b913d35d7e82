// Whether the coefficients that a panel computation would give know the sea of a case.
#pragma once

#include <span>

#include "sim/hull/coefficients/coefficient_source.h"
#include "sim/sea/wave_field.h"

namespace stillhook {

/// rad/s, what a band must reach to hold nine tenths of the energy of every sea of the case: kHighest of frequencies.h or
/// one of few steps above, so that seas that differ a little have the same coefficients.
double highest_of_seas(const SeaSpec& sea);

/// Refuses, before any panel is computed, a sea of which more than `negligible_energy` (1) lies where the computed
/// excitation would end (panel_method.beyond = "refuse") or between headings too far apart for its waves
/// (panel_method.headings). Throws SpecificationError("bodies.<name>.hydrodynamics", "kind"). Does nothing for hulls
/// whose coefficients are not computed.
void require_resolved_sea(std::span<const HullAfloat> hulls, const WaveField& waves, const SeaSpec& sea,
                          const PanelMethodSpec& method, double negligible_energy);

}  // namespace stillhook
