// A frame that moves as a function of time alone: what a joint to the world may hold a body to, instead of a place.
#pragma once

#include "sim/spatial/pose.h"

namespace stillhook {

/// Pose X_WF of a frame F, and its velocities and accelerations, all in W.
struct FrameMotion {
  Matrix3 R = Matrix3::Identity();
  Vector3 p = Vector3::Zero();      // m
  Vector3 v = Vector3::Zero();      // m/s
  Vector3 a = Vector3::Zero();      // m/s2
  Vector3 w = Vector3::Zero();      // rad/s
  Vector3 w_dot = Vector3::Zero();  // rad/s2
};

class PrescribedMotion {
 public:
  PrescribedMotion() = default;
  virtual ~PrescribedMotion() = default;
  PrescribedMotion(const PrescribedMotion&) = delete;
  PrescribedMotion& operator=(const PrescribedMotion&) = delete;

  /// Twice differentiable in t (s).
  virtual FrameMotion at(double t) const = 0;
  /// True if the other is the same function of time. False is always safe.
  virtual bool same_as(const PrescribedMotion& other) const = 0;
};

}  // namespace stillhook
