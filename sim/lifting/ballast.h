// Ballast transfer: a weight that moves from one tank of a body to another.
//
//   force at `from` +m s g (up), at `to` -m s g (down)      m mass (kg), g gravity (m/s2), s drive position (0 .. 1)
//
// What the body weighs stays the same; only the moment changes. The inertia of the water stays where it was. Energy
// E = m s g (z_to - z_from); the pump gives m sdot g (z_to - z_from).
#pragma once

#include <array>

#include "sim/channel_kind.h"
#include "sim/multibody/point.h"

namespace stillhook {

struct BallastSpec;

/// What is recorded of every entry, in the order in which measure() writes it.
namespace ballast_channels {
inline constexpr ChannelKind<BallastSpec> moved{"moved", "N", "weight moved"};
inline constexpr std::array all = {moved};
}  // namespace ballast_channels

struct BallastOptions {
  std::string name;
  BodyPoint from, to;        // the tanks, on one body
  double mass = 0.0;         // kg, moved at drive position 1, >= 0
  double gravity = 9.80665;  // m/s2
  int drive = -1;            // index of the drive, >= 0

  bool operator==(const BallastOptions&) const = default;
};

class Ballast final : public ForceElement {
 public:
  /// Throws SpecificationError when an option breaks its inequality.
  explicit Ballast(BallastOptions options);

  std::span<const int> drives() const override { return drive_or_none(options_.drive); }
  bool same_as(const ForceElement& other) const override;
  void add_forces(const Instant& now, double h, Memory m, ForceSum& out) const override;
  void add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const override;
  double potential_energy(const Instant& now, Memory m) const override;
  std::vector<Channel> channels() const override;
  void measure(const Instant& now, Memory m, std::span<double> out) const override;

 private:
  double weight_moved(const Instant& now) const;  // N

  BallastOptions options_;
};

}  // namespace stillhook
