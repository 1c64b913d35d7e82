// Seas in sentences.
#pragma once

#include <optional>
#include <string>

#include "sim/sea/sea_spec.h"

namespace stillhook {

/// Where waves come from that travel towards `relative` (rad from the bow, counter-clockwise): "from ahead", "from port
/// bow", "from starboard beam", ... in steps of 45 degrees.
std::string direction_in_words(double relative);

/// The compass direction that waves towards `heading` come from, degrees clockwise from true north, 0 to 360. Both in
/// rad from +x, counter-clockwise.
double compass_from(double heading, double north);

/// The active sea as a report states it: kind, height, period, direction, seed, each part of a sum, and the depth that
/// its waves feel. With the compass direction that the waves come from where true north is known.
std::string sea_sentence(const SeaSpec& sea, std::optional<double> north = {});

}  // namespace stillhook
