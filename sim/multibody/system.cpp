#include "sim/multibody/system.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace stillhook {

void MultibodySystem::finish() {
  state_offset_.clear();
  scratch_offset_.clear();
  state_size_ = scratch_size_ = 0;
  for (const auto& e : elements) {
    state_offset_.push_back(state_size_);
    scratch_offset_.push_back(scratch_size_);
    state_size_ += e->state_size();
    scratch_size_ += e->scratch_size();
  }
  MatrixX rigid = MatrixX::Zero(coordinates(), coordinates());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const int r = 6 * static_cast<int>(i);
    rigid.block<3, 3>(r, r) = bodies[i].mass * Matrix3::Identity();
    rigid.block<3, 3>(r + 3, r + 3) = bodies[i].inertia;
  }
  std::set<int> phases{0};
  for (const auto& e : elements)
    for (const int phase : e->mass_changes()) phases.insert(phase);
  masses_.clear();
  for (const int phase : phases) {
    masses_.push_back({phase, rigid});
    for (const auto& e : elements) e->add_mass(masses_.back().M, phase);
  }
  rows_.clear();
  dropped_.clear();
  for (std::size_t j = 0; j < joints.size(); ++j)
    for (int r = 0; r < joints[j].rows(); ++r) rows_.push_back({static_cast<int>(j), r});
}

SystemWorkspace MultibodySystem::make_workspace() const {
  SystemWorkspace work(static_cast<int>(bodies.size()));
  work.element_scratch.assign(scratch_size_, 0.0);
  return work;
}

Memory MultibodySystem::memory_in(int e, std::vector<double>& states, std::vector<double>& scratch) const {
  return {std::span(states).subspan(state_offset_[e], elements[e]->state_size()),
          std::span(scratch).subspan(scratch_offset_[e], elements[e]->scratch_size())};
}

void MultibodySystem::start_elements(SystemState& state, SystemWorkspace& work) const {
  state.element_state.resize(state_size_);
  const Instant now = state.instant();
  for (std::size_t e = 0; e < elements.size(); ++e) elements[e]->start(now, memory(static_cast<int>(e), state, work));
}

void MultibodySystem::settle_elements(SystemState& state, SystemWorkspace& work) const {
  const Instant now = state.instant();
  for (std::size_t e = 0; e < elements.size(); ++e) elements[e]->settle(now, memory(static_cast<int>(e), state, work));
}

void MultibodySystem::begin_step(SystemState& state, double h, SystemWorkspace& work) const {
  const Instant now = state.instant();
  for (std::size_t e = 0; e < elements.size(); ++e)
    elements[e]->begin_step(now, h, memory(static_cast<int>(e), state, work));
}

void MultibodySystem::end_step(SystemState& state, double h, SystemWorkspace& work) const {
  const Instant now = state.instant();
  for (std::size_t e = 0; e < elements.size(); ++e)
    elements[e]->end_step(now, h, memory(static_cast<int>(e), state, work));
}

void MultibodySystem::forces(SystemState& state, double h, SystemWorkspace& work, VectorX& out) const {
  const Instant now = state.instant();
  work.forces.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const RigidBody& b = bodies[i];
    const Vector3& w = state.body[i].w_B;
    work.forces.add(static_cast<int>(i), {0.0, 0.0, -b.mass * gravity}, -w.cross(b.inertia * w));
  }
  for (std::size_t e = 0; e < elements.size(); ++e)
    elements[e]->add_forces(now, h, memory(static_cast<int>(e), state, work), work.forces);
  out = work.forces.value();
}

void MultibodySystem::jacobian(SystemState& state, double h, SystemWorkspace& work) const {
  const Instant now = state.instant();
  work.jacobian.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    // d(-w x J w) = ([J w]x - [w]x J) dw
    const Vector3& w = state.body[i].w_B;
    Matrix6 C = Matrix6::Zero();
    C.bottomRightCorner<3, 3>() = cross_matrix(bodies[i].inertia * w) - cross_matrix(w) * bodies[i].inertia;
    work.jacobian.add_damping(static_cast<int>(i), static_cast<int>(i), C);
  }
  for (std::size_t e = 0; e < elements.size(); ++e)
    elements[e]->add_jacobian(now, h, memory(static_cast<int>(e), state, work), work.jacobian);
  std::size_t k = 0;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    Joint::Rows lambda = Joint::Rows::Zero();
    for (; k < rows_.size() && rows_[k].joint == static_cast<int>(j); ++k) lambda[rows_[k].row] = state.lambda[k];
    joints[j].add_stiffness(now, lambda, work.jacobian);
  }
}

void MultibodySystem::constraint_values(const SystemState& state, VectorX& C) const {
  const Instant now = state.instant();
  C.resize(constraints());
  Joint::Rows values;
  std::size_t k = 0;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    joints[j].values(now, values);
    for (; k < rows_.size() && rows_[k].joint == static_cast<int>(j); ++k) C[k] = values[rows_[k].row];
  }
}

void MultibodySystem::constraint_jacobian(const SystemState& state, MatrixX& C_q) const {
  const Instant now = state.instant();
  C_q.setZero(constraints(), coordinates());
  Joint::Block parent, child;
  std::size_t k = 0;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    joints[j].jacobian(now, parent, child);
    const int p = joints[j].on_parent.body, c = joints[j].on_child.body;
    for (; k < rows_.size() && rows_[k].joint == static_cast<int>(j); ++k) {
      if (p != kWorld) C_q.block<1, 6>(k, 6 * p) += parent.row(rows_[k].row);
      if (c != kWorld) C_q.block<1, 6>(k, 6 * c) += child.row(rows_[k].row);
    }
  }
}

void MultibodySystem::constraint_acceleration(const SystemState& state, VectorX& gamma) const {
  const Instant now = state.instant();
  gamma.resize(constraints());
  Joint::Rows values;
  std::size_t k = 0;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    joints[j].quadratic_velocity(now, values);
    for (; k < rows_.size() && rows_[k].joint == static_cast<int>(j); ++k) gamma[k] = values[rows_[k].row];
  }
}

std::vector<std::string> MultibodySystem::select_independent_rows(const SystemState& state) {
  rows_.insert(rows_.end(), dropped_.begin(), dropped_.end());
  dropped_.clear();
  std::stable_sort(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) {
    return a.joint < b.joint || (a.joint == b.joint && a.row < b.row);
  });
  MatrixX C_q;
  constraint_jacobian(state, C_q);
  // Rows of points (per m) and of angles are brought to one length, then a row is kept while it adds to the span of
  // those before it: the earlier joint keeps its rows. (Gram-Schmidt, twice for accuracy.)
  std::vector<Row> kept;
  std::vector<VectorX> basis;
  std::vector<std::string> losers;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    VectorX v = C_q.row(k).transpose();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const double radius = std::sqrt(bodies[i].inertia.trace() / (3.0 * bodies[i].mass));
      v.segment<3>(6 * i + 3) /= std::max(radius, 1e-3);
    }
    v.normalize();
    for (int pass = 0; pass < 2; ++pass)
      for (const VectorX& b : basis) v -= b.dot(v) * b;
    const double rest = v.norm();
    if (rest > 1e-8) {
      basis.push_back(v / rest);
      kept.push_back(rows_[k]);
      continue;
    }
    dropped_.push_back(rows_[k]);
    const std::string& name = joints[rows_[k].joint].name;
    if (losers.empty() || losers.back() != name) losers.push_back(name);
  }
  rows_ = kept;
  return losers;
}

double MultibodySystem::dropped_violation(const SystemState& state, std::string& where) const {
  double worst = 0.0;
  Joint::Rows values;
  for (const Row& row : dropped_) {
    joints[row.joint].values(state.instant(), values);
    if (std::abs(values[row.row]) <= worst) continue;
    worst = std::abs(values[row.row]);
    where = joints[row.joint].name;
  }
  return worst;
}

void MultibodySystem::joint_reaction(const SystemState& state, int j, Vector3& force, Vector3& moment) const {
  const Instant now = state.instant();
  Joint::Block parent, child;
  joints[j].jacobian(now, parent, child);
  Vector6 Q = Vector6::Zero();
  for (std::size_t k = 0; k < rows_.size(); ++k)
    if (rows_[k].joint == j) Q -= state.lambda[k] * child.row(rows_[k].row).transpose();
  const BodyKinematics& b = state.body[joints[j].on_child.body];
  force = Q.head<3>();
  moment = b.R_WB * Q.tail<3>() - (b.R_WB * joints[j].on_child.c_B).cross(force);
}

double MultibodySystem::prescribed_power(const SystemState& state) const {
  const Instant now = state.instant();
  double power = 0.0;
  std::size_t k = 0;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    Joint::Rows drift;
    joints[j].drift(now, drift);
    for (; k < rows_.size() && rows_[k].joint == static_cast<int>(j); ++k)
      power += state.lambda[static_cast<Eigen::Index>(k)] * drift[rows_[k].row];
  }
  return power;
}

double MultibodySystem::kinetic_energy(const SystemState& state) const {
  VectorX u(coordinates());
  for (std::size_t i = 0; i < bodies.size(); ++i) u.segment<6>(6 * i) << state.body[i].v_WC, state.body[i].w_B;
  return 0.5 * u.dot(mass(state.phase) * u);
}

double MultibodySystem::potential_energy(SystemState& state, SystemWorkspace& work) const {
  double E = 0.0;
  for (std::size_t i = 0; i < bodies.size(); ++i) E += bodies[i].mass * gravity * state.body[i].p_WC.z();
  for (std::size_t e = 0; e < elements.size(); ++e)
    E += elements[e]->potential_energy(state.instant(), memory(static_cast<int>(e), state, work));
  return E;
}

}  // namespace stillhook
