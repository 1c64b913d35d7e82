#include "results/sea_words.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <numbers>

#include "results/html.h"
#include "sim/sea/dispersion.h"
#include "sim/sea/sea_statistics.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

using SeaType = SeaStateSpec::Type;

std::string travel_of(double heading, std::optional<double> north) {
  std::string text =
      fmt::format("travelling towards {}° from +x, counter-clockwise", fixed_number(heading / kDegree, 0));
  if (north) text += fmt::format(", that is from {}° true", fixed_number(compass_from(heading, *north), 0));
  return text;
}

const char* shape_of(SeaType type) {
  return type == SeaType::jonswap ? "JONSWAP" : type == SeaType::ochi_hubble ? "Ochi–Hubble" : "Pierson–Moskowitz";
}

/// One system of waves, without its name. `seed`: as drawn.
std::string waves_of(const SeaStateSpec& s, std::optional<double> north, int seed) {
  switch (s.type) {
    case SeaType::calm:
      return "calm water";
    case SeaType::regular:
      return fmt::format("regular waves, amplitude {} m, {} rad/s (period {} s), {}", fixed_number(s.amplitude, 2),
                         fixed_number(s.frequency, 3), fixed_number(kTwoPi / s.frequency, 1),
                         travel_of(s.heading, north));
    case SeaType::jonswap:
    case SeaType::pierson_moskowitz:
    case SeaType::ochi_hubble:
      return fmt::format("{}, Hs {} m, Tp {} s ({} rad/s), {}, seed {}, {}-crested", shape_of(s.type),
                         fixed_number(s.significant_height, 2), fixed_number(s.peak_period, 1),
                         fixed_number(kTwoPi / s.peak_period, 3), travel_of(s.heading, north), seed,
                         s.directions > 1 ? "short" : "long");
    case SeaType::spectrum:
    case SeaType::record:
    case SeaType::sum:
      break;
  }
  const SeaStatistics all = sea_statistics(s).back();
  const std::string numbers =
      fmt::format("Hs {} m, Tp {} s", fixed_number(all.significant_height, 2), fixed_number(all.peak_period, 1));
  if (s.type == SeaType::spectrum)
    return fmt::format("2-D spectrum of {}, {}, on the whole {}, seed {}", s.spectrum->source, numbers,
                       travel_of(all.heading, north), seed);
  if (s.type == SeaType::record)
    return fmt::format(
        "measured elevation of {}, {}, {}; long-crested by assumption, since one gauge does not say where "
        "waves go",
        s.record->source, numbers, travel_of(s.heading, north));
  std::string text = fmt::format("{} systems of waves, together {}", s.parts.size(), numbers);
  for (std::size_t i = 0; i < s.parts.size(); ++i)
    text += fmt::format("; {}: {}", s.parts[i].name,
                        waves_of(s.parts[i], north, s.parts[i].part_seed.value_or(seed + static_cast<int>(i))));
  return text;
}

std::string bed_of(const SeaSpec& sea, const SeaStateSpec& state) {
  const double depth = sea.wave_depth();
  if (std::isinf(depth) || state.type == SeaType::calm) return {};
  const SeaStatistics all = sea_statistics(state).back();
  if (!(all.significant_height > 0.0)) return {};
  const double length = kTwoPi / wave_number(kTwoPi / all.peak_period, sea.gravity, depth);
  if (depth >= 0.5 * length) return {};
  return fmt::format("; over a bed {} m down, where waves of {} s are {} m long", fixed_number(depth, 1),
                     fixed_number(all.peak_period, 1), fixed_number(length, 0));
}

}  // namespace

std::string direction_in_words(double relative) {
  // What travels towards the stern comes from ahead.
  const double from = std::remainder(relative + std::numbers::pi, kTwoPi);
  static constexpr std::array<const char*, 5> kPlaces = {"ahead", "bow", "beam", "quarter", "astern"};
  const auto step = static_cast<std::size_t>(std::lround(std::abs(from) / (45.0 * kDegree)));
  if (step == 0 || step == 4) return std::string("from ") + kPlaces[step];
  return std::string("from ") + (from > 0.0 ? "port " : "starboard ") + kPlaces[step];
}

double compass_from(double heading, double north) {
  const double turn = std::fmod(180.0 + (north - heading) / kDegree, 360.0);
  return std::round(turn < 0.0 ? turn + 360.0 : turn) == 360.0 ? 0.0 : turn < 0.0 ? turn + 360.0 : turn;
}

std::string sea_sentence(const SeaSpec& sea, std::optional<double> north) {
  const SeaStateSpec* state = sea.active_state();
  if (!state) return "Calm water";
  return fmt::format("Sea state {}: {}{}", state->name, waves_of(*state, north, state->seed), bed_of(sea, *state));
}

}  // namespace stillhook
