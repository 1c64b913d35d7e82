// Where two parts of the band meet, each computed on panels of its own.
//
// A, B and X of the two differ by the error of their panels, and a state space sees a jump as a resonance. Where they
// differ by more than kJump of the largest value of a mode, each gives way by half of the difference at the joint and by
// less and less towards its other end. Below that the jump disturbs a state space less than the bend of a correction.
#pragma once

#include <span>
#include <vector>

#include "sim/hull/rankine/panel_method.h"

namespace stillhook::rankine {

/// Joins A and B of the parts, the last frequency of each being the first of the next.
void join_parts(std::span<const PanelBand> bands, std::vector<std::vector<FrequencyCoefficients>>& parts);

/// X of some modes at one of its frequencies, headings x modes.
Eigen::MatrixXcd excitation_at(const ExcitationTable& X, double frequency, std::span<const int> modes);

/// Joins X of some modes where bands p and p + 1 meet. `before`: what part p has there; X holds that of part p + 1.
void join_excitation(std::span<const PanelBand> bands, std::size_t p, const Eigen::MatrixXcd& before,
                     std::span<const int> modes, ExcitationTable& X);

}  // namespace stillhook::rankine
