// Mooring lines, quasi-static: the paper's Eq. 11 (Cha, Nam & Ha 2018; Faltinsen 1990, ch. 8) with the vertical force.
//
//   force on the fairlead  F = (H u, -V)        u  horizontal unit vector from the fairlead to the anchor
//
// catenary: H(x, z) and V(x, z) from catenary.h, x and z the fairlead's horizontal and vertical distance from the
//   anchor. That is where the options say, and then the line's length gives its tension; or on the seabed where the
//   initial pose gives the wanted horizontal tension. On the seabed the line may lie beside its anchor; from an anchor
//   above it the line hangs free, and it is refused when it would then reach the bottom in the initial pose. A buoyant
//   line (weight < 0) rises from its anchor and is refused when it would float at the surface there.
// linear:   H = max(0, H0 + k (x - x0)), V = 0: never pushes. x0 is the distance of the anchor in the initial pose.
// The anchor may be moved along a fixed direction by a drive (a tug, or a line that is shifted); the drive then gives
// the power F . v_anchor. No damping; the energy is the catenary's (without friction) or H^2/(2 k).
// Within 1e-6 of the length (linear: of x0) of the anchor's vertical H falls linearly to zero, so that its direction
// does not jump.
#pragma once

#include <array>
#include <optional>

#include "sim/channel_kind.h"
#include "sim/lifting/catenary.h"
#include "sim/multibody/point.h"

namespace stillhook {

struct MooringSpec;

/// What is recorded of every entry, in the order in which measure() writes it.
namespace mooring_channels {
inline constexpr ChannelKind<MooringSpec> tension{"tension", "N", "tension at the fairlead"};
inline constexpr ChannelKind<MooringSpec> horizontal_tension{"horizontal_tension", "N", "its horizontal part"};
inline constexpr std::array all = {tension, horizontal_tension};
}  // namespace mooring_channels

struct MooringOptions {
  enum class Type { catenary, linear };
  std::string name;
  Type type = Type::catenary;
  BodyPoint fairlead;
  std::optional<Vector3> anchor;             // m, in W; absent: from azimuth with pretension or anchor_distance
  double azimuth = 0.0;                      // rad, from the fairlead to the anchor at the initial pose, in W from +x
  double pretension = 0.0;                   // N, horizontal, at the initial pose; catenary > 0 without an anchor and
                                             // 0 with one, linear >= 0
  CatenaryLine line;                         // catenary
  double depth = 0.0;                        // m, catenary: water depth, > 0
  double stiffness = 0.0;                    // N/m, linear: k > 0
  double anchor_distance = 0.0;              // m, linear without an anchor: x0 > 0
  int tow_drive = -1;                        // index of the drive that moves the anchor, m; -1 = fixed
  Vector3 tow_direction = Vector3::UnitX();  // unit vector in W

  bool operator==(const MooringOptions&) const = default;
};

class Mooring final : public ForceElement {
 public:
  /// `initial` is the pose in which the line has its pretension, with drives as they stand there. Throws
  /// SpecificationError when an option breaks its inequality or the fairlead is not above the seabed.
  Mooring(MooringOptions options, const Instant& initial);

  const MooringOptions& options() const { return options_; }
  /// Where the anchor lies at drive position zero, in W.
  const Vector3& anchor() const { return anchor_; }

  std::span<const int> drives() const override { return drive_or_none(options_.tow_drive); }
  bool same_as(const ForceElement& other) const override;
  /// Where Newton's method starts does not matter to where it ends.
  bool has_history() const override { return false; }
  bool advance_state_tangent(const Instant&, const Instant&, double, Memory, const BodyChange&, const BodyChange&,
                             Eigen::Ref<MatrixX> state) const override {
    state.setZero();
    return true;
  }
  int state_size() const override { return 2; }  // H, V at the last converged instant, N: where Newton starts
  void start(const Instant& now, Memory m) const override;
  void add_forces(const Instant& now, double h, Memory m, ForceSum& out) const override;
  void add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const override;
  void end_step(const Instant& now, double h, Memory m) const override;
  double potential_energy(const Instant& now, Memory m) const override;
  std::vector<Channel> channels() const override;
  void measure(const Instant& now, Memory m, std::span<double> out) const override;

 private:
  struct Load {
    double H = 0.0, V = 0.0;                            // N
    double H_x = 0.0, H_z = 0.0, V_x = 0.0, V_z = 0.0;  // N/m
    double H_over_x = 0.0;                              // N/m, finite at x = 0
    Vector3 u = Vector3::Zero();                        // horizontal, from the fairlead to the anchor
    double energy = 0.0;                                // J
    Vector3 force() const { return H * u - V * Vector3::UnitZ(); }
  };
  template <class Require>
  void place_catenary(const Vector3& fairlead, const Require& require);
  template <class Require>
  void place_linear(const Vector3& fairlead, const Require& require);
  BodyPoint anchor_now(const Instant& now) const;
  Load load(const Instant& now, Memory m) const;
  Load catenary_load(double x, double z, Memory m) const;
  Load linear_load(double x, const Instant& now) const;

  MooringOptions options_;
  Vector3 anchor_ = Vector3::Zero();  // m, in W
};

}  // namespace stillhook
