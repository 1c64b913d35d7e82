#include "sim/multibody/hht.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/spatial/constants.h"

namespace stillhook {

namespace {
// A kept factorisation serves while each iteration shrinks the correction at least this much.
constexpr double kSlowRate = 0.25;
/// By which a rate grows with every step that stops after one correction.
constexpr double kAgeing = 1.5;
// Taken as the rate of a fresh factorisation until it is known.
constexpr double kFreshRate = 0.1;
// The rate of the last step, good as it was, is not taken to be better than this in the next.
constexpr double kTrustedRate = 0.05;
// Share of the largest multiplier that a further iteration may still change any of them. Accelerations converge before
// multipliers do, and what is left of these comes back with the other sign in the next step: not judged, they kept a
// saw-tooth of 400 kN m alive for minutes of a lift of 900 t, 1.6 kN m are left of it so.
constexpr double kMultiplierShare = 1e-5;
// A correction of less than this share of the largest coordinate or acceleration is rounding: it would not get smaller.
constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();
// A correction of this size in one step (m, rad) is no longer motion.
constexpr double kRunaway = 1e3;
// Time to either side over which start() takes the rate of the acceleration, s: short against a stiff wire's period,
// long against rounding (1e-14 m * (100 rad/s)^2 / 1e-5 s = 1e-5 m/s3).
constexpr double kGlance = 1e-5;

// The bodies carried on by dt at constant acceleration, the drives at constant rate.
void carry_on(SystemState& state, double dt) {
  state.t += dt;
  for (DriveState& d : state.drive) d.position += dt * d.rate;
  for (std::size_t i = 0; i < state.body.size(); ++i) {
    BodyKinematics& b = state.body[i];
    const Vector3 a = state.acceleration.segment<3>(6 * i), w_dot = state.acceleration.segment<3>(6 * i + 3);
    b.p_WC += dt * b.v_WC + 0.5 * dt * dt * a;
    b.R_WB = orthonormalised(b.R_WB * exp_rotation(dt * b.w_B + 0.5 * dt * dt * w_dot));
    b.v_WC += dt * a;
    b.w_B += dt * w_dot;
  }
}
}  // namespace

HhtStepper::HhtStepper(const MultibodySystem& system, const HhtOptions& options)
    : system_(system),
      options_(options),
      beta_((1.0 - options.alpha) * (1.0 - options.alpha) / 4.0),
      gamma_(0.5 - options.alpha),
      lambda_scale_(system.mass().trace() / std::max(1, system.coordinates())),
      work_(system.make_workspace()) {
  for (const Joint& joint : system.joints)
    least_lambda_ = std::max(least_lambda_, kStandardGravity * system.bodies[joint.on_child.body].mass);
  const int n = system.coordinates(), m = system.constraints();
  F0_ = F1_ = a0_ = jerk_ = VectorX::Zero(n);
  for (Differences& d : differences_) d = {VectorX::Zero(n), VectorX::Zero(m)};
  C_ = VectorX::Zero(m);
  r_ = delta_ = VectorX::Zero(n + m);
  C_q_ = MatrixX::Zero(m, n);
  J_ = MatrixX::Zero(n + m, n + m);
  turn_.resize(system.bodies.size());
  lu_ = Eigen::PartialPivLU<MatrixX>(n + m);
}

void HhtStepper::solve_motion(SystemState& state, VectorX& acceleration, VectorX& lambda, VectorX& F) {
  const int n = system_.coordinates(), m = system_.constraints();
  VectorX gamma;
  system_.forces(state, 0.0, work_, F);
  system_.constraint_jacobian(state, C_q_);
  system_.constraint_acceleration(state, gamma);
  J_.topLeftCorner(n, n) = system_.mass(state.phase);
  J_.topRightCorner(n, m) = lambda_scale_ * C_q_.transpose();
  J_.bottomLeftCorner(m, n) = lambda_scale_ * C_q_;
  J_.bottomRightCorner(m, m).setZero();
  r_ << F, lambda_scale_ * gamma;
  delta_ = J_.partialPivLu().solve(r_);
  acceleration = delta_.head(n);
  lambda = lambda_scale_ * delta_.tail(m);
  F -= C_q_.transpose() * lambda;
}

void HhtStepper::start(SystemState& state) {
  solve_motion(state, state.acceleration, state.lambda, F0_);
  VectorX before, after, lambda, F;
  for (const double glance : {-kGlance, kGlance}) {
    SystemState near = state;
    carry_on(near, glance);
    solve_motion(near, glance < 0.0 ? before : after, lambda, F);
  }
  jerk_ = (after - before) / (2.0 * kGlance);
  known_differences_ = prediction_order_ = multiplier_order_ = 0;
  last_h_ = 0.0;
  factorised_h_ = 0.0;
  started_ = true;
}

void HhtStepper::predict(const SystemState& from, double h) {
  next_.t = from.t + h;
  next_.phase = from.phase;
  next_.acceleration = a0_;
  next_.lambda = from.lambda;
  if (h != differences_h_) return;
  const auto& [last, before] = differences_;
  if (prediction_order_ >= 1) next_.acceleration += last.acceleration;
  if (prediction_order_ >= 2) next_.acceleration += last.acceleration - before.acceleration;
  if (multiplier_order_ >= 1) next_.lambda += last.lambda;
  if (multiplier_order_ >= 2) next_.lambda += last.lambda - before.lambda;
}

namespace {

/// The order of extrapolation, of those for which there are differences, that would have been off by least: by what the
/// last step changed, by its change from the step before, and so on.
int best_order(const Eigen::Ref<const VectorX>& step, const VectorX& last, const VectorX& before, int known) {
  int best = 0;
  double least = step.cwiseAbs().maxCoeff();
  const auto consider = [&](int order, double error) {
    if (error < least) least = error, best = order;
  };
  if (known >= 1) consider(1, (step - last).cwiseAbs().maxCoeff());
  if (known >= 2) consider(2, (step - 2.0 * last + before).cwiseAbs().maxCoeff());
  return best;
}

}  // namespace

// After a step from `from` to next_: the orders that would have predicted this step best serve for the next.
// Multipliers have one of their own: extrapolated with the accelerations' they would keep what alternates from step to
// step alive.
void HhtStepper::choose_prediction(const SystemState& from, double h) {
  if (h != differences_h_) known_differences_ = 0;
  differences_h_ = h;
  auto& [last, before] = differences_;
  const auto n = from.acceleration.size(), m = from.lambda.size();
  delta_.head(n) = next_.acceleration - from.acceleration;
  delta_.tail(m) = next_.lambda - from.lambda;
  prediction_order_ = best_order(delta_.head(n), last.acceleration, before.acceleration, known_differences_);
  multiplier_order_ = m > 0 ? best_order(delta_.tail(m), last.lambda, before.lambda, known_differences_) : 0;
  std::swap(last, before);
  last.acceleration = delta_.head(n);
  last.lambda = delta_.tail(m);
  known_differences_ = std::min(known_differences_ + 1, 2);
}

void HhtStepper::apply(const SystemState& from, double h) {
  for (std::size_t i = 0; i < from.body.size(); ++i) {
    const BodyKinematics& b0 = from.body[i];
    BodyKinematics& b1 = next_.body[i];
    const Vector6 a0 = a0_.segment<6>(6 * i), a1 = next_.acceleration.segment<6>(6 * i);
    const Vector6 mean = (0.5 - beta_) * a0 + beta_ * a1, speed = (1.0 - gamma_) * a0 + gamma_ * a1;
    b1.p_WC = b0.p_WC + h * b0.v_WC + h * h * mean.head<3>();
    b1.v_WC = b0.v_WC + h * speed.head<3>();
    b1.w_B = b0.w_B + h * speed.tail<3>();
    turn_[i] = h * b0.w_B + h * h * mean.tail<3>();
    b1.R_WB = orthonormalised(b0.R_WB * exp_rotation(turn_[i]));
  }
}

bool HhtStepper::residual(double h) {
  ++residuals_;
  const int n = system_.coordinates(), m = system_.constraints();
  const double al = options_.alpha;
  system_.forces(next_, h, work_, F1_);
  system_.constraint_jacobian(next_, C_q_);
  system_.constraint_values(next_, C_);
  F1_.noalias() -= C_q_.transpose() * next_.lambda;
  r_.head(n) = (al / (1.0 + al)) * F0_ - F1_;
  r_.head(n).noalias() += (1.0 / (1.0 + al)) * (*mass_ * next_.acceleration);
  r_.tail(m) = (lambda_scale_ / (beta_ * h * h)) * C_;
  if (r_.allFinite()) return true;
  for (int i = n - 1; i >= 0; --i)
    if (!std::isfinite(r_[i])) failed_body_ = i / 6;
  return false;
}

void HhtStepper::factorise(double h) {
  ++factorisations_;
  const int n = system_.coordinates(), m = system_.constraints();
  system_.jacobian(next_, h, work_);
  J_.topLeftCorner(n, n) = (1.0 / (1.0 + options_.alpha)) * *mass_ - (gamma_ * h) * work_.jacobian.damping();
  // xi = (dp, dtheta): dp = beta h^2 da, dtheta = J_r(turn) beta h^2 dw'
  for (std::size_t i = 0; i < turn_.size(); ++i) {
    const int c = 6 * static_cast<int>(i);
    const Matrix3 J_r = right_jacobian(turn_[i]), turned = (beta_ * h * h) * J_r;
    J_.block(0, c, n, 3) -= (beta_ * h * h) * work_.jacobian.stiffness().middleCols<3>(c);
    J_.block(0, c + 3, n, 3).noalias() -= work_.jacobian.stiffness().middleCols<3>(c + 3) * turned;
    J_.block(n, c, m, 3) = lambda_scale_ * C_q_.middleCols<3>(c);
    J_.block(n, c + 3, m, 3).noalias() = C_q_.middleCols<3>(c + 3) * Matrix3(lambda_scale_ * J_r);
  }
  J_.topRightCorner(n, m) = lambda_scale_ * C_q_.transpose();
  J_.bottomRightCorner(m, m).setZero();
  lu_.compute(J_);
  factorised_h_ = h;
  rate_ = kFreshRate;
}

bool HhtStepper::multipliers_settled(double left) const {
  if (system_.constraints() == 0) return true;
  const double correction = lambda_scale_ * delta_.tail(system_.constraints()).cwiseAbs().maxCoeff();
  return left * correction <= kMultiplierShare * std::max(next_.lambda.cwiseAbs().maxCoeff(), least_lambda_);
}

bool HhtStepper::iterate(const SystemState& from, double h, Renew renew) {
  const int n = system_.coordinates();
  double last = 0.0;
  for (int k = 0; k < options_.max_iterations; ++k) {
    if (!residual(h)) return false;
    if (renew == Renew::always || (renew == Renew::once && k == 0)) factorise(h);
    delta_ = lu_.solve(r_);
    int worst = 0;
    const double size = delta_.head(n).cwiseAbs().maxCoeff(&worst);  // m/s2, rad/s2
    failed_body_ = worst / 6;
    next_.acceleration -= delta_.head(n);
    next_.lambda -= lambda_scale_ * delta_.tail(system_.constraints());
    apply(from, h);
    if (!std::isfinite(size) || beta_ * h * h * size > kRunaway) return false;
    rate_ = k > 0 ? size / last : std::max(rate_, kTrustedRate);
    if (size < kRounding * (reach_ / (beta_ * h * h) + next_.acceleration.cwiseAbs().maxCoeff())) return true;
    // What is left after this correction is about rate/(1 - rate) times it.
    const double left = rate_ / std::max(1.0 - rate_, 0.1);
    if (size * left <= kStandardGravity * options_.tolerance && multipliers_settled(left)) {
      // A rate that is not measured again becomes less certain as the lift moves away from where it was.
      if (k == 0) rate_ = std::min(kAgeing * rate_, 1.0);
      return true;
    }
    if (renew != Renew::always && k > 0 && rate_ > kSlowRate) return false;
    last = size;
  }
  return false;
}

bool HhtStepper::converge(const SystemState& from, double h) {
  for (const Renew renew : {Renew::never, Renew::once, Renew::always}) {
    if (renew == Renew::never && factorised_h_ != h) continue;
    predict(from, h);
    apply(from, h);
    if (iterate(from, h, renew)) return true;
  }
  return false;
}

// Another added mass from this step on: the forces stay what they were, the acceleration follows them at once.
void HhtStepper::follow_mass(SystemState& state) {
  const MatrixX* mass = &system_.mass(state.phase);
  if (mass == mass_) return;
  if (mass_) {
    state.acceleration = mass->ldlt().solve(*mass_ * state.acceleration).eval();
    jerk_.setZero();
    factorised_h_ = 0.0;
    known_differences_ = prediction_order_ = multiplier_order_ = 0;
  }
  mass_ = mass;
}

bool HhtStepper::step(SystemState& state, double h, std::span<const DriveState> drives) {
  if (!started_) start(state);
  follow_mass(state);
  // `state` is left alone until the step has converged: elements prepare on the copy, which still stands at t_n.
  next_.t = state.t;
  next_.phase = state.phase;
  next_.body = state.body;
  next_.drive = state.drive;
  next_.element_state = state.element_state;
  system_.begin_step(next_, h, work_);
  next_.drive.assign(drives.begin(), drives.end());
  reach_ = 1.0;
  for (const BodyKinematics& b : state.body) reach_ = std::max(reach_, b.p_WC.cwiseAbs().maxCoeff());
  a0_ = state.acceleration + (options_.alpha * (h - last_h_)) * jerk_;
  if (!converge(state, h)) {
    factorised_h_ = 0.0;
    return false;
  }
  failed_body_ = -1;
  // The forces that open the next step, from the equation just solved: this saves an evaluation, and an error in F0
  // dies out by al/(1 + al) a step.
  F0_ *= options_.alpha / (1.0 + options_.alpha);
  F0_.noalias() += (1.0 / (1.0 + options_.alpha)) * (*mass_ * next_.acceleration);
  jerk_ = (next_.acceleration - a0_) / h;
  last_h_ = h;
  choose_prediction(state, h);
  system_.end_step(next_, h, work_);
  std::swap(state.body, next_.body);
  std::swap(state.acceleration, next_.acceleration);
  std::swap(state.lambda, next_.lambda);
  std::swap(state.drive, next_.drive);
  std::swap(state.element_state, next_.element_state);
  state.t = next_.t;
  return true;
}

}  // namespace stillhook
