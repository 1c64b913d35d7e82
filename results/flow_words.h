// Wind and current in sentences.
#pragma once

#include <optional>
#include <string>

#include "sim/specification.h"

namespace stillhook {

/// The wind as a report states it: mean, gusts with their seed, direction; empty without one. With the compass
/// direction that it comes from where true north is known (rad from +x, counter-clockwise).
std::string wind_sentence(const Specification& specification, std::optional<double> north = {});

/// The current in the same way, with the compass direction that it flows to.
std::string current_sentence(const SeaSpec& sea, std::optional<double> north = {});

}  // namespace stillhook
