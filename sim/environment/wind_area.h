// Wind on a body: drag of the air that passes it, by area and coefficient along the axes of the body.
//
//   F_B,i = 1/2 rho C_i A_i |u| u_i s(z)        u = R_BW (U(z) e - v), relative wind at the centre of the area, body
//   axes
//
//   U(z)  mean wind at height z above still water, m/s        e   direction it blows to, horizontal unit vector in W
//   v     velocity of the centre of the area, m/s, in W       s   share of the area's height above still water, 0 to 1
//
// Profiles of the hourly mean, with U0 at 10 m:
//   iso       U = U0 (1 + C ln(z/10)),  C = 0.0573 sqrt(1 + 0.148 U0)        ISO 19901-1, from NPD
//   power     U = U0 (z/10)^a
//   constant  U = U0
// Below 1 m the wind is that at 1 m. s grows as 3 x^2 - 2 x^3 while the centre rises from half the area's height below
// the still water to half of it above: smooth, where the share itself has corners. The wind is steady; gusts, the lift
// of inclined areas and the shelter of one body behind another are left out. It acts from the first static pose on,
// which is therefore one in the wind. The force is drag: in air at rest its power on a body is never positive.
#pragma once

#include <array>

#include "sim/channel_kind.h"
#include "sim/environment/wind_spec.h"
#include "sim/error.h"
#include "sim/multibody/point.h"

namespace stillhook {

/// What is recorded of every entry, in the order in which measure() writes it.
namespace wind_channels {
inline constexpr ChannelKind<WindAreaSpec> force_x{"force_x", "N", "wind force on the body, world axes"};
inline constexpr ChannelKind<WindAreaSpec> force_y{"force_y", "N", "wind force on the body, world axes"};
inline constexpr ChannelKind<WindAreaSpec> force_z{"force_z", "N", "wind force on the body, world axes"};
inline constexpr ChannelKind<WindAreaSpec> speed{"speed", "m/s", "wind relative to the centre of the area"};
inline constexpr std::array all = {force_x, force_y, force_z, speed};
}  // namespace wind_channels

/// Mean wind at height z (m) above still water, m/s, and its derivative by z, 1/s.
struct WindSpeed {
  double value = 0.0, slope = 0.0;
};
WindSpeed wind_speed(const WindSpec& wind, double z, const Instant& now);

class WindArea final : public ForceElement {
 public:
  /// `centre` is that of the area. Throws SpecificationError when a number breaks its inequality.
  WindArea(const WindAreaSpec& area, const WindSpec& wind, const BodyPoint& centre);

  bool same_as(const ForceElement& other) const override;
  void add_forces(const Instant& now, double h, Memory m, ForceSum& out) const override;
  void add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const override;
  std::vector<Channel> channels() const override;
  void measure(const Instant& now, Memory m, std::span<double> out) const override;

 private:
  struct Flow {
    Matrix3 R_WB;
    Vector3 w;                 // m/s, u in B
    Vector3 full;              // N, in B: the force with the whole area in the wind
    Matrix3 slope;             // N s/m: its derivative by u in B
    double share, share_by_z;  // s and its derivative by z, 1/m
    double wind_by_z;          // 1/s
  };
  Flow flow(const Instant& now) const;

  BodyPoint centre_;
  WindSpec wind_;
  Vector3 resistance_ = Vector3::Zero();  // N s2/m2: 1/2 rho C_i A_i
  double half_height_ = 0.0;              // m
  Vector3 direction_ = Vector3::UnitX();  // e
};

}  // namespace stillhook
