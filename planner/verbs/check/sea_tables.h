// The active sea in numbers and in words, its waves over the bed, and what water there is under the keels.
#pragma once

#include <string>
#include <vector>

#include "results/report.h"
#include "sim/model.h"

namespace stillhook {

/// "Sea": heights, periods, mean direction in the world and as seen from the bow of the first vessel, spread, and the
/// share of energy above the frequencies of the hulls' coefficients, of each part and of the whole. "Waves over the
/// bed", where there is one: lengths and speeds. "Keel clearance" of what floats, in still water. Empty in calm water.
std::vector<ReportTable> sea_tables(const Model& model);

}  // namespace stillhook
