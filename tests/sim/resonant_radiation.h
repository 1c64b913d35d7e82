// A radiation memory with every property of a hull's and known in closed form: a sum of resonances
//
//   K(t) = sum_r G_r exp(-a t) [cos(v t) - (a/v) sin(v t)],   v^2 = b^2 - a^2
//   K(i w) = sum_r G_r i w/(b^2 - w^2 + 2 i a w)
//
// with G_r symmetric and positive semidefinite: then Re K >= 0 at all frequencies, K(0) = 0, K(t = 0) = sum G_r.
#pragma once

#include <cmath>
#include <vector>

#include "sim/hull/coefficients/coefficients.h"

namespace stillhook {

struct Resonance {
  MatrixX G;
  double a, b;  // rad/s, 0 < a < b
};

struct ResonantRadiation {
  std::vector<Resonance> resonances;

  int modes() const { return static_cast<int>(resonances[0].G.rows()); }
  MatrixX kernel(double t) const {
    MatrixX K = MatrixX::Zero(modes(), modes());
    for (const Resonance& r : resonances) {
      const double v = std::sqrt(r.b * r.b - r.a * r.a);
      K += r.G * (std::exp(-r.a * t) * (std::cos(v * t) - r.a / v * std::sin(v * t)));
    }
    return K;
  }
  MatrixX B(double w) const {
    MatrixX sum = MatrixX::Zero(modes(), modes());
    for (const Resonance& r : resonances) sum += r.G * (2.0 * r.a * w * w / below(r, w));
    return sum;
  }
  /// A(w) - A_inf.
  MatrixX dA(double w) const {
    MatrixX sum = MatrixX::Zero(modes(), modes());
    for (const Resonance& r : resonances) sum += r.G * ((r.b * r.b - w * w) / below(r, w));
    return sum;
  }
  /// Tables at `count` frequencies from `low` to `high` (rad/s), with an A_inf of their own.
  HydrodynamicCoefficients tables(double low, double high, int count) const {
    HydrodynamicCoefficients c;
    c.source = "resonances.csv";
    c.volume.assign(modes() / 6, 2e4);
    c.A_inf = 1e6 * MatrixX::Identity(modes(), modes());
    for (int n = 0; n < count; ++n) {
      const double w = low + (high - low) * n / (count - 1.0);
      c.frequency.push_back({w, c.A_inf + dA(w), B(w)});
    }
    return c;
  }

 private:
  static double below(const Resonance& r, double w) {
    const double d = r.b * r.b - w * w;
    return d * d + 4.0 * r.a * r.a * w * w;
  }
};

/// Surge with pitch, and heave: units as different as a hull's.
inline ResonantRadiation surge_pitch_heave() {
  MatrixX first = MatrixX::Zero(6, 6), second = first, third = first;
  first(0, 0) = 2e6, first(0, 4) = first(4, 0) = 6e7, first(4, 4) = 7e9;
  second(0, 0) = 1e6, second(0, 4) = second(4, 0) = -2e7, second(4, 4) = 3e9;
  first(2, 2) = 2e7;
  third(2, 2) = 9e6;
  return {{{first, 0.31, 0.62}, {second, 0.55, 1.3}, {third, 0.4, 1.1}}};
}

}  // namespace stillhook
