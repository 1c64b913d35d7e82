// How a drive moves from rest to rest: length and rate from one smooth profile.
//
//   rate(t) = sum_i A_i base(t - t_i),   sum_i A_i = 1,  A_i > 0
//
//   base  rate of the trapezoid, s-curve or knots, per s;  A_i, t_i  impulses of the shaper, one at t = 0 without
//   shaper
//
// Shaped by two impulses half a damped period apart (ZV) a move leaves no swing of a pendulum of that period; by three
// (ZVD) it bears twice the error of the period, for one half period more. N. C. Singer and W. P. Seering, Journal of
// Dynamic Systems, Measurement, and Control 112 (1990) 76-82. The peak rate is never above that of the base.
#pragma once

#include <vector>

#include "sim/operation_spec.h"

namespace stillhook {

/// One impulse of an input shaper.
struct ShaperImpulse {
  double share;  // 1, of the whole command
  double time;   // s
};

/// The impulses of a shaper for a swing of natural period `period` (s, undamped, > 0) and damping ratio in [0, 1).
std::vector<ShaperImpulse> shaper_impulses(ProfileSpec::Shaper shaper, double period, double damping);

/// Position and rate along a travel, as functions of the time since the start. position(0) = 0, position(duration)
/// = travel, rate(0) = rate(duration) = 0; position is the exact integral of rate.
class RateProfile {
 public:
  RateProfile() = default;  // no travel, no time
  /// The profile that covers `travel` (signed) with peak speed `speed` (> 0) and the given shape. trapezoid: linear
  /// ramps; s_curve: sin^2 ramps; knots: cubic-free piecewise linear speeds through the relative knots at equal
  /// times, scaled so that the largest knot is `speed`, with the ramps at both ends. When the travel is too short for
  /// full speed the ramps keep their length and the speed is lowered. A shaper wants its period given. Throws
  /// std::invalid_argument.
  RateProfile(const ProfileSpec& spec, double travel, double speed);

  double travel() const { return travel_; }
  double duration() const { return impulses_.back().time + base_duration_; }  // s
  double position(double t) const;                                            // clamped outside [0, duration]
  double rate(double t) const;                                                // zero outside
  double peak_rate() const { return peak_rate_; }                             // largest |rate|
  double peak_acceleration() const { return peak_acceleration_; }             // largest |d rate/dt|, per s2

 private:
  double base_position(double t) const;
  double base_rate(double t) const;
  struct Piece;
  Piece piece_around(double t) const;
  void find_peaks();

  ProfileSpec::Shape shape_ = ProfileSpec::Shape::s_curve;
  double travel_ = 0.0, base_duration_ = 0.0, ramp_ = 0.0, speed_ = 0.0;
  std::vector<double> knot_time_, knot_rate_, knot_position_;
  std::vector<ShaperImpulse> impulses_ = {{1.0, 0.0}};
  double peak_rate_ = 0.0, peak_acceleration_ = 0.0;
};

}  // namespace stillhook
