// How the band of frequencies is divided, and the water surface that each part gets.
#pragma once

#include <vector>

#include "sim/hull/rankine/frequency_response.h"
#include "sim/hull/rankine/layout.h"

namespace stillhook::rankine {

/// Throws SpecificationError("panel method") for options out of range.
void require_options(const PanelMethodOptions& options);

/// The parts of the band, ascending; the last frequency of each is the first of the next. Panels and memory are not
/// counted yet.
std::vector<PanelBand> bands_of(const Layout& layout, const PanelMethodOptions& options);

/// Width of a beach over that in deep water: 1, over a bed up to 1.25. There waves are of one speed, the beach's share
/// of the wave number acts once and not squared, and a beach of the same width sends back more.
double wider_beach(double frequency, double gravity, double depth);

/// The bed under the hulls and a water surface that ends `width` (m) from them.
Bed bed_within(double width, const Layout& layout, const PanelMethodOptions& options);

FreeSurfaceGrid grid_of(const PanelBand& band);
Beach beach_of(const PanelBand& band, const PanelMethodOptions& options);

/// Headings around the circle that resolve exp(i k R cos b), R half the diagonal of the largest hull, with a margin; or
/// what the options say.
int headings_for(const Layout& layout, const PanelMethodOptions& options);

}  // namespace stillhook::rankine
