#include "sim/drive_unit.h"
#include "sim/specification.h"

namespace stillhook {

DriveMotion drive_motion(const Specification& s, const DriveSpec& drive) {
  if (drive.kind == DriveSpec::Kind::ballast) return DriveMotion::share;
  if (drive.kind == DriveSpec::Kind::joint)
    for (const JointSpec& joint : s.joints)
      if (joint.drive == drive.name && joint.type == JointSpec::Type::revolute) return DriveMotion::angle;
  return DriveMotion::length;
}

const char* position_unit(DriveMotion motion) {
  return motion == DriveMotion::angle ? "rad" : motion == DriveMotion::share ? "1" : "m";
}

const char* rate_unit(DriveMotion motion) {
  return motion == DriveMotion::angle ? "rad/s" : motion == DriveMotion::share ? "1/s" : "m/s";
}

}  // namespace stillhook
