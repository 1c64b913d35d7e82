#include "sim/multibody/hht_tangent.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace stillhook {

namespace {

bool same_bodies(const MultibodySystem& a, const MultibodySystem& b) {
  if (a.gravity != b.gravity) return false;
  for (std::size_t i = 0; i < a.bodies.size(); ++i)
    if (a.bodies[i].mass != b.bodies[i].mass || a.bodies[i].inertia != b.bodies[i].inertia) return false;
  return true;
}

bool same_joints(const MultibodySystem& a, const MultibodySystem& b) {
  for (std::size_t j = 0; j < a.joints.size(); ++j) {
    const Joint &p = a.joints[j], &q = b.joints[j];
    if (p.on_parent.c_B != q.on_parent.c_B || p.on_child.c_B != q.on_child.c_B ||
        p.frame_on_parent != q.frame_on_parent || p.frame_on_child != q.frame_on_child ||
        (p.motion != nullptr) != (q.motion != nullptr) || (p.motion && !p.motion->same_as(*q.motion)))
      return false;
  }
  return true;
}

}  // namespace

HhtTangent::Twin HhtTangent::compare(const MultibodySystem& base, const SystemTwin& of) {
  Twin twin;
  twin.of = of;
  if (!of.system[0]) return twin;
  for (int side = 0; side < 2; ++side) {
    const MultibodySystem& other = *of.system[side];
    const bool alike = other.elements.size() == base.elements.size() && other.joints.size() == base.joints.size() &&
                       other.bodies.size() == base.bodies.size() && other.constraints() == base.constraints() &&
                       other.element_state_size() == base.element_state_size();
    if (!alike) throw std::invalid_argument("a change of a parameter changes what the lift is made of");
    twin.bodies = twin.bodies || !same_bodies(base, other);
    twin.joints = twin.joints || !same_joints(base, other);
    twin.mass = twin.mass || other.mass(0) != base.mass(0);
  }
  for (std::size_t e = 0; e < base.elements.size(); ++e) {
    const ForceElement& own = *base.elements[e];
    const auto same = [&](int side) {
      const ForceElement& other = *of.system[side]->elements[e];
      return &own == &other || own.same_as(other);
    };
    if (!same(0) || !same(1)) twin.elements.push_back(static_cast<int>(e));
  }
  if (!twin.elements.empty())
    for (int side = 0; side < 2; ++side) twin.scratch[side] = of.system[side]->make_workspace().element_scratch;
  return twin;
}

HhtTangent::HhtTangent(HhtStepper& stepper, std::vector<SystemTwin> twins)
    : stepper_(stepper), system_(stepper.system_), forces_(static_cast<int>(system_.bodies.size())) {
  for (const SystemTwin& twin : twins) twins_.push_back(compare(system_, twin));
  const int states = system_.element_state_size();
  explicit_.assign(twins_.size(), {VectorX::Zero(system_.coordinates()), VectorX::Zero(system_.constraints()),
                                   VectorX::Zero(states), false});
  by_drives_.resize(system_.elements.size());
  taken_.resize(system_.elements.size());
  column_.assign(twins_.size(), -1);
  of_history_.assign(static_cast<std::size_t>(states), false);
  for (std::size_t e = 0; e < system_.elements.size(); ++e)
    if (system_.elements[e]->has_history())
      std::fill_n(of_history_.begin() + system_.state_offset(static_cast<int>(e)), system_.elements[e]->state_size(),
                  true);
  change_ = VectorX::Zero(states);
  for (std::size_t e = 0; e < system_.elements.size(); ++e)
    if (!system_.elements[e]->drives().empty()) driven_.push_back(static_cast<int>(e));
  scratch_ = system_.make_workspace().element_scratch;
  displaced_.element_state.resize(static_cast<std::size_t>(states));
  low_state_.resize(static_cast<std::size_t>(states));
}

bool HhtTangent::differs(int j, int element) const {
  const std::vector<int>& all = twins_[j].elements;
  return std::find(all.begin(), all.end(), element) != all.end();
}

void HhtTangent::start(const SystemState& base, std::vector<std::array<SystemState, 2>> starts) {
  mass_ = &system_.mass(base.phase);
  const int p = directions();
  const auto zero = [p](int rows) { return MatrixX(MatrixX::Zero(rows, p)); };
  now_.body.xi = now_.body.u = now_.acceleration = now_.jerk = now_.F0 = zero(system_.coordinates());
  now_.lambda = zero(system_.constraints());
  now_.element_state = zero(system_.element_state_size());
  std::vector<int> live;
  for (int j = 0; j < p; ++j) {
    const Twin& twin = twins_[j];
    const double w = twin.of.width;
    for (int side = 0; side < 2; ++side) {
      SystemState& s = starts[static_cast<std::size_t>(j)][side];
      const double sign = side == 0 ? -1.0 / w : 1.0 / w;
      HhtStepper stepper(twin.of.system[side] ? *twin.of.system[side] : system_, stepper_.options_);
      stepper.start(s);
      for (std::size_t i = 0; i < base.body.size(); ++i) {
        const BodyKinematics &b = base.body[i], &c = s.body[i];
        const int r = 6 * static_cast<int>(i);
        now_.body.xi.col(j).segment<3>(r) += sign * (c.p_WC - b.p_WC);
        now_.body.xi.col(j).segment<3>(r + 3) += sign * log_rotation(b.R_WB.transpose() * c.R_WB);
        now_.body.u.col(j).segment<3>(r) += sign * (c.v_WC - b.v_WC);
        now_.body.u.col(j).segment<3>(r + 3) += sign * (c.w_B - b.w_B);
      }
      now_.acceleration.col(j) += sign * (s.acceleration - base.acceleration);
      now_.jerk.col(j) += sign * (stepper.jerk_ - stepper_.jerk_);
      now_.F0.col(j) += sign * (stepper.F0_ - stepper_.F0_);
      now_.lambda.col(j) += sign * (s.lambda - base.lambda);
      for (std::size_t k = 0; k < base.element_state.size(); ++k)
        if (of_history_[k])
          now_.element_state(static_cast<Eigen::Index>(k), j) += sign * (s.element_state[k] - base.element_state[k]);
    }
    const auto moves = [j](const MatrixX& part) { return !part.col(j).isZero(0.0); };
    if (twin.mass || twin.bodies || twin.joints || moves(now_.body.xi) || moves(now_.body.u) ||
        moves(now_.acceleration) || moves(now_.jerk) || moves(now_.F0) || moves(now_.lambda) ||
        moves(now_.element_state))
      live.push_back(j);
  }
  keep_columns(live);
}

void HhtTangent::keep_columns(const std::vector<int>& directions) {
  for (MatrixX* part :
       {&now_.body.xi, &now_.body.u, &now_.acceleration, &now_.jerk, &now_.F0, &now_.lambda, &now_.element_state})
    *part = MatrixX((*part)(Eigen::all, directions));
  live_ = directions;
  for (std::size_t c = 0; c < live_.size(); ++c) column_[live_[c]] = static_cast<int>(c);
}

// Directions that change something for the first time in this step get their column.
void HhtTangent::wake() {
  for (int j = 0; j < directions(); ++j) {
    if (column_[j] >= 0 || !explicit_[j].any) continue;
    column_[j] = static_cast<int>(live_.size());
    live_.push_back(j);
    for (MatrixX* part :
         {&now_.body.xi, &now_.body.u, &now_.acceleration, &now_.jerk, &now_.F0, &now_.lambda, &now_.element_state}) {
      part->conservativeResize(Eigen::NoChange, column_[j] + 1);
      part->col(column_[j]).setZero();
    }
  }
}

void HhtTangent::begin(const SystemState& state) {
  before_ = state;
  last_h_ = stepper_.last_h_;
}

// The same jump of the acceleration as the stepper's: M_new a_new = M_old a_old.
void HhtTangent::follow_mass() {
  const MatrixX* mass = &system_.mass(before_.phase);
  if (mass == mass_) return;
  const auto solver = mass->ldlt();
  const VectorX after = solver.solve(*mass_ * before_.acceleration);
  MatrixX rhs = *mass_ * now_.acceleration;
  for (int j = 0; j < directions(); ++j) {
    if (!twins_[j].mass) continue;  // else it has a column from the start
    const SystemTwin& of = twins_[j].of;
    const auto change = [&](int phase) {
      return MatrixX((of.system[1]->mass(phase) - of.system[0]->mass(phase)) / of.width);
    };
    rhs.col(column_[j]) += change(phase_) * before_.acceleration - change(before_.phase) * after;
  }
  now_.acceleration = solver.solve(rhs);
  now_.jerk.setZero();
  mass_ = mass;
}

void HhtTangent::predict(double h) {
  const double beta = stepper_.beta_, gamma = stepper_.gamma_;
  from_.xi = now_.body.xi;
  from_.u = now_.body.u;
  a_start_ = now_.acceleration + (stepper_.options_.alpha * (h - last_h_)) * now_.jerk;
  now_.body.u += (h * (1.0 - gamma)) * a_start_;
  for (std::size_t i = 0; i < before_.body.size(); ++i) {
    const int r = 6 * static_cast<int>(i);
    const Vector3& turn = stepper_.turn_[i];
    const auto moved = [&](int row) {
      return h * from_.u.middleRows<3>(row) + (h * h * (0.5 - beta)) * a_start_.middleRows<3>(row);
    };
    now_.body.xi.middleRows<3>(r) += moved(r);
    now_.body.xi.middleRows<3>(r + 3) =
        exp_rotation(turn).transpose() * from_.xi.middleRows<3>(r + 3) + right_jacobian(turn) * moved(r + 3);
  }
}

void HhtTangent::solve(const SystemState& middle, double h) {
  HhtStepper& s = stepper_;
  const int n = system_.coordinates(), m = system_.constraints();
  const double al = s.options_.alpha;
  // Newton's matrix at the converged state; the stepper goes on with it.
  s.next_ = middle;
  system_.constraint_jacobian(s.next_, s.C_q_);
  s.factorise(h);
  rhs_.resize(n + m, E_.cols());
  rhs_.topRows(n) = E_ - (al / (1.0 + al)) * now_.F0;
  rhs_.topRows(n).noalias() += s.work_.jacobian.stiffness() * now_.body.xi;
  rhs_.topRows(n).noalias() += s.work_.jacobian.damping() * now_.body.u;
  constraint_.noalias() += s.C_q_ * now_.body.xi;
  rhs_.bottomRows(m) = (-s.lambda_scale_ / (s.beta_ * h * h)) * constraint_;
  now_.F0 *= al / (1.0 + al);
  for (int j = 0; j < directions(); ++j) {
    if (!twins_[j].mass) continue;
    const SystemTwin& of = twins_[j].of;
    const VectorX inertia =
        ((of.system[1]->mass(middle.phase) - of.system[0]->mass(middle.phase)) * middle.acceleration) /
        ((1.0 + al) * of.width);
    rhs_.col(column_[j]).head(n) -= inertia;
    now_.F0.col(column_[j]) += inertia;
  }
  y_ = s.lu_.solve(rhs_);
  now_.acceleration = y_.topRows(n);
  now_.lambda = s.lambda_scale_ * y_.bottomRows(m);
  now_.F0.noalias() += (1.0 / (1.0 + al)) * (*mass_ * now_.acceleration);
  now_.jerk = (now_.acceleration - a_start_) / h;
  now_.body.u += (s.gamma_ * h) * now_.acceleration;
  for (std::size_t i = 0; i < before_.body.size(); ++i) {
    const int r = 6 * static_cast<int>(i);
    now_.body.xi.middleRows<3>(r) += (s.beta_ * h * h) * now_.acceleration.middleRows<3>(r);
    now_.body.xi.middleRows<3>(r + 3) +=
        (s.beta_ * h * h) * (right_jacobian(s.turn_[i]) * now_.acceleration.middleRows<3>(r + 3));
  }
}

void HhtTangent::end(SystemState& state, double h, const TwinDrives& drives_before, const TwinDrives& drives) {
  follow_mass();
  phase_ = before_.phase;
  // The converged state as the elements saw it in the step: their memories still belong to its beginning.
  middle_ = state;
  middle_.element_state = before_.element_state;
  add_explicit(h, drives_before, drives);
  wake();
  if (live_.empty()) return;
  predict(h);
  const Eigen::Index columns = static_cast<Eigen::Index>(live_.size());
  E_.resize(system_.coordinates(), columns);
  constraint_.resize(system_.constraints(), columns);
  for (Eigen::Index c = 0; c < columns; ++c) {
    E_.col(c) = explicit_[live_[c]].force;
    constraint_.col(c) = explicit_[live_[c]].constraint;
  }
  add_history(h);
  solve(middle_, h);
  advance_states(h);
}

double HhtTangent::growth(const VectorX& scale) const {
  double largest = 0.0;
  for (std::size_t c = 0; c < live_.size(); ++c)
    largest = std::max(largest, scale[live_[c]] * now_.body.xi.col(static_cast<Eigen::Index>(c)).cwiseAbs().maxCoeff());
  return largest;
}

MatrixX HhtTangent::state_change() const {
  const int n = system_.coordinates();
  MatrixX all = MatrixX::Zero(2 * n + system_.element_state_size(), directions());
  for (std::size_t k = 0; k < live_.size(); ++k) {
    const Eigen::Index c = static_cast<Eigen::Index>(k);
    all.col(live_[k]) << now_.body.xi.col(c), now_.body.u.col(c), now_.element_state.col(c);
  }
  return all;
}

double HhtTangent::small_step(int j) const {
  constexpr double kSmall = 1e-5;  // m, rad: rounding and curvature are both below 1e-8 of a force law's change
  const int c = column_[j];
  if (c < 0) return 0.0;
  double size = std::max(now_.body.xi.col(c).cwiseAbs().maxCoeff(), now_.body.u.col(c).cwiseAbs().maxCoeff());
  if (now_.element_state.rows() > 0) size = std::max(size, now_.element_state.col(c).cwiseAbs().maxCoeff());
  return size > 0.0 && std::isfinite(size) ? kSmall / size : 0.0;
}

void HhtTangent::displaced(const SystemState& state, int j, double by, SystemState& out) const {
  const int c = column_[j];
  out = state;
  if (c < 0) return;
  displace_bodies(now_.body, c, by, out.body);
  for (std::size_t k = 0; k < out.element_state.size(); ++k)
    out.element_state[k] += by * now_.element_state(static_cast<Eigen::Index>(k), c);
  out.lambda += by * now_.lambda.col(c);
  out.acceleration += by * now_.acceleration.col(c);
}

}  // namespace stillhook
