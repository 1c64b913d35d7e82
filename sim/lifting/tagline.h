// Taglines under proportional-derivative control: Eq. 12-15 of Cha, Nam & Ha (2018), on a real winch.
//
// Sign. theta is the angle of the hoist wire from the vertical in the vertical plane of the tagline, positive where
// the load hangs away from the tagline's winch; pulling reduces it. With n the horizontal unit vector of the plane,
// from the winch towards the load, and d the lower end of the hoist wire from its upper end,
//   theta = atan2(n . d, -d_z),     e = theta - set_point,     edot = thetadot  (the set point is constant).
// So thetadot > 0 means that the load moves away from the winch, and the winch pulls to stop it.
//   case A  (thetadot >= 0, e >= 0):  T_law = Kp e + Kd edot                              (12)
//   case B  (thetadot >= 0, e <  0):  T_law = Kd edot                                     (13)
//   case C  (thetadot <  0):          T_law = 0                                           (14)
//   T_command = min(pretension + T_law, tension_max);   force on the load: T towards the winch (15).
//
// The plane. n is the horizontal direction from the line's winch to its point on the load at the initial pose, kept in
// the heading of the winch's body from then on. The direction at each instant would be the other choice: but a line to
// a hoisted load stands steep, and then a metre of sway or a few degrees of load yaw turns it by tens of degrees, its
// sign flips when the load passes over the winch, and its derivative has no bound. With the direction kept, theta
// stays the smooth "fore-aft" (or athwart) angle that the operator sees, and turns with the vessel.
//
// Gain schedule. Kp = kp f_p(L), Kd = kd f_d(L), L the distance of the hoist wire's ends, f given at some lengths,
// linear between them and constant outside.
//
// The winch. Line: elastic and unilateral, T = max(0, k (l - Lw)), k = EA/(length at the initial pose), l its length,
// Lw the length paid out. The winch runs at
//   dLw/dt = clip( ldot + (T_lin - T_command)/(k tau), -+ speed_max ),    T_lin = k (l - Lw),
// so that below its speed limit the tension follows its command as a first-order lag, tau dT/dt = T_command - T,
// however the load moves, and at its limit the line is an elastic one on a winch of constant speed. Above tension_max
// the brake slips: T = tension_max.
//
// One step, h: by the trapezoidal rule the tension without a limit is
//   T1 = ((1 - a) T0 + a (c0 + c1))/(1 + a),   a = h/(2 tau),   c = T_command,
// the line paid out for it dLw = l1 - l0 - (T1 - T0)/k; if |dLw| > h speed_max it is cut to that and T1 = k (l1 - Lw1).
// All in closed form, so the state leaves Newton's method. At thetadot = 0 the law of Eq. 12 jumps by Kp e: a step that
// ends on the jump would have no solution, and a run would not depend smoothly on anything that moves the instant of
// the jump. So the Kp term sets in over a small rate, s(thetadot/rate0) Kp e with s(x) = x^2 (3 - 2 x), rate0 = 2e-4
// rad/s (a hundredth of a degree a second; swings have a hundred times that). In statics (h = 0) T is the steady value,
// min(pretension + Kp max(0, e), tension_max).
//
// Energy: 1/2 T^2/k in the line; heat T x slip speed in the brake; the winch gives -T x (rest of the line speed).
#pragma once

#include <array>

#include "sim/channel_kind.h"
#include "sim/lifting/plane_angle.h"

namespace stillhook {

struct TaglineSpec;

/// What is recorded of every entry, in the order in which measure() writes it.
namespace tagline_channels {
inline constexpr ChannelKind<TaglineSpec> tension{"tension", "N", "tension"};
inline constexpr ChannelKind<TaglineSpec> command{"command", "N", "commanded tension"};
inline constexpr ChannelKind<TaglineSpec> line_speed{"line_speed", "m/s",
                                                     "speed of the line at the winch, positive paying out"};
inline constexpr ChannelKind<TaglineSpec> saturated{"saturated", "1", "1 while the speed or the tension limit acts"};
inline constexpr ChannelKind<TaglineSpec> angle{"angle", "rad",
                                                "controlled angle of the hoist wire, positive away from the winch"};
inline constexpr ChannelKind<TaglineSpec> angle_rate{"angle_rate", "rad/s", "its rate"};
inline constexpr std::array all = {tension, command, line_speed, saturated, angle, angle_rate};
}  // namespace tagline_channels

/// Factors on the gains at one length of the hoist wire.
struct GainPoint {
  double fall = 0.0;                        // m, > 0
  double kp_factor = 1.0, kd_factor = 1.0;  // >= 0

  bool operator==(const GainPoint&) const = default;
};

struct TaglineOptions {
  std::string name;
  BodyPoint from, to;                  // winch, load
  BodyPoint hoist_upper, hoist_lower;  // ends of the hoist wire whose angle is controlled
  double kp = 0.0;                     // N/rad, >= 0
  double kd = 0.0;                     // N s/rad, >= 0
  std::vector<GainPoint> schedule;     // by rising fall; empty = factors 1
  double set_point = 0.0;              // rad
  double pretension = 0.0;             // N, >= 0
  double tension_max = 0.0;            // N, > 0
  double speed_max = 0.0;              // m/s, >= 0; 0 = unlimited
  double time_constant = 0.5;          // s, > 0
  double axial_stiffness = 2.0e7;      // EA, N, > 0
  bool active = true;                  // false: no line
  int active_from_phase = 0;           // index of the operation's phase with which the line is connected

  bool operator==(const TaglineOptions&) const = default;
};

class Tagline final : public ForceElement {
 public:
  /// `initial` defines the plane and the length that EA refers to. Throws SpecificationError when an option breaks its
  /// inequality, or when the line stands so steep at the initial pose (less than a tenth of its length horizontal)
  /// that it defines no plane.
  Tagline(TaglineOptions options, const Instant& initial);

  const TaglineOptions& options() const { return options_; }
  double line_stiffness() const { return k_; }  // N/m
  const PlaneAngle& angle() const { return angle_; }
  /// Kp and Kd, and their change per metre of the hoist wire.
  struct Gains {
    double kp = 0.0, kd = 0.0;  // N/rad, N s/rad
    double kp_by_fall = 0.0, kd_by_fall = 0.0;
  };
  Gains gains(const Instant& now) const;

  bool same_as(const ForceElement& other) const override;
  int state_size() const override { return kStates; }
  int scratch_size() const override { return kScratch; }
  void start(const Instant& now, Memory m) const override;
  void begin_step(const Instant& before, double h, Memory m) const override;
  void add_forces(const Instant& now, double h, Memory m, ForceSum& out) const override;
  void add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const override;
  void end_step(const Instant& now, double h, Memory m) const override;
  bool add_history_tangent(const Instant& before, const Instant& now, double h, Memory m, const BodyChange& from,
                           const Eigen::Ref<const MatrixX>& state, Eigen::Ref<MatrixX> dQ) const override;
  bool advance_state_tangent(const Instant& before, const Instant& now, double h, Memory m, const BodyChange& from,
                             const BodyChange& to, Eigen::Ref<MatrixX> state) const override;
  double potential_energy(const Instant& now, Memory m) const override;
  double dissipated_power(const Instant& now, Memory m) const override;
  std::vector<Channel> channels() const override;
  void measure(const Instant& now, Memory m, std::span<double> out) const override;

 private:
  // State: line paid out (m), mean speed of it and of the slipping brake over the last step (m/s), saturated (0 or 1).
  enum { kPaidOut, kLineSpeed, kSlipSpeed, kSaturated, kStates };
  // Scratch, from the beginning of the step: line length (m), command (N).
  enum { kLength, kCommand, kScratch };

  struct Command {
    double value = 0.0, by_angle = 0.0, by_rate = 0.0, by_fall = 0.0;  // N, N/rad, N s/rad, N/m
    bool limited = false;
  };
  struct Pull {
    double tension = 0.0, by_length = 0.0, by_command = 0.0;    // N, N/m, 1
    double paid_out = 0.0, line_speed = 0.0, slip_speed = 0.0;  // m, m/s, m/s
    bool limited = false;
    // By what the step began with: line length and line paid out (N/m), command (1).
    double by_length_before = 0.0, by_paid_before = 0.0, by_command_before = 0.0;
    bool held = false;  // the winch is at its speed limit: the line paid out does not follow the tension
  };
  bool active(const Instant& now) const { return options_.active && now.phase >= options_.active_from_phase; }
  Command command(const Instant& now) const;
  /// How the length of the hoist wire changes with the bodies of its lower and upper end.
  std::array<std::pair<int, Eigen::Matrix<double, 1, 6>>, 2> fall_gradient(const Instant& now) const;
  /// Change of the line's length and of the command, a column each direction; `c` belongs to the instant.
  void add_changes(const Instant& at, const Command& c, const BodyChange& bodies, Eigen::RowVectorXd& length,
                   Eigen::RowVectorXd& command) const;
  Command steady_command(const Instant& now) const;
  Pull pull(double length, double command, double h, Memory m, Branches* branches = nullptr) const;
  double held_tension(const Instant& now, Memory m) const;

  TaglineOptions options_;
  PlaneAngle angle_;
  double k_ = 0.0;  // N/m
};

}  // namespace stillhook
