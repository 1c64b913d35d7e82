// What a case says about a joint. SI and radians.
#pragma once

#include <string>

#include "sim/spatial/pose.h"

namespace stillhook {

struct JointSpec {
  enum class Type { revolute, fixed, spherical, prismatic };
  std::string name;
  Type type = Type::revolute;
  std::string parent, child;               // bodies; parent may be "world"
  Vector3 point_on_parent = Vector3::Zero();  // m, in the parent's B
  Vector3 point_on_child = Vector3::Zero();   // m, in the child's B
  Vector3 axis = Vector3::UnitY();         // in the parent's B; revolute: of rotation, prismatic: of sliding
  // A driven or sprung joint (revolute: N m/rad, prismatic: N/m); the drive moves the rest position.
  double stiffness = 0.0;
  double damping = 0.0;
  double rest = 0.0;                       // rad or m, coordinate at zero load, relative to the initial pose
  std::string drive;                       // name of a drive, empty = none
};

}  // namespace stillhook
