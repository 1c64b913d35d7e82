// What every force element offers: forces, their exact derivatives, energy, and channels to record.
//
// The generalised coordinates of body i are the position p_WC of its centre of gravity and its rotation R_WB; the
// generalised velocity is u_i = (v_WC in W, w_B in B). A small change of configuration is xi_i = (dp in W, dtheta
// in B) with R_WB -> R_WB exp(dtheta). The generalised force is Q_i = (force in W, moment about C in B).
// An element gives dQ/dxi (its "stiffness", K) and dQ/du (its "damping", C) with the sign of the force, so a
// spring has a negative K.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sim/multibody/branches.h"
#include "sim/spatial/pose.h"

namespace stillhook {

/// Index of the body "world", which is fixed and has no coordinates.
inline constexpr int kWorld = -1;

/// One body at one instant.
struct BodyKinematics {
  Matrix3 R_WB = Matrix3::Identity();
  Vector3 p_WC = Vector3::Zero();  // m
  Vector3 v_WC = Vector3::Zero();  // m/s
  Vector3 w_B = Vector3::Zero();   // rad/s
};

/// A drive (winch, ballast transfer, tow, joint drive) at one instant.
struct DriveState {
  double position = 0.0;  // m hauled in, rad, or share of the whole transfer; zero at the start of the run
  double rate = 0.0;      // per s
};

/// Everything an element may look at.
struct Instant {
  double t = 0.0;                        // s
  std::span<const BodyKinematics> body;  // by body index
  std::span<const DriveState> drive;     // by drive index
  int phase = 0;                         // index of the operation's phase
  Branches* branches = nullptr;          // of the laws; nullptr: as the conditions are

  /// Where a law has a kink: the condition of this instant, or the one of the branches to follow.
  bool on(bool condition) const { return on_branch(branches, condition); }
};

/// The drives of an element that has one or, where the index is -1, none. The index must live as long as the span.
inline std::span<const int> drive_or_none(const int& index) {
  return {&index, static_cast<std::size_t>(index >= 0 ? 1 : 0)};
}

/// What an element keeps between steps (state, part of State and copied with it) and may scribble on (scratch).
struct Memory {
  std::span<double> state;
  std::span<double> scratch;
};

/// Sum of generalised forces, 6 rows a body: force in W (N), moment about C in B (N m).
class ForceSum {
 public:
  explicit ForceSum(int bodies) : Q_(VectorX::Zero(6 * bodies)) {}
  void clear() { Q_.setZero(); }
  /// Adds force F_W and moment M_B about the centre of gravity; a load on the world is dropped.
  void add(int body, const Vector3& F_W, const Vector3& M_B) {
    if (body == kWorld) return;
    Q_.segment<3>(6 * body) += F_W;
    Q_.segment<3>(6 * body + 3) += M_B;
  }
  const VectorX& value() const { return Q_; }

 private:
  VectorX Q_;
};

/// Sum of derivatives of the generalised forces: K = dQ/dxi and C = dQ/du, each (6 bodies) x (6 bodies).
class JacobianSum {
 public:
  explicit JacobianSum(int bodies)
      : K_(MatrixX::Zero(6 * bodies, 6 * bodies)), C_(MatrixX::Zero(6 * bodies, 6 * bodies)) {}
  void clear() {
    K_.setZero();
    C_.setZero();
  }
  /// Adds the derivative of body i's force with respect to body j; blocks of the world are dropped.
  void add_stiffness(int i, int j, const Matrix6& K) {
    if (i != kWorld && j != kWorld) K_.block<6, 6>(6 * i, 6 * j) += K;
  }
  void add_damping(int i, int j, const Matrix6& C) {
    if (i != kWorld && j != kWorld) C_.block<6, 6>(6 * i, 6 * j) += C;
  }
  const MatrixX& stiffness() const { return K_; }
  const MatrixX& damping() const { return C_; }

 private:
  MatrixX K_, C_;
};

/// Changes of the bodies at one instant in several directions at once, a column each.
struct BodyChange {
  MatrixX xi;  // 6 rows a body: (dp in W, dtheta in B)
  MatrixX u;   // 6 rows a body: change of (v_WC, w_B)
};

/// A recorded quantity.
struct Channel {
  std::string name;  // "<element>.<quantity>", e.g. "hoist_port.tension"
  std::string unit;  // SI: "N", "m", "rad", "m/s", "1"
  std::string description;
  /// True for what costs as much to measure as a step and changes no faster than the samples follow: it is measured with
  /// the samples alone, and its extremes are those of the samples. The element then has no other channels.
  bool samples_only = false;
};

/// A force element adds, never sets, and accounts for its energy. It is immutable after construction; what changes
/// lives in Memory, so one element serves any number of simulations at once. Where its law has a kink or a jump it asks
/// Instant::on which side to take, in add_forces, end_step and measure.
///
/// A step from t_n to t_n + h calls begin_step once, add_forces (and now and then add_jacobian) for each iterate of
/// Newton's method, and end_step once when the step has converged. Statics call start() once and then add_forces and
/// add_jacobian with h = 0 at any pose: the element then gives the force it would settle to with everything at rest
/// (a winch its commanded tension; friction holds from where start() found the contact).
class ForceElement {
 public:
  explicit ForceElement(std::string name) : name_(std::move(name)) {}
  virtual ~ForceElement() = default;
  ForceElement(const ForceElement&) = delete;
  ForceElement& operator=(const ForceElement&) = delete;

  const std::string& name() const { return name_; }
  virtual int state_size() const { return 0; }
  virtual int scratch_size() const { return 0; }
  /// Indices of the drives whose positions and rates the forces depend on.
  virtual std::span<const int> drives() const { return {}; }
  /// True if the other element gives the same forces in every state: same kind, same parameters. False is always safe.
  virtual bool same_as(const ForceElement&) const { return false; }

  /// Sets the internal state to its steady value at this instant (bodies at rest).
  virtual void start(const Instant&, Memory) const {}
  /// The same at the end of statics that began with start(): what holds by friction keeps its grip.
  virtual void settle(const Instant& now, Memory m) const { start(now, m); }
  /// Called once before the iterations of a step of length h (s); `before` is the converged instant t_n.
  virtual void begin_step(const Instant& /*before*/, double /*h*/, Memory) const {}
  /// Adds the forces at `now` = t_n + h. Must not change m.state.
  virtual void add_forces(const Instant& now, double h, Memory m, ForceSum& out) const = 0;
  /// Adds the derivatives of what add_forces adds, internal states eliminated.
  virtual void add_jacobian(const Instant& now, double h, Memory m, JacobianSum& out) const = 0;
  /// Advances the internal state to `now`.
  virtual void end_step(const Instant& /*now*/, double /*h*/, Memory) const {}

  /// True if the forces of a step depend on its beginning: on the state or on the instant before.
  virtual bool has_history() const { return state_size() > 0; }
  /// Adds to dQ (6 rows a body, a column a direction) what the force at `now` changes when the beginning of the step
  /// does: the bodies by `from`, the state by `state` (rows as in m.state). m.state belongs to `before`, m.scratch is
  /// what begin_step left. Returns false if the element does not offer it; the caller then takes differences.
  virtual bool add_history_tangent(const Instant& /*before*/, const Instant& /*now*/, double /*h*/, Memory,
                                   const BodyChange& /*from*/, const Eigen::Ref<const MatrixX>& /*state*/,
                                   Eigen::Ref<MatrixX> /*dQ*/) const {
    return false;
  }
  /// Replaces the change of the state at `before` by that at `now`, with the bodies changed by `from` and `to`. Memory
  /// and return value as above.
  virtual bool advance_state_tangent(const Instant& /*before*/, const Instant& /*now*/, double /*h*/, Memory,
                                     const BodyChange& /*from*/, const BodyChange& /*to*/,
                                     Eigen::Ref<MatrixX> /*state*/) const {
    return false;
  }

  /// Added mass (kg, kg m, kg m^2) in the coordinates above, constant within a phase: M_total = M_rigid + this. Zero by
  /// default.
  virtual void add_mass(MatrixX& /*M*/, int /*phase*/) const {}
  /// Phases with whose start the added mass becomes another.
  virtual std::vector<int> mass_changes() const { return {}; }

  /// Energy stored, J.
  virtual double potential_energy(const Instant&, Memory) const { return 0.0; }
  /// Power turned into heat, W, never negative.
  virtual double dissipated_power(const Instant&, Memory) const { return 0.0; }

  virtual std::vector<Channel> channels() const { return {}; }
  /// Writes one value per channel; m.state belongs to this instant.
  virtual void measure(const Instant&, Memory, std::span<double> /*out*/) const {}

 private:
  std::string name_;
};

}  // namespace stillhook
