// The sea as a polar plot: where its waves come from, how long they are, and how its energy spreads.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/specification.h"

namespace stillhook {

/// An SVG of the sea that the case uses: the angle is the direction that the waves come from, seen from above with the
/// world's +x up, the radius their frequency, the shade the spectral density. A long-crested system is drawn ten
/// degrees wide, a regular wave as a dot. The vessel lies in the middle as it is headed. `north` (rad, true north from
/// +x, counter-clockwise) is marked where it is known. Empty for calm water and for one regular wave alone.
std::string draw_sea_polar(const Specification& spec, std::optional<double> north = {});

/// What the plot shows of the irregular systems of a sea: mean densities over cells of frequency and heading.
struct SeaCells {
  static constexpr int kRings = 30, kSectors = 36;
  double ring = 0.0;  // rad/s, height of a ring; the first begins at 0
  std::vector<std::vector<double>>
      density;  // m2 s/rad2, [ring][sector]; sector s lies about s times 10 degrees of travel
};
/// Long-crested systems fill ten degrees about their heading.
SeaCells sea_cells(const SeaStateSpec& state);

}  // namespace stillhook
