#include "results/flow_words.h"

#include <cmath>

#include <fmt/format.h>

#include "results/sea_words.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

double in_turn(double degrees) { return degrees - 360.0 * std::floor(degrees / 360.0); }

std::string gusts_of(const Specification& s) {
  using Gusts = WindSpec::Gusts;
  const WindSpec& w = s.wind;
  const auto spectrum = [&](const char* name) {
    return fmt::format(
        "with gusts by the spectrum of {} from 1/600 to 0.5 Hz, {} frequencies, seed {}, alike at all "
        "places",
        name, w.components, s.gust_seed());
  };
  switch (w.gusts) {
    case Gusts::none:
      return "steady";
    case Gusts::npd:
      return spectrum("NPD (ISO 19901-1)");
    case Gusts::api:
      return spectrum("API RP 2A");
    case Gusts::kaimal:
      return spectrum("Kaimal (IEC 61400-1)");
    case Gusts::record:
      break;
  }
  return fmt::format("with the gusts of {}, alike at all places", w.record ? w.record->source : "a record");
}

}  // namespace

std::string wind_sentence(const Specification& s, std::optional<double> north) {
  if (!s.wind.blows()) return {};
  std::string text = fmt::format(
      "Wind of {:.1f} m/s (hourly mean at 10 m), {}, blowing towards {:.0f}° from +x, "
      "counter-clockwise",
      s.wind.speed, gusts_of(s), in_turn(s.wind.towards() / kDegree));
  if (north) text += fmt::format(", that is from {:.0f}° true", compass_from(s.wind.towards(), *north));
  return text;
}

std::string current_sentence(const SeaSpec& sea, std::optional<double> north) {
  const CurrentSpec& c = sea.current;
  if (!c.flows()) return {};
  if (c.profile == CurrentSpec::Profile::table)
    return fmt::format("Steady current by a table of {} depths, {:.2f} m/s at the first", c.table.size(),
                       c.table.front().speed);
  const bool power =
      c.profile == CurrentSpec::Profile::power || (c.profile == CurrentSpec::Profile::automatic && sea.depth > 0.0);
  const double towards = c.towards.value_or(0.0);
  std::string text = fmt::format(
      "Steady current of {:.2f} m/s at the surface, {}, flowing towards {:.0f}° from +x, "
      "counter-clockwise",
      c.speed,
      power ? fmt::format("falling towards the bed by the power {:.3f}", c.exponent)
            : std::string("the same at all depths"),
      in_turn(towards / kDegree));
  if (north) text += fmt::format(", that is towards {:.0f}° true", in_turn(compass_from(towards, *north) + 180.0));
  return text;
}

}  // namespace stillhook
