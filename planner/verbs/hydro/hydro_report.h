// report.html of `stillhook hydro`: one file, no script, no request to anything outside it.
#pragma once

#include <string>
#include <vector>

#include "planner/verbs/hydro/hydro_files.h"
#include "results/document_control.h"

namespace stillhook {

/// Plots of one set: A(w), B(w), K(t) with the reduced model over them, |X| and its phase by heading. HTML.
std::string coefficient_plots(const HydroSet& set);
/// The six motions of every body by heading, and how they lag. HTML.
std::string response_plots(const ResponseCurves& curves);

std::string hydro_report(const Case& c, const HydroResult& result, const std::vector<std::string>& files,
                         const DocumentControl& control = {});

}  // namespace stillhook
