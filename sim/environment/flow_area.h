// An area of a body in the wind or in the current: drag of the fluid that passes it, by area and coefficient along the
// axes of the body.
//
//   F_B,i = 1/2 rho C_i A_i |u| u_i s        u = R_BW (u_W - v), relative flow at the centre of the area, body axes
//
//   u_W  velocity of the fluid at the centre (stream.h), m/s      v  velocity of the centre, m/s, in W
//   s    share of the area's height that lies in the fluid, 0 to 1
//
// s grows as 3 x^2 - 2 x^3 while the centre goes from half the area's height outside the fluid to half of it inside:
// smooth, where the share itself has corners. Lift of inclined areas and the shelter of one body behind another are
// left out. The mean flow acts from the first static pose on, which is therefore one in it; gusts begin with the run.
// The force is drag: in a fluid at rest its power on a body is never positive.
#pragma once

#include <array>
#include <memory>

#include "sim/channel_kind.h"
#include "sim/environment/flow_spec.h"
#include "sim/environment/stream.h"
#include "sim/multibody/point.h"

namespace stillhook {

/// What is recorded of every entry, in the order in which measure() writes it.
template <class Spec>
struct FlowAreaChannels {
  static constexpr ChannelKind<Spec> force_x{"force_x", "N", "force of the flow on the body, world axes"};
  static constexpr ChannelKind<Spec> force_y{"force_y", "N", "force of the flow on the body, world axes"};
  static constexpr ChannelKind<Spec> force_z{"force_z", "N", "force of the flow on the body, world axes"};
  static constexpr ChannelKind<Spec> speed{"speed", "m/s", "flow relative to the centre of the area"};
  static constexpr std::array all = {force_x, force_y, force_z, speed};
};
using wind_channels = FlowAreaChannels<WindAreaSpec>;
using current_channels = FlowAreaChannels<CurrentAreaSpec>;

class FlowArea final : public ForceElement {
 public:
  /// `entry`: where the area stands in the case, for what is thrown; `centre` is that of the area. Throws
  /// SpecificationError when a number breaks its inequality.
  FlowArea(const std::string& name, const std::string& entry, const FlowAreaSpec& area,
           std::shared_ptr<const Stream> stream, const BodyPoint& centre);

  bool same_as(const ForceElement& other) const override;
  int scratch_size() const override { return stream_->memory_size(); }
  void add_forces(const Instant& now, double h, Memory m, ForceSum& out) const override;
  void add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const override;
  std::vector<Channel> channels() const override;
  void measure(const Instant& now, Memory m, std::span<double> out) const override;

 private:
  struct Flow {
    Matrix3 R_WB;
    Vector3 w;               // m/s, u in B
    Vector3 full;            // N, in B: the force with the whole area in the fluid
    Matrix3 slope;           // N s/m: its derivative by u in B
    double share;            // s
    Vector3 share_by_place;  // 1/m
    Matrix3 by_place;        // 1/s, of the fluid's velocity
  };
  Flow flow(const Instant& now, Memory m) const;

  BodyPoint centre_;
  std::shared_ptr<const Stream> stream_;
  Vector3 resistance_ = Vector3::Zero();  // N s2/m2: 1/2 rho C_i A_i
  double half_height_ = 0.0;              // m
};

}  // namespace stillhook
