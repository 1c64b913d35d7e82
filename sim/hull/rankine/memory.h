// The memory of a panel computation, told before it begins.
#pragma once

#include <vector>

#include "sim/hull/rankine/layout.h"

namespace stillhook::rankine {

/// Panels and bytes of each part of the band. Throws SpecificationError("bodies.<name>") when a part, or the limits of
/// low and high frequency on panels half as long, would take more than options.memory.
void measure_parts(const std::vector<PanelHull>& hulls, const Layout& layout, const PanelMethodOptions& options,
                   std::vector<PanelBand>& bands);

}  // namespace stillhook::rankine
