// Numbers that no case changes and that every room may need.
#pragma once

#include <limits>
#include <numbers>

namespace stillhook {

/// Standard acceleration of free fall, m/s2. It turns forces into tonnes for display, and accelerations into shares of g;
/// the gravity of a lift is the case's own (SeaSpec::gravity).
inline constexpr double kStandardGravity = 9.80665;
/// One degree in rad.
inline constexpr double kDegree = std::numbers::pi / 180.0;
/// A full turn, rad.
inline constexpr double kTwoPi = 2.0 * std::numbers::pi;
/// The number that says "there is no value".
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace stillhook
