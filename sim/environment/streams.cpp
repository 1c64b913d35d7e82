#include "sim/environment/streams.h"

#include <algorithm>

#include "sim/element_site.h"
#include "sim/number_text.h"
#include "sim/sea/dispersion.h"
#include "sim/sea/sea_statistics.h"
#include "sim/spatial/constants.h"
#include "sim/specification.h"

namespace stillhook {
namespace {

constexpr double kWavesChange = 0.05;  // current over phase speed, from which on waves over it are noticeably others

}  // namespace

std::shared_ptr<const Stream> wind_at(const ElementSite& site) {
  const Specification& s = site.specification();
  return std::make_shared<const WindStream>(s.wind, s.gust_seed(), s.sea.ramp);
}

std::shared_ptr<const Stream> current_at(const ElementSite& site) {
  const SeaSpec& sea = site.specification().sea;
  return std::make_shared<const CurrentStream>(sea.current, site.waves(), sea.depth, sea.density);
}

std::vector<std::string> current_notes(const Specification& specification) {
  const SeaSpec& sea = specification.sea;
  const SeaStateSpec* state = sea.active_state();
  if (!sea.current.flows() || !state || state->type == SeaStateSpec::Type::calm) return {};
  const double period = sea_statistics(*state).back().peak_period;
  if (!(period > 0.0)) return {};
  double fastest = sea.current.profile == CurrentSpec::Profile::table ? 0.0 : sea.current.speed;
  if (sea.current.profile == CurrentSpec::Profile::table)
    for (const CurrentSpec::Layer& layer : sea.current.table) fastest = std::max(fastest, layer.speed);
  const double w = kTwoPi / period, phase_speed = w / wave_number(w, sea.gravity, sea.wave_depth());
  if (fastest <= kWavesChange * phase_speed) return {};
  return {"sea.current: " + number_text(fastest) + " m/s is more than 5 % of the speed of the waves at the peak (" +
          number_text(phase_speed) +
          " m/s): a current along the waves stretches and lowers them, one against them shortens and steepens them. "
          "That is left out; give the waves as they are in the current"};
}

}  // namespace stillhook
