// The motion of a vessel that displacement RAOs give in a sea: the sum over the waves, about the mean pose.
//
//   q_i(t) = r(t) sum_j a_j Re(X_i(w_j, b_j) exp(i th_j))     th_j at the mean position of Q (rao_table.h)
//   reference point  p(t) = p_mean + R_WH (q_1, q_2, q_3)     R_WB(t) = R_WH Rz(q_6) Ry(q_5) Rx(q_4) R_HB
//
// H is the heading frame of the mean pose. So the reference point moves by exactly what the RAOs say, and without mean
// heel and trim the roll and pitch of the body are q_4 and q_5, its yaw the mean heading and q_6. r(t) is the ramp of
// the waves. Nothing else moves the body: no drift, no heel under its load, no reaction to its lines.
//
// A wave acts if its frequency lies within the table's and its direction is a heading of the table or between two that
// are at most 45 deg apart. Another direction is refused. Waves outside the frequencies move nothing and are refused
// where they hold more than 1 % of the sea's energy; shorter ones may be cut off by rule (RaoSpec::Beyond::cut).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/hull/coefficients/rao_table.h"
#include "sim/multibody/prescribed_motion.h"
#include "sim/sea/wave_field.h"

namespace stillhook {

class RaoMotion final : public PrescribedMotion {
 public:
  /// The motion of the body's frame B (origin Bo) whose mean pose is that of the specification. Throws
  /// SpecificationError for waves that the table does not cover; `notes` gets what a reader must know of the rest.
  RaoMotion(const BodySpec& body, const RaoTable& table, std::shared_ptr<const WaveField> waves,
            std::vector<std::string>& notes);

  FrameMotion at(double t) const override;
  bool same_as(const PrescribedMotion& other) const override;

 private:
  struct Component {
    double frequency, phase;  // rad/s; rad, th of the wave at Q at t = 0
    Raos motion;              // of the reference point, m and rad
    bool operator==(const Component&) const = default;
  };
  void cover(const BodySpec& body, const RaoTable& table, std::vector<std::string>& notes) const;

  std::shared_ptr<const WaveField> waves_;
  std::vector<Component> components_;
  Matrix3 R_WH_ = Matrix3::Identity(), R_HB_ = Matrix3::Identity();
  Vector3 mean_ = Vector3::Zero();       // m, the reference point in W
  Vector3 reference_ = Vector3::Zero();  // m, the reference point in B
};

}  // namespace stillhook
