// report.html of `stillhook hydro`: one file, no script, no request to anything outside it.
#pragma once

#include <string>
#include <vector>

#include "planner/hydro_files.h"

namespace stillhook {

/// Plots of one set: A(w), B(w), K(t) with the reduced model over them, |X| and its phase by heading. HTML.
std::string coefficient_plots(const HydroSet& set);
/// Surge, heave, roll and pitch of every body by heading. HTML.
std::string response_plots(const ResponseCurves& curves);

std::string hydro_report(const Case& c, const HydroResult& result, const std::vector<std::string>& files);

}  // namespace stillhook
