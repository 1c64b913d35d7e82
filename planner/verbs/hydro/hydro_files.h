// What `stillhook hydro` writes beside the report: the sets in every format the project writes, and summary.json.
#pragma once

#include <string>
#include <vector>

#include "planner/verbs/hydro/hydro_convergence.h"
#include "planner/verbs/hydro/hydro_response.h"
#include "results/report.h"

namespace stillhook {

/// Everything of one run.
struct HydroResult {
  std::vector<HydroSet> sets;
  std::vector<std::vector<Convergence>> convergence;  // of each set: none or one
  ResponseCurves responses;
  std::vector<ReportTable> periods;
  std::vector<std::string> warnings;
  double wall = 0.0;  // s
};

/// Writes coefficients-<set>.csv, .h5, .1, .3 and .hst into the folder. Returns the names written; a format that cannot
/// hold the set is left out with a sentence in `left_out`. About the database frame of .h5, .1, .3 and .hst: its origin
/// lies in the calm water plane under the (first) hull's origin Bo, its x axis along that hull's; WAMIT numbers are
/// with ULEN = 1 m, periods in the first column, about Bo; BEMIO's are about the centre of gravity.
std::vector<std::string> write_coefficient_files(const std::string& folder, const Model& model, const HydroSet& set,
                                                 std::vector<std::string>& left_out);

/// summary.json of the verb, see docs/hydrodynamics.md.
std::string hydro_summary(const Case& c, const HydroResult& result, const std::vector<std::string>& files,
                          const std::string& date = "");

}  // namespace stillhook
