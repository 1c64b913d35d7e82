// Wires: hoist, luffing and stay wires, slings. A unilateral spring-damper whose unstretched length a winch changes.
//
//   T = max(0, EA/L (l - L) + c s (ldot - Ldot))   for l > L, else 0         L = L0 - drive position
//
//   l, ldot  distance of the ends (m) and its rate (m/s)       L, Ldot  unstretched length and its rate
//   EA       axial stiffness, N                                c        damping, N s/m, constant
//   s        grows from 0 to 1 over a small strain, see unilateral.h: no jump of tension when the slack ends
//
// A wire never pushes. Its energy is E = 1/2 EA/L (l - L)^2, its heat (T - EA/L (l - L)) (ldot - Ldot); the winch
// gives it the power -(T + E/L) Ldot (the second term is the strain energy that goes onto the drum). Massless, as in
// Cha, Nam & Ha (2018), section 5.2. A damping ratio zeta of a mass m on the wire means c = 2 zeta sqrt(EA/L0 m).
#pragma once

#include <array>

#include "sim/channel_kind.h"
#include "sim/lifting/unilateral.h"
#include "sim/multibody/point.h"

namespace stillhook {

class ElementSite;
struct WireSpec;

/// What is recorded of every entry, in the order in which measure() writes it.
namespace wire_channels {
inline constexpr ChannelKind<WireSpec> tension{"tension", "N", "tension"};
inline constexpr ChannelKind<WireSpec> length{"length", "m", "stretched length: distance of the ends"};
inline constexpr ChannelKind<WireSpec> unstretched{"unstretched", "m", "unstretched length"};
inline constexpr ChannelKind<WireSpec> rate{"rate", "m/s", "rate of the unstretched length, positive paying out"};
inline constexpr ChannelKind<WireSpec> offset_x{"offset_x", "m",
                                                "lower end forward of the upper end, in the crane's heading"};
inline constexpr ChannelKind<WireSpec> offset_y{"offset_y", "m",
                                                "lower end to port of the upper end, in the crane's heading"};
inline constexpr ChannelKind<WireSpec> off_lead{"off_lead", "rad",
                                                "angle from the vertical in the boom's plane, positive outwards"};
inline constexpr ChannelKind<WireSpec> side_lead{"side_lead", "rad",
                                                 "angle from the vertical out of the boom's plane, positive to port"};
inline constexpr std::array all = {tension, length, unstretched, rate, offset_x, offset_y, off_lead, side_lead};
}  // namespace wire_channels

struct WireOptions {
  std::string name;
  BodyPoint from, to;                       // "from" is the upper end or the sheave
  double axial_stiffness = 0.0;             // N, > 0
  double unstretched_length = 0.0;          // m, at drive position zero, > 0
  double damping = 0.0;                     // N s/m, >= 0
  double damping_strain = 1e-4;             // 1, strain over which the damping grows to its full value, > 0
  int drive = -1;                           // index of the winch, m hauled in; -1 = fixed length
  int crane = kWorld;                       // body whose heading gives fore-aft and athwart for the offsets
  int boom = kWorld;                        // body in and out of whose plane the leads are; kWorld = as the offsets
  Vector3 boom_athwart = Vector3::UnitY();  // normal of that plane, to port, in the boom's axes

  bool operator==(const WireOptions&) const = default;
};

/// Distance of the ends of a wire at the initial pose, m.
double end_distance(const WireSpec& wire, const ElementSite& site);

/// c = 2 zeta sqrt(EA/L0 m), N s/m.
double wire_damping(double damping_ratio, double mass, double axial_stiffness, double unstretched_length);

/// The tension law, N, for a scalar type T (double or a dual number).
template <typename T>
T wire_tension(const T& l, const T& l_rate, const T& L, const T& L_rate, const WireOptions& wire,
               Branches* branches = nullptr) {
  return unilateral_force<T>(l - L, l_rate - L_rate, T(wire.axial_stiffness) / L, T(wire.damping),
                             T(wire.damping_strain) * L, branches);
}

class Wire final : public ForceElement {
 public:
  /// Throws SpecificationError when an option breaks its inequality.
  explicit Wire(WireOptions options);

  const WireOptions& options() const { return options_; }
  /// Unstretched length now, m. The winch hauls in until 1 % of the length at the start is left (block on sheave);
  /// there the length stays, whatever the drive says.
  double unstretched_length(const Instant& now) const;
  double tension(const Instant& now) const;  // N

  std::span<const int> drives() const override { return drive_or_none(options_.drive); }
  bool same_as(const ForceElement& other) const override;
  void add_forces(const Instant& now, double h, Memory m, ForceSum& out) const override;
  void add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const override;
  double potential_energy(const Instant& now, Memory m) const override;
  double dissipated_power(const Instant& now, Memory m) const override;
  std::vector<Channel> channels() const override;
  void measure(const Instant& now, Memory m, std::span<double> out) const override;

 private:
  struct Unstretched {
    double length, rate;  // m, m/s
  };
  Unstretched unstretched(const Instant& now) const;
  Matrix3 lead_axes(const Instant& now, const Matrix3& R_WH) const;

  WireOptions options_;
};

}  // namespace stillhook
