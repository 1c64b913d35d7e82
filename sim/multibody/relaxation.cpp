#include "sim/multibody/relaxation.h"

#include <algorithm>
#include <cmath>

#include "sim/multibody/stability.h"

namespace stillhook {
namespace {

constexpr int kMaxMotions = 4000;       // of up to 3 m: a lift of 3,000 m of wire and more
constexpr double kAtRest = 1e-7;        // out of balance over the largest weight: Newton's method takes over
constexpr double kOpenJoint = 0.02;     // m or rad that a step may open a joint by
constexpr double kSlowestCreep = 1e-6;  // 1/s2
constexpr double kStiffest = 1e10;      // 1/s2: above that of a short steel sling on a hook block
constexpr double kKickLength = 0.05;    // m or rad, off an unstable equilibrium
constexpr int kKicks = 8;               // equilibria that may prove unstable one after the other
constexpr double kOutOfSight = 1.0e4;   // m that a body may move

class Relaxation {
 public:
  Relaxation(const MultibodySystem& system, SystemState& state)
      : system_(system),
        state_(state),
        work_(system.make_workspace()),
        n_(system.coordinates()),
        m_(system.constraints()),
        lambda_scale_(system.mass().trace() / std::max(1, n_)),
        measure_(system) {
    for (BodyKinematics& b : state.body) b.v_WC = b.w_B = Vector3::Zero();
    for (DriveState& d : state.drive) d.rate = 0.0;
    state.acceleration = VectorX::Zero(n_);
    if (state.lambda.size() != m_) state.lambda = VectorX::Zero(m_);
    if (static_cast<int>(state.element_state.size()) != system.element_state_size())
      system.start_elements(state, work_);
  }

  EquilibriumReport run() {
    EquilibriumReport report;
    const std::vector<BodyKinematics> begin = state_.body;
    close_joints();
    for (report.iterations = 0; report.iterations < kMaxMotions; ++report.iterations) {
      if (!find_step()) break;
      report.residual = measure_.out_of_balance(Q_, C_q_, lambda_, report.worst_body);
      const bool closed = m_ == 0 || C_.cwiseAbs().maxCoeff() < 1e-6;
      if (report.residual < kAtRest && closed) {
        state_.lambda = lambda_;
        report.converged = true;
        return report;
      }
      go_or_shorten();
      if (shift_ > kStiffest || lost(begin)) break;
    }
    if (xi_.size() > 0 && xi_.allFinite()) {
      report.motion = describe_motion(system_, xi_);
      report.worst_body = mover(system_, xi_);
    }
    return report;
  }

 private:
  bool lost(const std::vector<BodyKinematics>& begin) const {
    for (std::size_t i = 0; i < begin.size(); ++i)
      if (!((state_.body[i].p_WC - begin[i].p_WC).norm() < kOutOfSight)) return true;
    return false;
  }

  void close_joints() {
    std::string joint;
    assemble_joints(system_, state_, joint);
  }

  // The motion xi_ over one step, and the reactions lambda_ along it.
  bool find_step() {
    system_.forces(state_, 0.0, work_, Q_);
    system_.constraint_jacobian(state_, C_q_);
    system_.constraint_values(state_, C_);
    system_.jacobian(state_, 0.0, work_);
    MatrixX A(n_ + m_, n_ + m_);
    VectorX b(n_ + m_);
    A.topLeftCorner(n_, n_) = shift_ * system_.mass() - work_.jacobian.stiffness();
    A.topRightCorner(n_, m_) = lambda_scale_ * C_q_.transpose();
    A.bottomLeftCorner(m_, n_) = lambda_scale_ * C_q_;
    A.bottomRightCorner(m_, m_).setZero();
    b << Q_, -lambda_scale_ * C_;
    const VectorX x = A.partialPivLu().solve(b);
    if (!x.allFinite()) return false;
    xi_ = x.head(n_);
    lambda_ = lambda_scale_ * x.tail(m_);
    return true;
  }

  void go_or_shorten() {
    const double power = (Q_ - C_q_.transpose() * lambda_).dot(xi_);
    if (!(power >= 0.0)) {
      shift_ *= 6.0;  // uphill: the stiffness is negative and outweighs the shift
      return;
    }
    const double factor = limit_motion(xi_);
    const SystemState before = state_;
    move_bodies(state_, xi_);
    VectorX Q, C;
    MatrixX C_q;
    system_.forces(state_, 0.0, work_, Q);
    system_.constraint_jacobian(state_, C_q);
    system_.constraint_values(state_, C);
    const double after = (Q - C_q.transpose() * lambda_).dot(xi_) / (factor * power);
    const double gap = m_ > 0 ? C.cwiseAbs().maxCoeff() : 0.0;
    if (!(after > -0.5) || gap > kOpenJoint) {
      state_ = before;
      shift_ *= 4.0;
      return;
    }
    // The reactions are those of the state that the step began in: with them the next stiffness is its own.
    state_.lambda = lambda_;
    shift_ = std::clamp(shift_ * (after > 0.5 ? 0.3 : after > 0.0 ? 0.6 : 1.5), kSlowestCreep, kStiffest);
  }

  const MultibodySystem& system_;
  SystemState& state_;
  SystemWorkspace work_;
  int n_, m_;
  double lambda_scale_;
  BalanceMeasure measure_;
  double shift_ = 1.0;
  VectorX Q_, C_, xi_, lambda_;
  MatrixX C_q_;
};

}  // namespace

EquilibriumReport relax(const MultibodySystem& system, SystemState& state) {
  EquilibriumReport report = Relaxation(system, state).run();
  if (!report.converged) return report;
  const int motions = report.iterations;
  report = solve_equilibrium(system, state, true);
  report.iterations += motions;
  return report;
}

EquilibriumReport settle_stably(const MultibodySystem& system, SystemState& state, bool close) {
  const SystemState begin = state;
  EquilibriumReport report;
  for (int attempt = close ? 0 : 1; attempt < 2; ++attempt) {
    report = solve_equilibrium(system, state, attempt == 0);
    if (report.converged && weakest_motion(system, state).stable()) return report;
    state = begin;
  }
  for (int kick = 0; kick < kKicks; ++kick) {
    report = relax(system, state);
    if (!report.converged) return report;
    const WeakestMotion weakest = weakest_motion(system, state);
    if (weakest.stable()) return report;
    report.motion = describe_motion(system, weakest.motion);
    report.worst_body = mover(system, weakest.motion);
    move_bodies(state, kKickLength * weakest.motion);
  }
  report.converged = false;
  return report;
}

}  // namespace stillhook
