// The unit of what a drive moves.
#pragma once

#include "sim/specification.h"

namespace stillhook {

enum class DriveMotion { length, angle, share };

/// Winches, tows and the drives of sliding joints move by lengths (m), those of hinges turn (rad), ballast goes by
/// shares (1).
DriveMotion drive_motion(const Specification& s, const DriveSpec& drive);

/// SI unit of a drive's position and of its rate: "m" and "m/s", "rad" and "rad/s", "1" and "1/s".
const char* position_unit(DriveMotion motion);
const char* rate_unit(DriveMotion motion);

}  // namespace stillhook
