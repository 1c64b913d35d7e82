// How a drive moves from rest to rest: length and rate from one smooth profile.
#pragma once

#include <vector>

#include "sim/specification.h"

namespace stillhook {

/// Position and rate along a travel, as functions of the time since the start. position(0) = 0, position(duration)
/// = travel, rate(0) = rate(duration) = 0; position is the exact integral of rate.
class RateProfile {
 public:
  RateProfile() = default;  // no travel, no time
  /// The profile that covers `travel` (signed) with peak speed `speed` (> 0) and the given shape. trapezoid: linear
  /// ramps; s_curve: sin^2 ramps; knots: cubic-free piecewise linear speeds through the relative knots at equal
  /// times, scaled so that the largest knot is `speed`, with the ramps at both ends. When the travel is too short for
  /// full speed the ramps keep their length and the speed is lowered.
  RateProfile(const ProfileSpec& spec, double travel, double speed);

  double travel() const { return travel_; }
  double duration() const { return duration_; }  // s
  double position(double t) const;               // clamped outside [0, duration]
  double rate(double t) const;                   // zero outside
  double peak_rate() const;                      // largest |rate|
  double peak_acceleration() const;              // largest |d rate/dt|, per s2

 private:
  ProfileSpec::Shape shape_ = ProfileSpec::Shape::s_curve;
  double travel_ = 0.0, duration_ = 0.0, ramp_ = 0.0, speed_ = 0.0;
  std::vector<double> knot_time_, knot_rate_, knot_position_;
};

}  // namespace stillhook
