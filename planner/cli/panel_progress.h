// Telling on stderr that the panel method runs, wherever a command builds a model.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "planner/cli/progress.h"
#include "sim/hull/coefficients/coefficient_source.h"

namespace stillhook {

/// Says so once when a panel computation begins, then how far it is; ends it when `stop` is set.
HydroProgress panel_method_progress(bool quiet, const std::atomic<bool>* stop = nullptr);

/// Prints what a model's reader must know, one line each.
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace stillhook
