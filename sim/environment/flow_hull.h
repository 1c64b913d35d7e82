// A hull in the wind or in the current: forces by coefficients over the direction of the flow relative to its slow
// motion.
//
//   G = (F_x, F_y, M_z) in the hull's heading frame:  q A_x C_x(a),  q A_y C_y(a),  q B C_n(a) - D r |r|
//   q = 1/2 rho |u_r|^2,   u_r = R_z(-psi) (u_W - v),   a = atan2(-u_r,y, -u_r,x),   D = 1/2 rho C A_y L^3/32
//
//   u_W  velocity of the fluid: of the wind at the height of the side area's centroid, of the current at half the draft
//   v, r  slow velocity of the centre of gravity and slow yaw rate: Tf dv/dt = v_C - v, and so for r
//   psi  heading now;  C  the largest C_y, as uniform along the length: a strip at x meets the flow x r
//
// The hull's own velocity goes through the filter because what it does to wave-frequency motions is in its radiation
// and viscous damping already. (OCIMF's form of the coefficients; the same cut is made by vessel theory of OrcaFlex.)
// F_x and F_y act at heights of their own in the frame of the hull, so that they heel and trim it.
//
// One step, h, by the trapezoidal rule: v1 = (1 - 2w) v0 + w (v_C0 + v_C1),  w = h/(2 Tf + h): in closed form, so the
// state leaves Newton's method. In statics (h = 0) v and r are those of the state, at rest.
#pragma once

#include <array>
#include <memory>

#include "sim/channel_kind.h"
#include "sim/environment/flow_coefficients.h"
#include "sim/environment/stream.h"
#include "sim/multibody/point.h"

namespace stillhook {

/// What is recorded of every entry, in the order in which measure() writes it.
template <class Spec>
struct FlowHullChannels {
  static constexpr ChannelKind<Spec> force_x{"force_x", "N", "force of the flow on the hull, world axes"};
  static constexpr ChannelKind<Spec> force_y{"force_y", "N", "force of the flow on the hull, world axes"};
  static constexpr ChannelKind<Spec> moment{"moment", "N m", "yaw moment of the flow about the reference point"};
  static constexpr ChannelKind<Spec> speed{"speed", "m/s", "flow relative to the slow motion of the hull"};
  static constexpr ChannelKind<Spec> angle{"angle", "rad",
                                           "direction the relative flow comes from, off the bow, to port"};
  static constexpr std::array all = {force_x, force_y, moment, speed, angle};
};
using wind_hull_channels = FlowHullChannels<WindHullSpec>;
using current_hull_channels = FlowHullChannels<CurrentHullSpec>;

struct FlowHullOptions {
  std::string name;
  int body = 0;
  BodyPoint along = {}, across = {};  // where F_x and F_y act
  FlowCoefficients coefficients;
  double area_along = 0.0, area_across = 0.0;  // m2, A_x and A_y, > 0
  double moment_size = 0.0;                    // m3, B, > 0
  double length = 0.0;                         // m, L, > 0
  double filter = 20.0;                        // s, Tf, > 0
  double distance = 0.0;  // m from the surface, where the fluid's velocity is taken (Stream::at_hull)
};

class FlowHull final : public ForceElement {
 public:
  /// Throws SpecificationError(entry) when a number breaks its inequality.
  FlowHull(FlowHullOptions options, const std::string& entry, std::shared_ptr<const Stream> stream);

  bool same_as(const ForceElement& other) const override;
  int state_size() const override { return 3; }
  int scratch_size() const override { return 3 + stream_->memory_size(); }
  void start(const Instant& now, Memory m) const override;
  void begin_step(const Instant& before, double h, Memory m) const override;
  void add_forces(const Instant& now, double h, Memory m, ForceSum& out) const override;
  void add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const override;
  void end_step(const Instant& now, double h, Memory m) const override;
  bool add_history_tangent(const Instant& before, const Instant& now, double h, Memory m, const BodyChange& from,
                           const Eigen::Ref<const MatrixX>& state, Eigen::Ref<MatrixX> dQ) const override;
  bool advance_state_tangent(const Instant& before, const Instant& now, double h, Memory m, const BodyChange& from,
                             const BodyChange& to, Eigen::Ref<MatrixX> state) const override;
  std::vector<Channel> channels() const override;
  void measure(const Instant& now, Memory m, std::span<double> out) const override;

  /// Forces in the heading frame and yaw moment (N, N m) in a flow of the velocity `relative` (m/s, heading frame), and
  /// their derivatives by it; `yaw_rate`, rad/s, slow.
  struct Load {
    Vector3 value;
    Eigen::Matrix<double, 3, 2> by_flow;
    double moment_by_rate = 0.0;  // N m s
  };
  Load load(const Eigen::Vector2d& relative, double yaw_rate) const;

 private:
  using Matrix36 = Eigen::Matrix<double, 3, 6>;
  /// Velocity of the centre of gravity in x and y of W, m/s, and yaw rate, rad/s; and its derivative by the pose.
  Vector3 motion(const Instant& now) const;
  Matrix36 motion_by_pose(const Instant& now) const;
  Matrix36 motion_by_velocity(const Instant& now) const;
  Vector3 slow_motion(const Instant& now, double h, Memory m) const;

  struct Flow {
    Vector3 ahead, port;                  // heading axes in W
    Eigen::Vector2d relative;             // m/s, u_r
    Eigen::Matrix<double, 2, 3> by_slow;  // its derivative by the slow motion
    Eigen::RowVector3d heading_by_turn;   // d psi / d theta
    Load load;
  };
  Flow flow(const Instant& now, const Vector3& slow, Memory m) const;
  /// Adds what the load changes by `dG` (3 x columns) to the forces (6 rows).
  MatrixX generalised(const Instant& now, const Flow& f, const MatrixX& dG) const;
  double weight(double h) const { return h / (2.0 * options_.filter + h); }

  FlowHullOptions options_;
  std::shared_ptr<const Stream> stream_;
};

}  // namespace stillhook
