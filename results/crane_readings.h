// What a crane's indicators would show along a run: hook load, radius and boom angle of each crane of a lift.
#pragma once

#include <string>
#include <vector>

#include "results/run_view.h"

namespace stillhook {

struct CraneReading {
  std::string label, unit;
  int decimals = 1;
  std::vector<double> values;  // one a sample
};

/// Hook loads in t: the sum of a crane's hoist wires, and where there are several cranes the total first. Radius in m:
/// the horizontal distance of the upper ends of the hoist wires from the axis that the crane slews about, or from the
/// hinge of a boom that does not slew. Boom angle in degrees: of the line from the hinge to those ends above the
/// horizontal, so with the trim of the vessel in it. Booms of a vessel that go together throughout are one crane.
std::vector<CraneReading> crane_readings(const RunView& view);

}  // namespace stillhook
