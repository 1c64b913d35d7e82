#include "sim/hull/sea_band.h"

#include <algorithm>
#include <cmath>

#include "sim/hull/diffraction.h"
#include "sim/spatial/constants.h"

namespace stillhook {

void require_resolved_sea(std::span<const HullAfloat> hulls, const WaveField& waves, double gravity,
                          const PanelMethodSpec& method, double negligible_energy) {
  using Beyond = PanelMethodSpec::Beyond;
  const HullAfloat& first = hulls.front();
  if (first.body->hydrodynamics.kind != HydrodynamicsSpec::Kind::panels || method.beyond == Beyond::cut) return;
  double length = 0.0;
  for (const HullAfloat& hull : hulls) {
    if (hull.mesh->vertices.empty()) return;
    const MeshProperties size = properties_of(*hull.mesh);
    length = std::max({length, size.high.x() - size.low.x(), size.high.y() - size.low.y()});
  }
  double energy = 0.0, beyond = 0.0;
  bool above = false;
  for (const WaveComponent& wave : waves.components()) {
    const double a2 = wave.amplitude * wave.amplitude;
    energy += a2;
    // As DiffractionTable::resolves() will see it.
    const bool too_short = method.beyond == Beyond::refuse && wave.frequency > method.highest * (1.0 + 1e-9);
    const double read = std::min(wave.frequency, method.highest);
    const double step = (std::atan2(wave.sin_heading, wave.cos_heading) - first.yaw) * method.headings / kTwoPi;
    const bool between = method.headings > 0 && std::abs(step - std::round(step)) >= 1e-6 &&
                         read * read / gravity * length > method.headings;
    above |= too_short;
    if (too_short || between) beyond += a2;
  }
  if (beyond > negligible_energy * energy)
    throw SpecificationError(entry_of(*first.body), "kind",
                             unresolved_sea(beyond / energy, above, method.highest, negligible_energy));
}

}  // namespace stillhook
