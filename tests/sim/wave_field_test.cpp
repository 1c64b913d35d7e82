#include "sim/body_spec.h"

#include "sim/sea/wave_field.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

namespace stillhook {
namespace {

using Real = long double;

// The equations of wave_field.h, written out in long double with the scalar functions of the C library.
struct Truth {
  const std::vector<WaveComponent>& waves;
  Real ramp;
  Real elevation(Real x, Real y, Real t) const {
    Real sum = 0;
    for (const auto& c : waves) {
      const Real k = c.wavenumber;
      sum += c.amplitude * std::cos(k * (x * c.cos_heading + y * c.sin_heading) - Real(c.frequency) * t + c.phase);
    }
    return ramp * sum;
  }
  Real head(Real x, Real y, Real z, Real t) const {
    const Real zeta = elevation(x, y, t);
    if (z > zeta) return zeta - z;
    Real sum = 0;
    for (const auto& c : waves) {
      const Real k = c.wavenumber;
      sum += c.amplitude * std::exp(k * (z - zeta)) *
             std::cos(k * (x * c.cos_heading + y * c.sin_heading) - Real(c.frequency) * t + c.phase);
    }
    return ramp * sum - z;
  }
};

struct Sampled {
  explicit Sampled(std::size_t n) {
    for (auto& v : value) v.resize(n);
  }
  WaveSamples spans() { return {value[0], value[1], value[2], value[3], value[4], value[5], value[6]}; }
  std::vector<double> value[7];
};

SeaStateSpec regular(double amplitude, double frequency, double heading, double phase) {
  SeaStateSpec s;
  s.name = "swell";
  s.type = SeaStateSpec::Type::regular;
  s.amplitude = amplitude;
  s.frequency = frequency;
  s.heading = heading;
  s.phase = phase;
  return s;
}

SeaStateSpec irregular(int components, int directions) {
  SeaStateSpec s;
  s.name = "sea";
  s.type = SeaStateSpec::Type::jonswap;
  s.significant_height = 3.0;
  s.peak_period = 9.0;
  s.components = components;
  s.directions = directions;
  s.spreading = directions > 1 ? 4.0 : 0.0;
  s.heading = -0.6;
  return s;
}

// Points of a hull's size, some above the water; 53 does not fill whole blocks of the kernel.
struct Points {
  Points() {
    for (int i = 0; i < 53; ++i) {
      x.push_back(-60.0 + 2.3 * i);
      y.push_back(25.0 * std::sin(1.7 * i));
      z.push_back(-8.0 + 0.21 * i);
    }
  }
  std::vector<double> x, y, z;
};

TEST_CASE("vector kernel agrees with scalar long double") {
  const Points p;
  for (const auto& spec : {regular(1.3, 0.7, 0.8, 0.4), irregular(60, 1), irregular(40, 7)}) {
    const WaveField field = build_wave_field(spec, 9.81, 20.0);
    double total = 0.0;
    for (const auto& c : field.components()) total += c.amplitude;
    for (const double t : {7.0, 345.6, 1886.0}) {
      Sampled s(p.x.size());
      field.sample(t, p.x, p.y, p.z, true, s.spans());
      const Truth truth{field.components(), field.ramp(t)};
      for (std::size_t i = 0; i < p.x.size(); ++i) {
        // Four units in the last place of each term (libmvec's bound) and the rounding of phases up to w t = 6000 rad,
        // which the product w t carries in double: 6000 * 1e-16 = 1e-12 of each term at worst.
        const double tolerance = total * (1e-14 + 2.3e-16 * 4.0 * t);
        CHECK(std::abs(s.value[0][i] - double(truth.elevation(p.x[i], p.y[i], t))) < tolerance);
        CHECK(std::abs(s.value[3][i] - double(truth.head(p.x[i], p.y[i], p.z[i], t))) < tolerance + 1e-14);
        CHECK(field.elevation(p.x[i], p.y[i], t) == Approx(s.value[0][i]).margin(1e-13 * total));
      }
    }
  }
}

TEST_CASE("gradients of elevation and head are exact") {
  const Points p;
  const double t = 63.0, h = 1e-3;
  for (const auto& spec : {regular(1.3, 0.7, 0.8, 0.4), irregular(40, 7)}) {
    const WaveField field = build_wave_field(spec, 9.81, 100.0);  // inside the ramp
    Sampled s(p.x.size());
    field.sample(t, p.x, p.y, p.z, true, s.spans());
    const Truth truth{field.components(), field.ramp(t)};
    int above = 0;
    for (std::size_t i = 0; i < p.x.size(); ++i) {
      const Real x = p.x[i], y = p.y[i], z = p.z[i];
      // Richardson-extrapolated central differences in long double: error k^5 h^4/30 ~ 1e-13, rounding 1e-19/1e-3.
      const auto slope = [&](auto f) {
        const auto central = [&](Real d) { return (f(d) - f(-d)) / (2 * d); };
        return double((4 * central(h / 2) - central(h)) / 3);
      };
      const double tolerance = 1e-11;  // and the phase error of the test above
      CHECK(s.value[1][i] == Approx(slope([&](Real d) { return truth.elevation(x + d, y, t); })).margin(tolerance));
      CHECK(s.value[2][i] == Approx(slope([&](Real d) { return truth.elevation(x, y + d, t); })).margin(tolerance));
      const double gap = p.z[i] - s.value[0][i];
      above += gap > 0.0;
      if (std::abs(gap) < 0.01) continue;  // the kink at the surface
      CHECK(s.value[4][i] == Approx(slope([&](Real d) { return truth.head(x + d, y, z, t); })).margin(tolerance));
      CHECK(s.value[5][i] == Approx(slope([&](Real d) { return truth.head(x, y + d, z, t); })).margin(tolerance));
      CHECK(s.value[6][i] == Approx(slope([&](Real d) { return truth.head(x, y, z + d, t); })).margin(tolerance));
    }
    CHECK(above > 5);
    CHECK(above < 45);
  }
}

TEST_CASE("a crest starts at its lag and travels towards its heading") {
  const double heading = 2.0, frequency = 0.6, lag = 1.1, amplitude = 0.8;
  const WaveField field = build_wave_field(regular(amplitude, frequency, heading, lag), 9.81, 0.0);
  const double t = lag / frequency, k = frequency * frequency / 9.81;
  CHECK(field.elevation(0.0, 0.0, t) == Approx(amplitude).epsilon(1e-14));
  const double speed = frequency / k, later = t + 3.0;
  CHECK(field.elevation(3.0 * speed * std::cos(heading), 3.0 * speed * std::sin(heading), later) ==
        Approx(amplitude).epsilon(1e-12));
  CHECK(field.elevation(-3.0 * speed * std::cos(heading), -3.0 * speed * std::sin(heading), later) < 0.0);
  // Under a crest the water moves with the wave; a quarter period before it, it rises.
  const Vector3 with(std::cos(heading), std::sin(heading), 0.0);
  CHECK(field.velocity({0.0, 0.0, amplitude}, t).dot(with) == Approx(amplitude * frequency).epsilon(1e-13));
  CHECK(field.velocity(Vector3::Zero(), t + 1.5 * std::numbers::pi / frequency).z() ==
        Approx(amplitude * frequency).epsilon(1e-13));
}

TEST_CASE("velocity is divergence-free, accelerated by the pressure and cut off at the still surface") {
  SeaStateSpec low = irregular(30, 5);
  low.significant_height = 1e-4;  // so small that stretching does not matter to the pressure
  const WaveField field = build_wave_field(low, 9.81, 0.0);
  const Vector3 p(12.0, -31.0, -3.0);
  const double t = 77.0, h = 1e-3;
  const auto at = [&](int axis, double d) { return field.velocity(p + d * Vector3::Unit(axis), t, Stretching::vertical); };
  double divergence = 0.0, scale = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double slope = (at(i, h)[i] - at(i, -h)[i]) / (2.0 * h);
    divergence += slope;
    scale = std::max(scale, std::abs(slope));
  }
  CHECK(std::abs(divergence) < 1e-5 * scale);  // central differences: (k h)^2, and rounding 1e-16/1e-3 of the velocity
  // Euler's equation, linear: dv/dt = -g grad(dynamic head).
  Sampled s(1);
  const std::vector<double> x{p.x()}, y{p.y()}, z{p.z()};
  field.sample(t, x, y, z, true, s.spans());
  const Vector3 acceleration = field.acceleration(p, t, Stretching::vertical);
  const Vector3 rate = (field.velocity(p, t + h, Stretching::vertical) - field.velocity(p, t - h, Stretching::vertical)) /
                       (2.0 * h);
  CHECK((acceleration - rate).norm() < 1e-6 * rate.norm());  // (w h)^2 / 6 of differences
  const Vector3 gradient(s.value[4][0], s.value[5][0], s.value[6][0] + 1.0);
  // Stretching changes the head by k zeta ~ 1e-4 * 0.2, relative.
  CHECK((acceleration + 9.81 * gradient).norm() < 1e-4 * acceleration.norm());
  CHECK(field.velocity({1.0, 2.0, 5.0}, t, Stretching::vertical) ==
        field.velocity({1.0, 2.0, 0.0}, t, Stretching::vertical));
}

TEST_CASE("the ramp rises from nothing to one with continuous curvature") {
  const WaveField field = build_wave_field(regular(1.0, 0.5, 0.0, 0.0), 9.81, 30.0);
  CHECK(field.ramp(-1.0) == 0.0);
  CHECK(field.ramp(0.0) == 0.0);
  CHECK(field.ramp(15.0) == Approx(0.5).epsilon(1e-14));
  CHECK(field.ramp(30.0) == 1.0);
  CHECK(field.ramp(1e4) == 1.0);
  // 10 s^3 - ...: value and two derivatives vanish at the ends, so at s = 1e-3 it is 1e-8.
  CHECK(field.ramp(0.03) < 1.1e-8);
  CHECK(1.0 - field.ramp(29.97) < 1.1e-8);
  for (double t = 0.0; t < 30.0; t += 0.5) CHECK(field.ramp(t + 0.5) > field.ramp(t));
}

TEST_CASE("a point's value does not depend on its neighbours, calm water is still") {
  const Points p;
  const WaveField field = build_wave_field(irregular(25, 1), 9.81, 0.0);
  Sampled all(p.x.size()), one(1);
  field.sample(50.0, p.x, p.y, p.z, true, all.spans());
  for (const std::size_t i : {0, 17, 52}) {
    const std::vector<double> x{p.x[i]}, y{p.y[i]}, z{p.z[i]};
    field.sample(50.0, x, y, z, true, one.spans());
    for (int q = 0; q < 7; ++q) CHECK(one.value[q][0] == all.value[q][i]);
  }
  // Elevation alone, without head.
  Sampled bare(p.x.size());
  WaveSamples wanted = bare.spans();
  wanted.head = {};
  field.sample(50.0, p.x, p.y, p.z, true, wanted);
  CHECK(bare.value[0] == all.value[0]);
  CHECK(bare.value[1] == all.value[1]);

  for (const WaveField& still : {WaveField(), build_wave_field(regular(1.0, 0.5, 0.0, 0.0), 9.81, 30.0)}) {
    still.sample(0.0, p.x, p.y, p.z, true, all.spans());
    for (std::size_t i = 0; i < p.x.size(); ++i) {
      CHECK(all.value[0][i] == 0.0);
      CHECK(all.value[3][i] == -p.z[i]);
      CHECK(all.value[6][i] == -1.0);
    }
  }
}

}  // namespace
}  // namespace stillhook
