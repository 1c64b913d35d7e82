// From what a case says about a sea to its waves, and what no sea can be.
#include <cmath>

#include "sim/error.h"
#include "sim/number_text.h"
#include "sim/sea/dispersion.h"
#include "sim/sea/spectrum.h"
#include "sim/sea/wave_field.h"
#include "sim/sea/wave_kernel.h"
#include "sim/sea/wave_record.h"
#include "sim/spatial/constants.h"

namespace stillhook {

namespace {

using SeaType = SeaStateSpec::Type;

constexpr double kSteepest = 1.0 / 7.0;   // height over length in deep water (Miche 1944: 0.142 tanh kh)
constexpr double kHighestOfDepth = 0.78;  // height over depth, of a solitary wave (McCowan 1894)
constexpr double kRoughestOfDepth = 0.5;  // Hs over depth: beyond, crests of linear waves mean nothing

[[noreturn]] void refuse_sea(const SeaStateSpec& state, const char* field, const std::string& sentence) {
  throw SpecificationError("sea.states." + state.name, field, sentence);
}

void check_regular(const SeaStateSpec& s) {
  if (!(s.amplitude >= 0.0) || !std::isfinite(s.amplitude))
    refuse_sea(s, "amplitude", "must be >= 0 m, got " + number_text(s.amplitude));
  if (!(s.frequency > 0.0) || !std::isfinite(s.frequency))
    refuse_sea(s, "frequency", "must be > 0 rad/s, got " + number_text(s.frequency));
  if (!std::isfinite(s.phase)) refuse_sea(s, "phase", "must be a number, got " + number_text(s.phase));
}

void check_shape(const SeaStateSpec& s) {
  if (!(s.significant_height > 0.0) || !std::isfinite(s.significant_height))
    refuse_sea(s, "significant_height", "must be > 0 m, got " + number_text(s.significant_height));
  if (!(s.peak_period > 0.0) || !std::isfinite(s.peak_period))
    refuse_sea(s, "peak_period", "must be > 0 s, got " + number_text(s.peak_period));
  // From 1/0.287 = e^3.48 on the factor 1 - 0.287 ln gamma is negative; measured spectra lie between 1 and 7.
  if (s.gamma != 0.0 && !(s.gamma >= 1.0 && s.gamma <= 10.0))
    refuse_sea(s, "gamma", "must lie between 1 and 10 (or be left out), got " + number_text(s.gamma));
  // From 0.5 on the second moment, and with it Tz, does not exist.
  if (s.type == SeaType::ochi_hubble && !(s.lambda >= kFlattestLambda && s.lambda <= kSharpestLambda))
    refuse_sea(s, "lambda",
               "must lie between " + number_text(kFlattestLambda) + " and " + number_text(kSharpestLambda) + ", got " +
                   number_text(s.lambda));
}

void check_spreading(const SeaStateSpec& s) {
  if (!(s.spreading >= 0.0) || !std::isfinite(s.spreading))
    refuse_sea(s, "spreading", "must be >= 0, got " + number_text(s.spreading));
  if (!(s.spreading_2s >= 0.0) || !std::isfinite(s.spreading_2s))
    refuse_sea(s, "spreading_2s", "must be >= 0, got " + number_text(s.spreading_2s));
  if (s.spreading > 0.0 && s.spreading_2s > 0.0)
    refuse_sea(s, "spreading_2s",
               "cannot stand beside spreading: a sea spreads as cos^n or as cos^2s of half the angle");
  if (s.components < 1) refuse_sea(s, "components", "must be at least 1, got " + std::to_string(s.components));
  if (s.directions < 1) refuse_sea(s, "directions", "must be at least 1, got " + std::to_string(s.directions));
  if ((s.directions > 1) != (s.spreading > 0.0 || s.spreading_2s > 0.0))
    refuse_sea(s, "directions", "a short-crested sea needs both more than one direction and a spreading exponent > 0");
  if (static_cast<long>(s.components) * s.directions > kMaxWaveComponents)
    refuse_sea(s, "components",
               "components times directions must be at most " + std::to_string(kMaxWaveComponents) + ", got " +
                   std::to_string(static_cast<long>(s.components) * s.directions));
}

void check_spectrum(const SeaStateSpec& s) {
  if (!s.spectrum) refuse_sea(s, "spectrum", "needs the spectrum itself, energy over frequency and direction");
  if (s.waves < 1 || s.waves > kMaxWaveComponents)
    refuse_sea(s, "waves",
               "must lie between 1 and " + std::to_string(kMaxWaveComponents) + ", got " + std::to_string(s.waves));
  if (const std::string fault = fault_of(*s.spectrum); !fault.empty()) refuse_sea(s, "spectrum", fault);
}

void check_state(const SeaStateSpec& s) {
  if (!std::isfinite(s.heading)) refuse_sea(s, "heading", "must be a number, got " + number_text(s.heading));
  switch (s.type) {
    case SeaType::calm:
      return;
    case SeaType::regular:
      return check_regular(s);
    case SeaType::jonswap:
    case SeaType::pierson_moskowitz:
    case SeaType::ochi_hubble:
      check_shape(s);
      return check_spreading(s);
    case SeaType::spectrum:
      return check_spectrum(s);
    case SeaType::record:
      if (!s.record) refuse_sea(s, "record", "needs the record itself");
      return;
    case SeaType::sum:
      if (s.parts.empty()) refuse_sea(s, "parts", "a sum needs at least one part");
      for (const SeaStateSpec& part : s.parts)
        if (part.type == SeaType::calm || part.type == SeaType::sum || part.type == SeaType::record)
          refuse_sea(s, "parts", "calm water, a record and a sum cannot be parts of a sum: " + part.name);
  }
}

// A wave higher than that breaks.
void check_breaking(const SeaStateSpec& s, double gravity, double depth) {
  const double k = wave_number(s.frequency, gravity, depth), height = 2.0 * s.amplitude,
               steepness = height * k / kTwoPi;
  if (height > kHighestOfDepth * depth)
    refuse_sea(s, "amplitude",
               "the wave would break: it is " + number_text(height) + " m high in " + number_text(depth) +
                   " m of water, at most 0.78 of the depth is possible");
  const double limit = std::isinf(depth) ? kSteepest : kSteepest * std::tanh(k * depth);
  if (steepness > limit)
    refuse_sea(s, "amplitude",
               "the wave would break: height over length is " + number_text(steepness) + ", at most " +
                   (std::isinf(depth) ? "1/7" : number_text(limit) + " (1/7 tanh kh)") + " is possible");
}

double height_of(const std::vector<WaveComponent>& waves) {
  double variance = 0.0;
  for (const WaveComponent& c : waves) variance += 0.5 * c.amplitude * c.amplitude;
  return 4.0 * std::sqrt(variance);
}

std::vector<WaveComponent> components_of(const SeaStateSpec& s, double gravity, double depth, int place) {
  check_state(s);
  switch (s.type) {
    case SeaType::calm:
      return {};
    case SeaType::regular:
      check_breaking(s, gravity, depth);
      if (s.amplitude == 0.0) return {};
      return {{s.amplitude, s.frequency, wave_number(s.frequency, gravity, depth), std::cos(s.heading),
               std::sin(s.heading), s.phase}};
    case SeaType::record:
      return record_components(s, gravity, depth);
    case SeaType::sum:
      break;
    default:
      return spectrum_components(s, gravity, depth, place);
  }
  std::vector<WaveComponent> all;
  for (int i = 0; i < static_cast<int>(s.parts.size()); ++i) {
    const auto part = components_of(part_of(s, i), gravity, depth, i);
    all.insert(all.end(), part.begin(), part.end());
  }
  if (all.size() > static_cast<std::size_t>(kMaxWaveComponents))
    refuse_sea(s, "parts",
               "have " + std::to_string(all.size()) + " waves together, at most " + std::to_string(kMaxWaveComponents) +
                   " are possible");
  return all;
}

}  // namespace

WaveField build_wave_field(const SeaStateSpec& state, double gravity, double ramp, double depth) {
  if (state.type == SeaType::calm) return {};
  if (!(gravity > 0.0)) throw SpecificationError("sea", "gravity", "must be > 0 m/s2, got " + number_text(gravity));
  if (!(ramp >= 0.0)) throw SpecificationError("sea", "ramp", "must be >= 0 s, got " + number_text(ramp));
  if (!(depth > 0.0)) throw SpecificationError("sea", "depth", "must be > 0 m, got " + number_text(depth));
  std::vector<WaveComponent> waves = components_of(state, gravity, depth, 0);
  if (waves.empty()) return {};
  if (const double height = height_of(waves); state.type != SeaType::regular && height > kRoughestOfDepth * depth)
    refuse_sea(state, "",
               "has a significant height of " + number_text(height) + " m in " + number_text(depth) +
                   " m of water: linear waves mean nothing beyond half the depth");
  return {std::move(waves), ramp, depth};
}

WaveField build_wave_field(const SeaSpec& sea) {
  const SeaStateSpec* state = sea.active_state();
  return state ? build_wave_field(*state, sea.gravity, sea.ramp, sea.wave_depth()) : WaveField();
}

}  // namespace stillhook
