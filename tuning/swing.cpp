#include "tuning/swing.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>

#include "sim/lifting/line.h"
#include "sim/lifting/tagline.h"
#include "sim/lifting/wire.h"
#include "sim/modes.h"
#include "sim/multibody/hht_tangent.h"
#include "sim/simulate.h"
#include "sim/spatial/constants.h"
#include "sim/statics.h"

namespace stillhook {
namespace {

constexpr double kCalm = -1.0;  // s, before the waves start
constexpr double kPullShare = 0.5;  // of a cycle in which a line that only pulls acts

Specification without_taglines(Specification specification) {
  for (TaglineSpec& line : specification.taglines) line.active = false;
  return specification;
}

Specification in_calm_water(Specification specification) {
  SeaStateSpec calm;
  calm.name = "calm";
  specification.sea.states.push_back(calm);
  specification.sea.active = calm.name;
  return specification;
}

/// Takes a model from one static pose to the next, in steps that an equilibrium can follow.
class PoseWalk {
 public:
  explicit PoseWalk(const Model& model) : model_(model), state_(model.initial_state()) {}

  const SystemState& go_to(const StaticPose& pose, int phase) {
    constexpr double kStep = 2.0;  // m or rad of any drive
    const std::vector<DriveState> from = state_.drive;
    double way = 0.0;
    for (std::size_t d = 0; d < from.size(); ++d) way = std::max(way, std::abs(pose.drives[d] - from[d].position));
    const int steps = std::max(1, static_cast<int>(std::ceil(way / kStep)));
    state_.phase = phase;
    for (int k = 1; k <= steps; ++k) {
      for (std::size_t d = 0; d < from.size(); ++d)
        state_.drive[d] = {from[d].position + (pose.drives[d] - from[d].position) * k / steps, 0.0};
      solve_static(model_, state_, {}, "poses." + pose.name);
    }
    return state_;
  }

 private:
  const Model& model_;
  SystemState state_;
};

/// Stiffness and damping of the taglines' linear equivalent, added to K = dQ/dxi and C = dQ/du.
void add_taglines(const Model& with_lines, const SystemState& state, JacobianSum& out) {
  const Instant now = state.instant();
  for (const auto& element : with_lines.system().elements) {
    const auto* line = dynamic_cast<const Tagline*>(element.get());
    if (!line || !line->options().active || state.phase < line->options().active_from_phase) continue;
    const TaglineOptions& o = line->options();
    const LineMotion at = line_motion(o.to, o.from, now);
    const Tagline::Gains gains = line->gains(now);
    for (const PlaneAngle::Gradient& g : line->angle().gradient(now)) {
      const Eigen::Matrix<double, 3, 6> A = -kPullShare * at.e * (gains.kp * g.angle_xi + gains.kd * g.rate_xi);
      const Eigen::Matrix<double, 3, 6> B = -kPullShare * at.e * (gains.kd * g.rate_u);
      add_force_jacobian(o.to, now, Vector3::Zero(), g.body, A, B, false, out);
      add_force_jacobian(o.from, now, Vector3::Zero(), g.body, -A, -B, false, out);
    }
  }
}

/// Damping ratio of the eigenvector that looks most like `shape`: frequencies may coincide (a pendulum's two do).
double damping_of(const MatrixX& M, const MatrixX& C, const MatrixX& K, const VectorX& shape) {
  const Eigen::Index n = M.rows();
  const auto solver = M.ldlt();
  MatrixX A = MatrixX::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n) = solver.solve(K);  // K and C are derivatives of the force: negative for a spring
  A.bottomRightCorner(n, n) = solver.solve(C);
  const Eigen::EigenSolver<MatrixX> eigen(A);
  const VectorX weighted = M * shape;
  double best = 0.0, ratio = kNaN;
  for (Eigen::Index i = 0; i < 2 * n; ++i) {
    const std::complex<double> s = eigen.eigenvalues()[i];
    if (!(s.imag() > 0.0)) continue;
    const Eigen::VectorXcd q = eigen.eigenvectors().col(i).head(n);
    const double size = std::real(q.dot(M * q));
    const double alike = size > 0.0 ? std::norm(weighted.cast<std::complex<double>>().dot(q)) / size : 0.0;
    if (alike <= best) continue;
    best = alike;
    ratio = -s.real() / std::abs(s);
  }
  return ratio;
}

class HangingPose {
 public:
  /// `at_free`, `at_lines`: the equilibria of the two models there.
  HangingPose(const Model& free, const Model& lines, const std::string& name, const SystemState& at_free,
              const SystemState& at_lines)
      : free_(free), lines_(lines), name_(name), analysis_(free), state_(at_free), state_lines_(at_lines) {
    modes_ = analysis_.at(state_);
    SystemState calm = state_;
    calm.t = kCalm;
    SystemWorkspace work = free.system().make_workspace();
    VectorX Q;
    free.system().forces(calm, 0.0, work, Q);
    free.system().jacobian(calm, 0.0, work);
    K_ = work.jacobian.stiffness();
    C_ = work.jacobian.damping();
    JacobianSum sum(static_cast<int>(calm.body.size()));
    add_taglines(lines, calm, sum);
    K_lines_ = K_ + sum.stiffness();
    C_lines_ = C_ + sum.damping();
    MatrixX C_q;
    free.system().constraint_jacobian(calm, C_q);
    Z_ = MatrixX::Identity(K_.rows(), K_.rows());
    if (C_q.rows() > 0)
      Z_ = MatrixX(Eigen::HouseholderQR<MatrixX>(C_q.transpose()).householderQ()).rightCols(K_.rows() - C_q.rows());
  }

  SwingMode swing(int load, int axis, const SwingOptions& options) const {
    const Mode& mode = *std::max_element(modes_.begin(), modes_.end(), [&](const Mode& a, const Mode& b) {
      return a.share[6 * load + axis] < b.share[6 * load + axis];
    });
    SwingMode s;
    s.pose = name_;
    s.direction = axis == 0 ? "fore-aft" : "athwart";
    s.label = mode.label;
    s.period = mode.period;
    const MatrixX M = Z_.transpose() * analysis_.mass_at(mode.frequency) * Z_;
    const auto ratio = [&](const MatrixX& C, const MatrixX& K) {
      return damping_of(M, Z_.transpose() * C * Z_, Z_.transpose() * K * Z_, Z_.transpose() * mode.shape);
    };
    s.linear_free = ratio(C_, K_);
    s.linear_lines = ratio(C_lines_, K_lines_);
    s.decay_free = s.decay_lines = kNaN;
    if (!options.simulate) return s;
    s.decay_free = decay(free_, state_, mode, axis, options);
    s.decay_lines = decay(lines_, state_lines_, mode, axis, options);
    return s;
  }

 private:
  /// An operation that brings every drive where it stands at once, in the first phase, and then waits in this phase.
  Operation waiting(const Model& model, double time) const {
    Operation operation;
    const auto& phases = model.specification().operation.phases;
    for (int i = 0; i <= state_.phase; ++i) {
      Phase phase;
      phase.name = phases[static_cast<std::size_t>(i)].name;
      phase.stage = phases[static_cast<std::size_t>(i)].stage;
      phase.duration = i == state_.phase ? time : 0.0;
      if (i == 0) phase.moves = jumps_to(state_.drive);
      operation.phases.push_back(phase);
    }
    return operation;
  }

  double decay(const Model& model, SystemState state, const Mode& mode, int axis, const SwingOptions& options) const {
    // The displaced load is let go a moment after the drives' jump.
    state.t = 0.0;
    double length = 0.0;
    for (const WireSpec& w : model.specification().wires) {
      if (w.role != WireSpec::Role::hoist) continue;
      const auto values = channel_values(model, state);
      length = std::max(length, values.at(wire_channels::length.of(w)));
    }
    BodyChange shape{mode.shape, VectorX::Zero(mode.shape.size())};
    displace_bodies(shape, 0, options.amplitude * length, state.body);
    SystemWorkspace work = model.system().make_workspace();
    model.system().start_elements(state, work);
    RunOptions run_with;
    run_with.from = &state;
    const double time = (options.swings + 1.5) * mode.period;
    const Trajectory run = simulate(model, waiting(model, time), run_with);
    // A load that touches on its way, low over its target, has no decay to measure.
    if (run.status != RunStatus::completed || !run.contacts.empty()) return kNaN;
    return decrement(model, run, axis, mode.period, options.swings);
  }

  /// Of the mean offset of the hoist wires in the crane vessel's heading, from the release on.
  static double decrement(const Model& model, const Trajectory& run, int axis, double period, int swings) {
    std::vector<double> offset(run.time.size(), 0.0);
    int wires = 0;
    for (const WireSpec& w : model.specification().wires) {
      if (w.role != WireSpec::Role::hoist) continue;
      const int c = run.find((axis == 0 ? wire_channels::offset_x : wire_channels::offset_y).of(w));
      for (std::size_t i = 0; i < offset.size(); ++i) offset[i] += run.values[static_cast<std::size_t>(c)][i];
      ++wires;
    }
    if (wires == 0) return kNaN;
    // The range over each period, which neither a shifted middle nor the ripple of the wires disturbs.
    const auto range = [&](int k) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (std::size_t i = 0; i < offset.size(); ++i) {
        if (run.time[i] < k * period || run.time[i] >= (k + 1) * period) continue;
        low = std::min(low, offset[i]);
        high = std::max(high, offset[i]);
      }
      return high - low;
    };
    const double first = range(0), last = range(swings - 1);
    if (!(last > 0.0) || !(first > 0.0)) return kNaN;
    const double d = std::log(first / last) / (2.0 * std::numbers::pi * (swings - 1));
    return d / std::sqrt(1.0 + d * d);
  }

  const Model& free_;
  const Model& lines_;
  std::string name_;
  ModalAnalysis analysis_;
  SystemState state_, state_lines_;
  std::vector<Mode> modes_;
  MatrixX K_, C_, K_lines_, C_lines_, Z_;
};

}  // namespace

std::vector<SwingMode> swing_modes(const Specification& specification, const SwingOptions& options) {
  const Specification calm = in_calm_water(specification);
  const Model lines = build_model(calm), free = build_model(without_taglines(calm));
  const Operation operation = build_operation(lines);
  const int load = lines.body_index(specification.operation.load);
  std::vector<SwingMode> modes;
  PoseWalk walk_free(free), walk_lines(lines);
  for (std::size_t p = 0; p < operation.phases.size(); ++p) {
    const StaticPose& pose = operation.static_poses[p + 1];
    const SystemState at_free = walk_free.go_to(pose, static_cast<int>(p));
    const SystemState at_lines = walk_lines.go_to(pose, static_cast<int>(p));
    if (operation.phases[p].stage != PhaseSpec::Stage::hanging) continue;
    if (options.phase >= 0 && static_cast<int>(p) != options.phase) continue;
    const auto& elements = lines.system().elements;
    const bool connected = std::any_of(elements.begin(), elements.end(), [&](const auto& e) {
      const auto* line = dynamic_cast<const Tagline*>(e.get());
      return line && line->options().active && static_cast<int>(p) >= line->options().active_from_phase;
    });
    if (!connected) continue;
    const HangingPose there(free, lines, pose.name, at_free, at_lines);
    for (const int axis : {0, 1}) modes.push_back(there.swing(load, axis, options));
  }
  return modes;
}

}  // namespace stillhook
