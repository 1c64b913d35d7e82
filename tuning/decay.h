// A free decay read as a p-q line.
//
//   decrement of a cycle   dA/A = p + q A        A  mean amplitude of the cycle
//
// For  I x'' + b x' + Q |x'| x' + C x = 0  lightly damped, the work of the damping over a cycle gives
//
//   p = pi b / (I w)        q = 8 Q / (3 I)       w = 2 pi / T = sqrt(C/I)
//
// b linear (N m s), Q quadratic (N m s2), I inertia with added mass; force instead of moment for translations.
// (Faltinsen 1990, ch. 7; Himeno 1981, sec. 4)
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace stillhook {

struct DecayCycle {
  double amplitude = 0.0;  // mean over the cycle, in the channel's unit
  double decrement = 0.0;  // relative loss in the cycle
};

struct DecayLine {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::string message;  // why there is no line; empty if there is
  double period = kNone;       // s, mean
  double p = kNone, q = kNone; // q per unit of the channel; both >= 0
  double centre = 0.0;         // what the motion settles to
  std::vector<DecayCycle> cycles;

  bool usable() const { return message.empty(); }
  double linear(double inertia) const;     // b
  double quadratic(double inertia) const;  // Q
};

/// Samples of one channel, NaN where there is none. Peaks are taken from parabolas through three samples; those below a
/// twentieth of the first are left out.
DecayLine analyse_decay(const std::vector<double>& time, const std::vector<double>& value);

}  // namespace stillhook
