// What a number of the results is a quantity of: the one place that knows in which unit metrics are given, what that is
// in SI, and how reports write it.
#pragma once

#include <string>

#include "sim/spatial/constants.h"

namespace stillhook {

enum class Quantity {
  ratio,       // 1, three decimals
  share,       // 1, of time or of a limit; in percent beside it
  count,       // 1, whole
  length,      // m
  angle,       // deg
  force,       // kN, in tonnes beside it
  impulse,     // kN s
  speed,       // m/s
  line_speed,  // m/s, of a winch: in m/min beside it
  time         // s
};

/// The unit that metrics of a quantity are given in: "m", "deg", "kN", "kN s", "m/s", "s", "1".
const char* unit_of(Quantity quantity);

/// A value in SI and radians in that unit.
double in_unit(double si, Quantity quantity);

/// A first noticeable violation of a limit of zero, in the metric's unit: the scale of a constraint that has no other.
double noticeable_step(Quantity quantity);

/// A value with its unit as people read it: "0.42 m", "4 903 kN (500.0 t)".
struct Shown {
  std::string value;  // in the unit of `unit`
  std::string unit;
  std::string aside;  // the same in the operator's unit, may be empty
};

/// `value` in the metric's unit.
Shown shown(Quantity quantity, double value);

/// "1:02:05" from seconds, "2:05" below an hour.
std::string clock_time(double seconds);

/// The unit that tables and plots show for a channel: value in SI / factor is in `name`.
struct ShownUnit {
  std::string name;
  double factor = 1.0;  // SI per shown
};
ShownUnit shown_unit(const std::string& si);

/// SI in what operators say: the weight of a tonne (N), a metre per minute (m/s).
inline constexpr double kTonneForce = 1e3 * kStandardGravity;
inline constexpr double kPerMinute = 1.0 / 60.0;

}  // namespace stillhook
