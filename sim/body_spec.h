// What a case says about a body. SI and radians; B is its frame, C its centre of gravity, W the world.
#pragma once

#include <string>

#include "sim/hull/hull_spec.h"
#include "sim/spatial/pose.h"

namespace stillhook {

struct BodySpec {
  std::string name;
  double mass = 0.0;                       // kg
  Vector3 cog = Vector3::Zero();           // m, p_BC
  Matrix3 inertia = Matrix3::Zero();       // kg m2, about C, axes of B
  Vector3 position = Vector3::Zero();      // m, p_WB at the start (first guess of the static equilibrium)
  RollPitchYaw attitude;                   // rad, at the start
  Vector3 velocity = Vector3::Zero();      // m/s, of Bo in W at the start (only with start = "as_given")
  Vector3 angular_velocity = Vector3::Zero();  // rad/s, in B at the start
  HullSpec hull;
  HydrodynamicsSpec hydrodynamics;

  /// The sea alone moves it, no force does.
  bool moved_by_sea() const { return hydrodynamics.kind == HydrodynamicsSpec::Kind::rao; }
  /// It has a hull whose pressure carries it.
  bool floats() const { return hull.shape != HullSpec::Shape::none && !moved_by_sea(); }
};

}  // namespace stillhook
