#include "sim/hull/coefficients/sea_band.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/hull/diffraction.h"
#include "sim/hull/rankine/frequencies.h"
#include "sim/sea/dispersion.h"
#include "sim/sea/spectrum.h"
#include "sim/spatial/constants.h"

namespace stillhook {

namespace {

/// rad/s; waves by rising frequency.
double nine_tenths(const std::vector<WaveComponent>& waves) {
  double energy = 0.0, below = 0.0;
  for (const WaveComponent& c : waves) energy += c.amplitude * c.amplitude;
  for (const WaveComponent& c : waves) {
    below += c.amplitude * c.amplitude;
    if (below >= 0.9 * energy) return c.frequency;
  }
  return 0.0;
}

/// rad/s, below which a sea, or each of its parts, has nine tenths of its energy.
double reach_of(const SeaStateSpec& state, const SeaSpec& sea) {
  // A Pierson-Moskowitz sea has 1 - exp(-1.25 r^-4) of its energy above r times its peak frequency, a tenth for r = 1.86;
  // a JONSWAP sea has less.
  constexpr double kNineTenths = 1.86;
  using Type = SeaStateSpec::Type;
  switch (state.type) {
    case Type::calm:
      return 0.0;
    case Type::regular:
      return state.frequency;
    case Type::jonswap:
    case Type::pierson_moskowitz:
      return state.peak_period > 0.0 ? kNineTenths * kTwoPi / state.peak_period : 0.0;
    case Type::ochi_hubble:
    case Type::spectrum:
      return frequency_below(state, 0.9);
    case Type::record:
      return nine_tenths(build_wave_field(state, sea.gravity, 0.0).components());
    case Type::sum:
      break;
  }
  // Not of the drawn waves, so that all seeds of a sea have the same coefficients.
  double highest = 0.0;
  for (const SeaStateSpec& part : state.parts) highest = std::max(highest, reach_of(part, sea));
  return highest;
}

}  // namespace

double highest_of_seas(const SeaSpec& sea) {
  constexpr std::array<double, 3> kSteps = {rankine::kHighest, 2.5, 3.0};
  double highest = kSteps.front();
  for (const SeaStateSpec& state : sea.states) {
    const double wanted = reach_of(state, sea);
    for (std::size_t i = 0; i + 1 < kSteps.size(); ++i)
      if (wanted > kSteps[i]) highest = std::max(highest, kSteps[i + 1]);
  }
  return highest;
}

void require_resolved_sea(std::span<const HullAfloat> hulls, const WaveField& waves, const SeaSpec& sea,
                          const PanelMethodSpec& method, double negligible_energy) {
  using Beyond = PanelMethodSpec::Beyond;
  const HullAfloat& first = hulls.front();
  if (first.body->hydrodynamics.kind != HydrodynamicsSpec::Kind::panels || method.beyond == Beyond::cut) return;
  double length = 0.0, diagonal = 0.0;
  for (const HullAfloat& hull : hulls) {
    if (hull.mesh->vertices.empty()) return;
    const MeshProperties size = properties_of(*hull.mesh);
    length = std::max({length, size.high.x() - size.low.x(), size.high.y() - size.low.y()});
    diagonal = std::hypot(diagonal, (size.high - size.low).head<2>().norm());
  }
  const double highest = rankine::highest_frequency(diagonal, panel_options(sea, method, 0.0));
  const double depth = panel_depth(sea, method);
  double energy = 0.0, beyond = 0.0;
  bool above = false;
  for (const WaveComponent& wave : waves.components()) {
    const double a2 = wave.amplitude * wave.amplitude;
    energy += a2;
    // As DiffractionTable::resolves() will see it: of a set of deep water at the frequency that a wave of this length
    // has there.
    const double frequency =
        waves.deep() || std::isfinite(depth) ? wave.frequency : std::sqrt(sea.gravity * wave.wavenumber);
    const bool too_short = method.beyond == Beyond::refuse && frequency > highest * (1.0 + 1e-9);
    const double read = std::min(frequency, highest);
    const double step = (std::atan2(wave.sin_heading, wave.cos_heading) - first.yaw) * method.headings / kTwoPi;
    const bool between = method.headings > 0 && std::abs(step - std::round(step)) >= 1e-6 &&
                         wave_number(read, sea.gravity, depth) * length > method.headings;
    above |= too_short;
    if (too_short || between) beyond += a2;
  }
  if (beyond > negligible_energy * energy)
    throw SpecificationError(entry_of(*first.body), "kind",
                             unresolved_sea(beyond / energy, above, highest, negligible_energy));
}

}  // namespace stillhook
