// What every force element must pass: exact derivatives, action equals reaction, a closed energy account, finite
// output, no hidden state. To test a new element write an ElementCase for each regime of its law and call
// check_force_element() in a TEST_CASE.
#pragma once

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "sim/multibody/force_element.h"

namespace stillhook::suite {

/// Bodies and drives at one instant, as values that can be moved.
struct Scene {
  double t = 0.0;
  std::vector<BodyKinematics> body;
  std::vector<DriveState> drive;
  Instant instant() const { return {t, body, drive}; }
  /// The scene after dt (s) at constant velocities.
  Scene moved(double dt) const {
    Scene s = *this;
    s.t += dt;
    for (BodyKinematics& b : s.body) {
      b.p_WC += dt * b.v_WC;
      b.R_WB = b.R_WB * exp_rotation(dt * b.w_B);
    }
    for (DriveState& d : s.drive) d.position += dt * d.rate;
    return s;
  }
  VectorX velocity() const {
    VectorX u(6 * body.size());
    for (std::size_t i = 0; i < body.size(); ++i) u.segment<6>(6 * i) << body[i].v_WC, body[i].w_B;
    return u;
  }
};

inline Vector3 random_vector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> range(-size, size);
  const double x = range(random), y = range(random), z = range(random);
  return {x, y, z};
}

/// Bodies anywhere within 10 m, at any attitude, moving and turning.
inline Scene general_scene(std::mt19937& random, int bodies, int drives) {
  Scene s;
  std::uniform_real_distribution<double> small(-0.3, 0.3);
  s.t = 1.0 + small(random);
  for (int i = 0; i < bodies; ++i) {
    BodyKinematics b;
    b.R_WB = exp_rotation(random_vector(random, 1.7));
    b.p_WC = random_vector(random, 10.0);
    b.v_WC = random_vector(random, 1.0);
    b.w_B = random_vector(random, 0.5);
    s.body.push_back(b);
  }
  for (int i = 0; i < drives; ++i) {
    const double position = small(random), rate = small(random);
    s.drive.push_back({position, rate});
  }
  return s;
}

/// One element in one regime of its law.
struct ElementCase {
  std::string name;
  int bodies = 1, drives = 0;
  /// Builds the element so that it is in the wanted regime at this instant.
  std::function<std::unique_ptr<const ForceElement>(const Instant&)> make;
  /// Scenes; general_scene() if empty.
  std::function<Scene(std::mt19937&)> scene;
  /// Length of the step at whose end forces and derivatives are taken, s; 0 = statics.
  double time_step = 0.0;
  /// All forces act between the bodies: their sum and their moment vanish.
  bool between_bodies = true;
  /// The element must exert a force in this regime (false: it must not).
  bool loaded = true;
  /// Power that the drives give, W; needed where drives > 0.
  std::function<double(const ForceElement&, const Instant&, Memory)> drive_power;
  bool energy_account = true;  // false: the element has no potential energy of its own to balance
  int report_states = 0;       // so many of the last states are for reports alone: their derivatives are not offered
  bool smooth_history = true;  // false: the step begins at a kink of the law, where there is no derivative
  double energy_time = 1e-4;   // s, of the difference of the energy
  double step = 2e-5;          // m, rad: of the differences
  double rate_step = 2e-5;     // m/s, rad/s
  /// Of a 3 x 3 block's norm. Richardson's rule on smooth laws leaves 1e-9; the margin covers laws with short scales.
  double tolerance = 1e-6;
};

/// Memory of one element.
class Store {
 public:
  explicit Store(const ForceElement& e) : state_(e.state_size()), scratch_(e.scratch_size()) {}
  Memory memory() { return {state_, scratch_}; }

 private:
  std::vector<double> state_, scratch_;
};

inline VectorX forces(const ForceElement& e, const Scene& s, double h, Memory m) {
  ForceSum sum(static_cast<int>(s.body.size()));
  e.add_forces(s.instant(), h, m, sum);
  return sum.value();
}

/// Starts the element and brings it to the inside of a step that ends at `s`.
inline void prepare(const ForceElement& e, const Scene& s, double h, Memory m) {
  const Scene before = s.moved(-h);
  e.start(before.instant(), m);
  if (h > 0.0) e.begin_step(before.instant(), h, m);
}

/// d(forces)/d(one coordinate or velocity) by central differences, Richardson-extrapolated: error O(step^4).
inline VectorX difference(const ForceElement& e, const Scene& s, double h, Memory m, int column, bool velocity,
                          double step) {
  const auto shifted = [&](double d) {
    Scene moved = s;
    BodyKinematics& b = moved.body[column / 6];
    const int axis = column % 3;
    const bool turn = column % 6 >= 3;
    if (velocity) {
      (turn ? b.w_B : b.v_WC)[axis] += d;
    } else if (turn) {
      b.R_WB = b.R_WB * exp_rotation(d * Vector3::Unit(axis));
    } else {
      b.p_WC[axis] += d;
    }
    return forces(e, moved, h, m);
  };
  const VectorX coarse = (shifted(step) - shifted(-step)) / (2.0 * step);
  const VectorX fine = (shifted(0.5 * step) - shifted(-0.5 * step)) / step;
  return (4.0 * fine - coarse) / 3.0;
}

inline void check_blocks(const MatrixX& exact, const MatrixX& differenced, double tolerance, const char* what) {
  // Blocks that are zero, or smaller than the rounding of the others, are held to 1e-9 of the whole.
  const double floor = 1e-9 * std::max(exact.norm(), 1e-300);
  for (int i = 0; i < exact.rows(); i += 3) {
    for (int j = 0; j < exact.cols(); j += 3) {
      const Matrix3 given = exact.block<3, 3>(i, j), wanted = differenced.block<3, 3>(i, j);
      const double error = (given - wanted).norm(), limit = tolerance * wanted.norm() + floor;
      if (error > limit)
        UNSCOPED_INFO(what << " block " << i / 3 << "," << j / 3 << "\n" << given << "\ndifferenced\n" << wanted);
      CHECK(error <= limit);
    }
  }
}

inline void check_derivatives(const ElementCase& c, const ForceElement& e, const Scene& s, Memory m) {
  const int n = 6 * static_cast<int>(s.body.size());
  prepare(e, s, c.time_step, m);
  JacobianSum jacobian(n / 6);
  e.add_jacobian(s.instant(), c.time_step, m, jacobian);
  MatrixX K(n, n), C(n, n);
  for (int j = 0; j < n; ++j) {
    K.col(j) = difference(e, s, c.time_step, m, j, false, c.step);
    C.col(j) = difference(e, s, c.time_step, m, j, true, c.rate_step);
  }
  check_blocks(jacobian.stiffness(), K, c.tolerance, "K");
  check_blocks(jacobian.damping(), C, c.tolerance, "C");
}

/// How the force at the end of a step, and the states it leaves, change with what the step began with: the element's
/// own derivatives along random directions against central differences, where it offers them.
inline void check_history(const ElementCase& c, const ForceElement& e, const Scene& s, Memory m, std::mt19937& random) {
  if (!(c.time_step > 0.0) || !c.smooth_history || !e.has_history()) return;
  constexpr int kDirections = 3;
  const double h = c.time_step;
  const int n = 6 * static_cast<int>(s.body.size()), states = e.state_size();
  const auto any = [&](int rows) {
    MatrixX x(rows, kDirections);
    std::uniform_real_distribution<double> range(-1.0, 1.0);
    for (double& v : x.reshaped()) v = range(random);
    return x;
  };
  const BodyChange from{any(n), any(n)}, to{any(n), any(n)};
  const MatrixX state = any(states);
  const Scene before = s.moved(-h);
  prepare(e, s, h, m);
  const std::vector<double> start(m.state.begin(), m.state.end());
  MatrixX dQ = MatrixX::Zero(n, kDirections), advanced = state;
  if (!e.add_history_tangent(before.instant(), s.instant(), h, m, from, state, dQ)) return;
  REQUIRE(e.advance_state_tangent(before.instant(), s.instant(), h, m, from, to, advanced));

  const auto along = [](const Scene& scene, const BodyChange& change, int j, double by) {
    Scene moved = scene;
    for (std::size_t i = 0; i < moved.body.size(); ++i) {
      BodyKinematics& b = moved.body[i];
      const int r = 6 * static_cast<int>(i);
      b.p_WC += by * change.xi.col(j).segment<3>(r);
      b.R_WB = b.R_WB * exp_rotation(by * change.xi.col(j).segment<3>(r + 3));
      b.v_WC += by * change.u.col(j).segment<3>(r);
      b.w_B += by * change.u.col(j).segment<3>(r + 3);
    }
    return moved;
  };
  for (int j = 0; j < kDirections; ++j) {
    // The force and the states, one above the other, with the beginning of the step moved; the end only for the states.
    const auto at = [&](double by) {
      for (int k = 0; k < states; ++k) m.state[k] = start[k] + by * state(k, j);
      e.begin_step(along(before, from, j, by).instant(), h, m);
      VectorX result(n + states);
      result.head(n) = forces(e, s, h, m);
      e.end_step(along(s, to, j, by).instant(), h, m);
      for (int k = 0; k < states; ++k) result[n + k] = m.state[k];
      return result;
    };
    const auto slope = [&](double step) { return VectorX((at(step) - at(-step)) / (2.0 * step)); };
    const VectorX truth = (4.0 * slope(0.5 * c.step) - slope(c.step)) / 3.0;
    INFO("direction " << j << "\n"
                      << truth.transpose() << "\n"
                      << dQ.col(j).transpose() << " " << advanced.col(j).transpose());
    const VectorX wanted = truth.segment(n, states - c.report_states),
                  given = advanced.col(j).head(states - c.report_states);
    // Rounding of the force's own size over the step, beside the truth's own tolerance.
    const double rounding = 1e-13 * forces(e, s, h, m).norm() / c.step;
    CHECK((truth.head(n) - dQ.col(j)).norm() <= c.tolerance * truth.head(n).norm() + rounding);
    CHECK((wanted - given).norm() <= c.tolerance * (1.0 + wanted.norm()));
  }
  for (int k = 0; k < states; ++k) m.state[k] = start[k];
}

/// Sum of forces and of moments about the world's origin, relative to their sizes.
inline void check_action_reaction(const ElementCase& c, const ForceElement& e, const Scene& s, Memory m) {
  prepare(e, s, c.time_step, m);
  const VectorX Q = forces(e, s, c.time_step, m);
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
  double force_size = 0.0, moment_size = 0.0;
  for (std::size_t i = 0; i < s.body.size(); ++i) {
    const Vector3 F = Q.segment<3>(6 * i);
    const Vector3 M = s.body[i].R_WB * Q.segment<3>(6 * i + 3) + s.body[i].p_WC.cross(F);
    force += F;
    moment += M;
    force_size += F.norm();
    moment_size += M.norm() + s.body[i].p_WC.norm() * F.norm();
  }
  // Rounding of a few dozen operations.
  CHECK(force.norm() <= 1e-13 * force_size);
  CHECK(moment.norm() <= 1e-13 * moment_size);
}

/// Rate of energy + heat = power of the drives - power of the forces on the bodies.
inline void check_power_balance(const ElementCase& c, const ForceElement& e, const Scene& s, Memory m) {
  prepare(e, s, 0.0, m);
  const Instant now = s.instant();
  const double to_bodies = forces(e, s, 0.0, m).dot(s.velocity());
  const double heat = e.dissipated_power(now, m);
  const double given = c.drive_power ? c.drive_power(e, now, m) : 0.0;
  const auto energy = [&](double dt) { return e.potential_energy(s.moved(dt).instant(), m); };
  const double dt = c.energy_time;
  const double coarse = (energy(dt) - energy(-dt)) / (2.0 * dt), fine = (energy(0.5 * dt) - energy(-0.5 * dt)) / dt;
  const double rate = (4.0 * fine - coarse) / 3.0;
  const double size = std::abs(to_bodies) + std::abs(heat) + std::abs(given) + std::abs(rate);
  INFO("energy rate " << rate << " heat " << heat << " to bodies " << to_bodies << " from drives " << given);
  // The energy of a small elongation between points metres apart is known to 1e-13; divided by the short time.
  CHECK(std::abs(rate + heat + to_bodies - given) <= 1e-8 * size + 1e-13 * std::abs(energy(0.0)) / dt);
  CHECK(heat >= 0.0);
}

inline void check_finite(const ForceElement& e, const Scene& s, double h, Memory m) {
  prepare(e, s, h, m);
  const Instant now = s.instant();
  CHECK(forces(e, s, h, m).allFinite());
  JacobianSum jacobian(static_cast<int>(s.body.size()));
  e.add_jacobian(now, h, m, jacobian);
  CHECK(jacobian.stiffness().allFinite());
  CHECK(jacobian.damping().allFinite());
  if (h > 0.0) e.end_step(now, h, m);
  CHECK(std::isfinite(e.potential_energy(now, m)));
  CHECK(e.dissipated_power(now, m) >= 0.0);
  std::vector<double> values(e.channels().size(), std::numeric_limits<double>::quiet_NaN());
  e.measure(now, m, values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    INFO(e.channels()[i].name);
    CHECK(std::isfinite(values[i]));
  }
}

/// Adds rather than sets, leaves its state alone, and gives the same bits when asked again.
inline void check_pure(const ElementCase& c, const ForceElement& e, const Scene& s, Memory m) {
  prepare(e, s, c.time_step, m);
  const std::vector<double> state(m.state.begin(), m.state.end());
  const VectorX once = forces(e, s, c.time_step, m);
  ForceSum sum(static_cast<int>(s.body.size()));
  e.add_forces(s.instant(), c.time_step, m, sum);
  e.add_forces(s.instant(), c.time_step, m, sum);
  CHECK((sum.value() - 2.0 * once).norm() <= 1e-15 * once.norm());  // the order of summation differs
  JacobianSum one(static_cast<int>(s.body.size())), two(static_cast<int>(s.body.size()));
  e.add_jacobian(s.instant(), c.time_step, m, one);
  e.add_jacobian(s.instant(), c.time_step, m, two);
  CHECK(one.stiffness() == two.stiffness());
  CHECK(std::equal(state.begin(), state.end(), m.state.begin()));
}

/// Everything above at several scenes, and finite output at wild ones.
inline void check_force_element(const ElementCase& c, int scenes = 6) {
  INFO(c.name);
  std::mt19937 random(20180401), directions(7);
  const auto next = [&] { return c.scene ? c.scene(random) : general_scene(random, c.bodies, c.drives); };
  for (int i = 0; i < scenes; ++i) {
    const Scene s = next();
    const auto e = c.make(s.instant());
    Store store(*e);
    const Memory m = store.memory();
    prepare(*e, s, c.time_step, m);
    const double size = forces(*e, s, c.time_step, m).norm();
    if (c.loaded) {
      REQUIRE(size > 0.0);
    } else {
      REQUIRE(size == 0.0);
    }
    check_derivatives(c, *e, s, m);
    check_history(c, *e, s, m, directions);
    if (c.between_bodies) check_action_reaction(c, *e, s, m);
    if (c.energy_account) check_power_balance(c, *e, s, m);
    check_pure(c, *e, s, m);
    check_finite(*e, s, c.time_step, m);

    // The same element where it was not made for: anywhere, far away, and with every body at one place.
    for (int k = 0; k < 10; ++k) {
      Scene wild = general_scene(random, c.bodies, c.drives);
      for (BodyKinematics& b : wild.body) {
        b.R_WB = exp_rotation(random_vector(random, 10.0));
        if (k % 3 == 1) b.p_WC *= 1e3;
        if (k % 3 == 2) b = wild.body.front();
      }
      if (k % 2)
        for (DriveState& d : wild.drive) d.position *= 100.0;
      check_finite(*e, wild, c.time_step, m);
    }
  }
}

}  // namespace stillhook::suite
