// A mass that moves along one line under one force element and gravity: Runge-Kutta 4, for tests of element laws
// without the project's own integrator.
#pragma once

#include <functional>
#include <vector>

#include "sim/multibody/force_element.h"

namespace stillhook {

struct VerticalMass {
  const ForceElement& element;
  double mass = 1.0;        // kg
  double gravity = 0.0;     // m/s2
  double z = 0.0, v = 0.0;  // m, m/s
  double heat = 0.0;        // J, integral of the dissipated power
  double t = 0.0;           // s

  std::vector<BodyKinematics> body = std::vector<BodyKinematics>(1);

  Instant at(double z_, double v_) {
    body[0].p_WC.z() = z_;
    body[0].v_WC.z() = v_;
    return {t, body, {}};
  }
  double force(double z_, double v_) {
    ForceSum sum(1);
    element.add_forces(at(z_, v_), 0.0, {}, sum);
    return sum.value()[2];
  }
  double energy() { return 0.5 * mass * v * v + mass * gravity * z + element.potential_energy(at(z, v), {}); }
  void step(double h) {
    const auto slope = [&](double z_, double v_) {
      return Vector3(v_, force(z_, v_) / mass - gravity, element.dissipated_power(at(z_, v_), {}));
    };
    const Vector3 y(z, v, heat);
    const Vector3 k1 = slope(y[0], y[1]);
    const Vector3 y2 = y + 0.5 * h * k1, k2 = slope(y2[0], y2[1]);
    const Vector3 y3 = y + 0.5 * h * k2, k3 = slope(y3[0], y3[1]);
    const Vector3 y4 = y + h * k3, k4 = slope(y4[0], y4[1]);
    const Vector3 next = y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    z = next[0], v = next[1], heat = next[2];
    t += h;
  }
};

/// Damping ratio from the logarithmic decrement between the first and the n-th maximum of z above its mean.
inline double decay_ratio(VerticalMass& m, double rest, double h, int cycles) {
  std::vector<double> maxima;
  double before = m.v;
  while (static_cast<int>(maxima.size()) <= cycles) {
    const double z = m.z;
    m.step(h);
    if (before > 0.0 && m.v <= 0.0) maxima.push_back(std::max(z, m.z) - rest);
    before = m.v;
  }
  const double decrement = std::log(maxima.front() / maxima.back()) / cycles;
  return decrement / std::hypot(decrement, 2.0 * M_PI);
}

}  // namespace stillhook
