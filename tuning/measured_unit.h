// Units that measured files come in, what they are in SI, how they scale between model and full scale, and the factors
// by which people mistake them.
//
//   Froude, scale s = full / model:  length s, time s^(1/2), speed s^(1/2), angle 1, rate s^(-1/2), force s^3, moment s^4
#pragma once

#include <optional>
#include <string>

namespace stillhook {

struct MeasuredUnit {
  std::string name, si;       // si: as Channel::unit
  double factor = 1.0;        // SI per unit
  double froude = 0.0;        // exponent of the scale
};

/// Nothing for a unit that is not known; known_units() lists them.
std::optional<MeasuredUnit> measured_unit(const std::string& name);
std::string known_units();

/// s per unit of time, as UDUNITS spells it: "s", "minutes", "hours since 2024-01-01"; nothing for anything else.
std::optional<double> measured_time_unit(const std::string& text);

/// What it looks like when measured values are `ratio` times too large: "57.3 times too large, as degrees taken for
/// radians"; empty if no usual mistake comes near (35 %). `si`: unit of the channel.
std::string mistaken_unit(double ratio, const std::string& si);

}  // namespace stillhook
