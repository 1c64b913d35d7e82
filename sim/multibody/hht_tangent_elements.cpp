// What the elements' histories, parameters and drives add to the tangent of a step.
#include <algorithm>
#include <cmath>

#include "sim/multibody/hht_tangent.h"

namespace stillhook {

namespace {
constexpr double kSmall = 1e-5;  // m, rad, m/s, or a drive's unit: displacement for the differences of one element
}

void displace_bodies(const BodyChange& change, Eigen::Index j, double by, std::vector<BodyKinematics>& bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const int r = 6 * static_cast<int>(i);
    BodyKinematics& b = bodies[i];
    b.p_WC += by * change.xi.col(j).segment<3>(r);
    // exp([phi]x) to the second order: by is small, and this is called very often.
    const Matrix3 turn = cross_matrix(by * change.xi.col(j).segment<3>(r + 3));
    b.R_WB += b.R_WB * (turn + 0.5 * turn * turn);
    b.v_WC += by * change.u.col(j).segment<3>(r);
    b.w_B += by * change.u.col(j).segment<3>(r + 3);
  }
}

void HhtTangent::add_history(double h) {
  const Instant before = before_.instant(), now = middle_.instant();
  differenced_.clear();
  for (std::size_t k = 0; k < system_.elements.size(); ++k) {
    const ForceElement& element = *system_.elements[k];
    if (!element.has_history()) continue;
    const int e = static_cast<int>(k);
    const Memory m = system_.memory_in(e, middle_.element_state, stepper_.work_.element_scratch);
    const auto rows = now_.element_state.middleRows(system_.state_offset(e), element.state_size());
    if (!element.add_history_tangent(before, now, h, m, from_, rows, E_)) differenced_.push_back(e);
  }
  if (!differenced_.empty()) history_by_differences(h);
}

// Moves the beginning of the step along column j by `by` and lets the elements begin it there.
void HhtTangent::begin_displaced(Eigen::Index j, double by, double h) {
  displaced_ = before_;
  displace_bodies(from_, j, by, displaced_.body);
  for (const int e : differenced_) {
    const int first = system_.state_offset(e), count = system_.elements[e]->state_size();
    for (int k = first; k < first + count; ++k) displaced_.element_state[k] += by * now_.element_state(k, j);
    system_.elements[e]->begin_step(displaced_.instant(), h, system_.memory_in(e, displaced_.element_state, scratch_));
  }
}

// How far the differences may go along column j.
double HhtTangent::differences_by(Eigen::Index j, const BodyChange& bodies) const {
  double size = std::max(bodies.xi.col(j).cwiseAbs().maxCoeff(), bodies.u.col(j).cwiseAbs().maxCoeff());
  for (const int e : differenced_)
    if (const int states = system_.elements[e]->state_size(); states > 0)
      size = std::max(size, now_.element_state.col(j).segment(system_.state_offset(e), states).cwiseAbs().maxCoeff());
  return size > 0.0 && std::isfinite(size) ? kSmall / size : 0.0;
}

void HhtTangent::history_by_differences(double h) {
  for (Eigen::Index j = 0; j < E_.cols(); ++j) {
    const double by = differences_by(j, from_);
    if (by == 0.0) continue;
    for (const double sign : {-1.0, 1.0}) {
      begin_displaced(j, sign * by, h);
      forces_.clear();
      for (const int e : differenced_)
        system_.elements[e]->add_forces(middle_.instant(), h, system_.memory_in(e, displaced_.element_state, scratch_),
                                        forces_);
      E_.col(j) += (sign / (2.0 * by)) * forces_.value();
    }
  }
}

void HhtTangent::add_explicit(double h, const TwinDrives& before, const TwinDrives& now) {
  for (ByDrives& of : by_drives_) of.known = false;
  for (Taken& taken : taken_) taken.known = false;
  for (int j = 0; j < directions(); ++j) {
    Explicit& sum = explicit_[j];
    if (sum.any) {
      sum.force.setZero();
      sum.constraint.setZero();
      sum.state.setZero();
      sum.any = false;
    }
    const Twin& twin = twins_[j];
    const SideDrives& drives = now[static_cast<std::size_t>(j)];
    for (const int e : twin.elements) add_element(e, j, h, before[static_cast<std::size_t>(j)], drives);
    for (const int e : driven_) {
      const auto moves = [&](int d) {
        const std::size_t i = static_cast<std::size_t>(d);
        return drives[0][i].position != drives[1][i].position || drives[0][i].rate != drives[1][i].rate;
      };
      if (std::ranges::none_of(system_.elements[e]->drives(), moves) || differs(j, e)) continue;
      if (system_.elements[e]->has_history())
        add_element(e, j, h, before[static_cast<std::size_t>(j)], drives);
      else
        add_drive(e, j, h, drives);
    }
    if (twin.bodies || twin.joints) add_bodies(j);
    sum.any = !sum.force.isZero(0.0) || !sum.constraint.isZero(0.0) || !sum.state.isZero(0.0);
  }
}

// One step of the element from before_ to middle_ with these drives, along the branches: its force is left in forces_,
// its state in displaced_.
void HhtTangent::step_along(const ForceElement& of, int e, double h, std::span<const DriveState> before,
                            std::span<const DriveState> now, std::vector<double>& scratch) {
  Branches* branches = &taken_[e].branches;
  std::copy_n(before_.element_state.begin() + system_.state_offset(e), of.state_size(),
              displaced_.element_state.begin() + system_.state_offset(e));
  const Memory m = system_.memory_in(e, displaced_.element_state, scratch);
  const Instant from{before_.t, before_.body, before, before_.phase, branches};
  const Instant to{middle_.t, middle_.body, now, middle_.phase, branches};
  of.begin_step(from, h, m);
  forces_.clear();
  of.add_forces(to, h, m, forces_);
  if (of.has_history()) of.end_step(to, h, m);
}

void HhtTangent::find_branches(int e, double h) {
  if (taken_[e].known) return;
  taken_[e].branches.record();
  step_along(*system_.elements[e], e, h, before_.drive, middle_.drive, scratch_);
  taken_[e].known = true;
}

void HhtTangent::add_element(int e, int j, double h, const SideDrives& before, const SideDrives& now) {
  Twin& twin = twins_[j];
  Explicit& sum = explicit_[j];
  const bool differing = differs(j, e);
  const int first = system_.state_offset(e), count = system_.elements[e]->state_size();
  find_branches(e, h);
  for (int side = 0; side < 2; ++side) {
    const ForceElement& element = differing ? *twin.of.system[side]->elements[e] : *system_.elements[e];
    taken_[e].branches.replay();
    step_along(element, e, h, before[side], now[side], differing ? twin.scratch[side] : scratch_);
    if (side > 0) break;
    low_force_ = forces_.value();
    std::copy_n(displaced_.element_state.begin() + first, count, low_state_.begin() + first);
  }
  // The difference first: where both sides agree it is zero and not rounding.
  sum.force += (forces_.value() - low_force_) / twin.of.width;
  if (!system_.elements[e]->has_history())
    return;  // a state that only helps to compute has no derivative worth knowing
  for (int k = first; k < first + count; ++k)
    sum.state[k] += (displaced_.element_state[k] - low_state_[k]) / twin.of.width;
}

const HhtTangent::ByDrives& HhtTangent::by_drives(int e, double h) {
  ByDrives& of = by_drives_[e];
  if (of.known) return of;
  find_branches(e, h);
  drives_ = middle_.drive;
  const auto slope = [&](double& value, VectorX& out) {
    const double at = value;
    for (const double sign : {-1.0, 1.0}) {
      value = at + sign * kSmall;
      taken_[e].branches.replay();
      step_along(*system_.elements[e], e, h, before_.drive, drives_, scratch_);
      if (sign < 0.0) low_force_ = forces_.value();
    }
    out = (forces_.value() - low_force_) / (2.0 * kSmall);
    value = at;
  };
  const std::span<const int> drives = system_.elements[e]->drives();
  of.derivatives.resize(drives.size());
  for (std::size_t k = 0; k < drives.size(); ++k) {
    slope(drives_[drives[k]].position, of.derivatives[k].position);
    slope(drives_[drives[k]].rate, of.derivatives[k].rate);
  }
  of.known = true;
  return of;
}

// The drives of an element that is the same on both sides.
void HhtTangent::add_drive(int e, int j, double h, const SideDrives& now) {
  const ByDrives& of = by_drives(e, h);
  const std::span<const int> drives = system_.elements[e]->drives();
  const double width = twins_[j].of.width;
  for (std::size_t k = 0; k < drives.size(); ++k) {
    const DriveState &low = now[0][drives[k]], &high = now[1][drives[k]];
    explicit_[j].force += ((high.position - low.position) / width) * of.derivatives[k].position +
                          ((high.rate - low.rate) / width) * of.derivatives[k].rate;
  }
}

void HhtTangent::add_bodies(int j) {
  const Twin& twin = twins_[j];
  Explicit& sum = explicit_[j];
  VectorX C;
  MatrixX C_q;
  for (int side = 0; side < 2; ++side) {
    const double sign = (side == 0 ? -1.0 : 1.0) / twin.of.width;
    const MultibodySystem& system = *twin.of.system[side];
    for (std::size_t i = 0; i < system.bodies.size(); ++i) {
      const RigidBody& b = system.bodies[i];
      const Vector3& w = middle_.body[i].w_B;
      const int r = 6 * static_cast<int>(i);
      sum.force[r + 2] -= sign * b.mass * system.gravity;
      sum.force.segment<3>(r + 3) -= sign * w.cross(b.inertia * w);
    }
    if (!twin.joints) continue;
    system.constraint_values(middle_, C);
    system.constraint_jacobian(middle_, C_q);
    sum.constraint += sign * C;
    sum.force -= sign * (C_q.transpose() * middle_.lambda);
  }
}

void HhtTangent::advance_states(double h) {
  const Instant before = before_.instant(), now = middle_.instant();
  differenced_.clear();
  for (std::size_t k = 0; k < system_.elements.size(); ++k) {
    const ForceElement& element = *system_.elements[k];
    if (element.state_size() == 0) continue;
    const int e = static_cast<int>(k);
    const Memory m = system_.memory_in(e, middle_.element_state, stepper_.work_.element_scratch);
    auto rows = now_.element_state.middleRows(system_.state_offset(e), element.state_size());
    if (!element.advance_state_tangent(before, now, h, m, from_, now_.body, rows)) differenced_.push_back(e);
  }
  if (!differenced_.empty()) states_by_differences(h);
  for (std::size_t c = 0; c < live_.size(); ++c)
    if (explicit_[live_[c]].any) now_.element_state.col(static_cast<Eigen::Index>(c)) += explicit_[live_[c]].state;
}

void HhtTangent::states_by_differences(double h) {
  for (Eigen::Index j = 0; j < E_.cols(); ++j) {
    double by = differences_by(j, from_);
    if (const double now = differences_by(j, now_.body); by == 0.0 || (now > 0.0 && now < by)) by = now;
    if (by == 0.0) continue;
    change_.setZero();
    for (const double sign : {-1.0, 1.0}) {
      begin_displaced(j, sign * by, h);
      to_ = middle_.body;
      displace_bodies(now_.body, j, sign * by, to_);
      for (const int e : differenced_) {
        const Memory m = system_.memory_in(e, displaced_.element_state, scratch_);
        system_.elements[e]->end_step({middle_.t, to_, middle_.drive, middle_.phase}, h, m);
        const int first = system_.state_offset(e);
        for (std::size_t k = 0; k < m.state.size(); ++k)
          change_[first + static_cast<int>(k)] += sign / (2.0 * by) * m.state[k];
      }
    }
    for (const int e : differenced_) {
      const int first = system_.state_offset(e), count = system_.elements[e]->state_size();
      now_.element_state.col(j).segment(first, count) = change_.segment(first, count);
    }
  }
}

}  // namespace stillhook
