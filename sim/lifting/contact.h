// Contact of points of one body with a flat rectangle fixed to another.
//
// In the surface body's frame S, for each point at depth d below the rectangle (d > 0 and inside its edges):
//   N   = max(0, k d + c s(d / d0) ddot)      along +z of S, see unilateral.h: continuous at the touch, no adhesion
//   F_t = P(E - c_t v_t),  E = P(-k_t (x_t - a))        in the plane of S: sticks up to the friction cone, then slips
//
//   k, c  stiffness (N/m) and damping (N s/m) of one point, the given totals divided by the number of points
//   d0    depth over which the damping grows, m       mu  friction, 1
//   k_t, c_t  tangential stiffness and damping: those of the normal direction
//   x_t, v_t  place and velocity of the point in the plane, seen by the surface body        a  where it sticks, m
//   P     cut to the friction cone: P(f) = f while |f| <= mu N, else mu N f/|f|
//
// The anchor a is the element's state: it follows the point while there is no touch, stays while it sticks, and after a
// slip stands where the spring carries just what the cone allows (radial return, as in plasticity). So a load at rest
// on a deck stays where it stands, and statics (h = 0) hold it where start() found it. The surface body feels the
// opposite force at the touching point, with its moment. Energy: sum of 1/2 k d^2 + 1/2 |E|^2/k_t; heat:
// (N - k d) ddot + (E - F_t) . v_t - E . adot. Each of the three is never negative; the second because a cut to a
// convex set has (E - F_t) . v_t >= |E - F_t|^2 / c_t, which a damper inside a single cut would not give. A point that
// leaves the surface loses what is stored.
#pragma once

#include <ceres/jet.h>
#include <array>

#include "sim/channel_kind.h"
#include "sim/multibody/point.h"

namespace stillhook {

struct ContactSpec;

/// What is recorded of every entry, in the order in which measure() writes it.
namespace contact_channels {
inline constexpr ChannelKind<ContactSpec> force{"force", "N", "normal force, all points together"};
inline constexpr ChannelKind<ContactSpec> penetration{"penetration", "m", "deepest penetration"};
inline constexpr ChannelKind<ContactSpec> gap{"gap", "m", "smallest distance to the surface, negative when penetrated"};
inline constexpr ChannelKind<ContactSpec> approach_speed{
    "approach_speed", "m/s", "normal approach speed of the fastest touching, else the nearest point"};
inline constexpr ChannelKind<ContactSpec> x{"x", "m", "place: mean of the touching points, else the nearest point"};
inline constexpr ChannelKind<ContactSpec> y{"y", "m", "place"};
inline constexpr ChannelKind<ContactSpec> z{"z", "m", "place"};
inline constexpr std::array all = {force, penetration, gap, approach_speed, x, y, z};
}  // namespace contact_channels

struct ContactOptions {
  std::string name;
  int body = kWorld;                   // carries the points
  std::vector<Vector3> points;         // m, c_B: relative to its centre of gravity; at least one
  BodyPoint surface;                   // centre of the rectangle on the other body (or the world)
  double length = 0.0, breadth = 0.0;  // m, along x and y of the surface body, > 0
  double stiffness = 0.0;              // N/m, all points together, > 0
  double damping = 0.0;                // N s/m, all points together, >= 0
  double damping_depth = 0.005;        // m, > 0
  double friction = 0.0;               // 1, >= 0
  int active_from_phase = 0;           // index of the operation's phase with which the contact begins to act

  bool operator==(const ContactOptions&) const = default;
};

class Contact final : public ForceElement {
 public:
  /// Throws SpecificationError when an option breaks its inequality.
  explicit Contact(ContactOptions options);

  const ContactOptions& options() const { return options_; }

  bool same_as(const ForceElement& other) const override;
  int state_size() const override { return kStatesPerPoint * static_cast<int>(options_.points.size()); }
  void start(const Instant& now, Memory m) const override;
  void settle(const Instant& now, Memory m) const override;
  void end_step(const Instant& now, double h, Memory m) const override;
  void add_forces(const Instant& now, double h, Memory m, ForceSum& out) const override;
  void add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const override;
  bool add_history_tangent(const Instant& before, const Instant& now, double h, Memory m, const BodyChange& from,
                           const Eigen::Ref<const MatrixX>& state, Eigen::Ref<MatrixX> dQ) const override;
  bool advance_state_tangent(const Instant& before, const Instant& now, double h, Memory m, const BodyChange& from,
                             const BodyChange& to, Eigen::Ref<MatrixX> state) const override;
  double potential_energy(const Instant& now, Memory m) const override;
  double dissipated_power(const Instant& now, Memory m) const override;
  /// Force, deepest penetration, smallest gap (distance to the rectangle; negative: penetrated), approach speed
  /// (fastest touching point, or the nearest one while none touches; 0 when it moves away), and place: mean of the
  /// touching points, or the nearest one.
  std::vector<Channel> channels() const override;
  void measure(const Instant& now, Memory m, std::span<double> out) const override;

  /// The points that lie lower than the surface and beside its edges, so that it does not hold them.
  struct Missed {
    int count = 0;
    int point = 0;        // the one nearest to an edge
    double beside = 0.0;  // m, its horizontal distance from the rectangle
  };
  /// None of a contact that does not act yet.
  Missed missed(const Instant& now) const;

 private:
  struct Surface;
  struct Touch;
  struct Grip;
  struct Seen;
  using Dual = ceres::Jet<double, 2>;
  enum {
    kAnchorX,
    kAnchorY,
    kSlipX,
    kSlipY,
    kStatesPerPoint
  };  // m in S, and speed of the anchor over the last step, m/s
  Surface surface(const Instant& now) const;
  Touch touch(const Vector3& point, const Surface& s, const Instant& now) const;
  Seen seen(const Touch& t, const Surface& s, const Instant& now) const;
  double normal_force(const Touch& t, const Instant& now) const;
  Dual normal_force_by_depth(const Touch& t) const;
  Grip grip(const Touch& t, double N, std::span<const double> state, Branches* branches = nullptr) const;
  bool active(const Instant& now) const { return now.phase >= options_.active_from_phase; }

  ContactOptions options_;
  double k_ = 0.0, c_ = 0.0;  // of one point
};

}  // namespace stillhook
