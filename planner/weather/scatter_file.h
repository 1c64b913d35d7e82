// Scatter tables and tables of alpha factors as CSV files.
#pragma once

#include <string>

#include "results/weather/alpha.h"
#include "results/weather/scatter.h"

namespace stillhook {

/// Counts, a row a bin, with the columns `hs_low [m]`, `hs_high [m]`, `tp_low [s]`, `tp_high [s]`, `count`, and where
/// they are known `month` (1 to 12) and `wave_from [deg]`, the middle of a sector of compass directions. Or as in
/// reports: the first column names ranges of heights, "0.5-1", the others ranges of peak periods, "7-8". Throws
/// CaseError.
ScatterTable read_scatter_file(const std::string& path);

/// Columns `t_pop_at_most [h]`, `hs [m]`, `alpha`. Throws CaseError.
AlphaTable read_alpha_file(const std::string& path);

}  // namespace stillhook
