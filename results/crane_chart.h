// A crane's capacity curve and, over it, the path of a lift: hook load over radius.
#pragma once

#include <string>

#include "results/run_view.h"

namespace stillhook {

/// One <svg> element; empty without a curve or without samples. Every curve of the crane is drawn, the one that counts in
/// the sea of the run in bold. A long path is thinned to the extremes of radius and load of equal slices of time.
std::string draw_crane_curve(const RunView& view, const std::string& crane);

}  // namespace stillhook
