// Coefficient sets as tables for the terminal and the report. Units: tonnes, kN, metres, degrees.
#pragma once

#include <string>
#include <vector>

#include "planner/verbs/hydro/hydro_convergence.h"
#include "results/report.h"

#include "results/quantity.h"

namespace stillhook {

/// Units of A_ij (t, t m, t m2), B_ij (kN s/m ...), K_ij (kN/m per s ...), X_i (kN/m, kN m/m).
ShownUnit added_mass_unit(int i, int j);
ShownUnit damping_unit(int i, int j);
ShownUnit kernel_unit(int i, int j);
ShownUnit excitation_unit(int i);

/// Pairs i < j that are not negligible (|A_ij| or |B_ij| above 0.5 % of the diagonal's geometric mean somewhere).
std::vector<std::pair<int, int>> coupled_pairs(const HydrodynamicCoefficients& set);

/// Indices of the table's headings nearest to head (180 deg), bow quartering (135 deg) and beam (90 deg) waves.
std::vector<int> shown_headings(const ExcitationTable& X);

/// Diagonals of A and B, coupled pairs, X at some headings.
std::vector<ReportTable> coefficient_tables(const HydroSet& set);
ReportTable check_table(const HydroSet& set);
/// Blocks, order, states, R2, passivity; without rows when there is no fit.
ReportTable fit_table(const HydroSet& set);
/// Parts of the band with their panels.
ReportTable panel_table(const HydroSet& set);
ReportTable convergence_table(const HydroSet& set, const Convergence& convergence);

/// One line on where the set comes from.
std::string origin_sentence(const HydroSet& set);

}  // namespace stillhook
