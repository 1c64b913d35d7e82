#include "sim/hull/rankine/bands.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/hull/rankine/frequencies.h"
#include "sim/sea/dispersion.h"
#include "sim/spatial/constants.h"
#include "sim/specification.h"

namespace stillhook::rankine {
namespace {

// Longest wave over shortest in a part of the band is the square of this.
constexpr double kBandRatio = 1.6;
// Cells in the shortest wave of a part: away from the hull, and at it; panels of the hull in it.
constexpr double kCellsPerWave = 10.0, kCellsAtHull = 20.0, kPanelsPerWave = 7.0;
// Panels across a hull and cells at its waterline in its breadth, whatever the waves.
constexpr double kPanelsAcross = 8.0, kCellsAcross = 12.0;
constexpr double kGrowth = 0.25;
// The beach in longest waves, with Beach::strength: reflects 1.5 % of the amplitude (one-dimensional estimate).
constexpr double kBeachWidth = 1.2;
// Cells across the gap between two hulls.
constexpr double kCellsInGap = 5.0;
// Doublings by which cells at a hull may be larger than asked for, so that by doubling they meet the largest size: 2^0.25.
constexpr double kCoarser = 0.25;
// The beach has taken a wave when exp(-kFaded) of its amplitude is left.
constexpr double kFaded = 2.3;

double wave_length(double frequency, double gravity) { return kTwoPi * gravity / (frequency * frequency); }

double automatic_panel(const Layout& layout) {
  double breadth = std::numeric_limits<double>::max();
  for (const Placement& p : layout.hulls) breadth = std::min({breadth, p.breadth, p.length});
  return breadth / kPanelsAcross;
}

}  // namespace

void require_options(const PanelMethodOptions& o) {
  const auto bad = [](const char* field, const char* rule) { throw SpecificationError("panel method", field, rule); };
  if (!(o.density > 0.0)) bad("density", "must be > 0");
  if (!(o.gravity > 0.0)) bad("gravity", "must be > 0");
  if (!(o.depth > 0.0)) bad("depth", "must be > 0");
  if (!(o.lowest > 0.0 && (o.highest == 0.0 || o.highest > o.lowest)))
    bad("highest", "must be above the lowest frequency, which must be > 0");
  for (std::size_t i = 0; i < o.chosen.size(); ++i)
    if (!(o.chosen[i] > 0.0) || (i > 0 && !(o.chosen[i] > o.chosen[i - 1])))
      bad("chosen", "must be ascending frequencies > 0");
  if (o.frequencies != 0 && o.frequencies < 4) bad("frequencies", "must be at least 4, or 0");
  if (o.headings != 0 && o.headings < 4) bad("headings", "must be at least 4, or 0");
  if (!(o.gap_damping >= 0.0)) bad("gap_damping", "must be >= 0");
  if (!(o.refinement > 0.0)) bad("refinement", "must be > 0");
}

std::vector<PanelBand> bands_of(const Layout& layout, const PanelMethodOptions& options) {
  const std::vector<double> frequencies = frequencies_of(layout, options);
  // What divides the band is the length of its waves: over a bed by the frequency that they have in deep water.
  std::vector<double> deep(frequencies);
  for (double& w : deep) w = deep_frequency(w, options.gravity, options.depth);
  const int parts =
      std::max(1, static_cast<int>(std::ceil(std::log(deep.back() / deep.front()) / std::log(kBandRatio))));
  const double ratio = std::pow(deep.back() / deep.front(), 1.0 / parts);
  std::vector<PanelBand> bands;
  std::size_t first = 0;
  for (int p = 1; p <= parts; ++p) {
    const double end = p == parts ? 2.0 * deep.back() : deep.front() * std::pow(ratio, p);
    std::size_t last = first;
    while (last < frequencies.size() && deep[last] < end * (1.0 - 1e-9)) ++last;
    if (last == first) continue;
    PanelBand band;
    band.frequencies.assign(frequencies.begin() + first, frequencies.begin() + last);
    // The last one is the first of the next part, so that no frequency lies between two parts.
    if (last < frequencies.size()) band.frequencies.push_back(frequencies[last]);
    band.from = band.frequencies.front();
    band.to = band.frequencies.back();
    const auto wave = [&](double w) {
      return wave_length(deep_frequency(w, options.gravity, options.depth), options.gravity);
    };
    const double shortest = wave(band.to), longest = wave(band.from);
    const double panel = options.panel_length > 0.0 ? options.panel_length : automatic_panel(layout);
    band.panel_length = std::min(panel, shortest / kPanelsPerWave) / options.refinement;
    band.far = shortest / kCellsPerWave / options.refinement;
    band.near = std::min(shortest / kCellsAtHull, panel * kPanelsAcross / kCellsAcross) / options.refinement;
    band.width = kBeachWidth * longest * wider_beach(band.from, options.gravity, options.depth);
    if (layout.gap > 0.0) band.near = std::min(band.near, layout.gap / kCellsInGap / options.refinement);
    // Cells double outwards: the smallest are made to meet the largest size allowed, or all would stop far below it.
    const double doublings = std::log2(band.far / band.near);
    band.near = band.far / std::exp2(std::ceil(doublings - kCoarser));
    if (layout.gap > 0.0) {
      // Two hulls have large surfaces: where the beach has taken the part's shortest waves, cells double once more.
      band.middle = band.far;
      band.far *= 2.0;
      // int nu/c ds = kFaded with the group velocity c, which is w/2k in deep water; over a bed nu has its share of
      // that.
      const double k = kTwoPi / shortest;
      band.reach = std::cbrt(1.5 * kFaded * band.width * band.width / (Beach().strength * k));
    }
    bands.push_back(band);
    first = last;
  }
  return bands;
}

int headings_for(const Layout& layout, const PanelMethodOptions& options) {
  if (options.headings > 0) return options.headings;
  double length = 0.0;
  for (const Placement& p : layout.hulls) length = std::max(length, std::hypot(p.length, p.breadth));
  const double highest = frequencies_of(layout, options).back();
  const double k = wave_number(highest, options.gravity, options.depth);
  return 8 * std::max(3, static_cast<int>(std::ceil((k * length + 4.0) / 8.0)));
}

double wider_beach(double frequency, double gravity, double depth) {
  return 0.75 + 0.25 * energy_speed(frequency, gravity, depth);
}

Bed bed_within(double width, const Layout& layout, const PanelMethodOptions& options) {
  double reach = 0.0;  // of a corner of a hull from the middle of the first
  for (const Placement& p : layout.hulls)
    reach = std::max(reach, std::hypot(p.reference.x, p.reference.y) + 0.5 * std::hypot(p.length, p.breadth));
  return {options.depth, reach + width};
}

FreeSurfaceGrid grid_of(const PanelBand& band) {
  FreeSurfaceGrid grid{band.near, band.far, kGrowth, band.width};
  grid.middle = band.middle;
  grid.reach = band.reach;
  return grid;
}

Beach beach_of(const PanelBand& band, const PanelMethodOptions& options) {
  Beach beach;
  beach.width = band.width;
  beach.depth = options.depth;
  beach.gap = options.gap_damping;
  return beach;
}

}  // namespace stillhook::rankine
