// Waves over a flat bed: lengths, speeds and what the water does, against closed forms.
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "sim/error.h"
#include "sim/hull/diffraction.h"
#include "sim/hull/linear_froude_krylov.h"
#include "sim/model.h"
#include "sim/sea/dispersion.h"
#include "sim/sea/wave_field.h"

namespace stillhook {
namespace {

using Real = long double;
constexpr double kG = 9.80665, kTurn = 2.0 * std::numbers::pi;
constexpr double kDeep = std::numeric_limits<double>::infinity();

SeaStateSpec regular_state(double amplitude, double period, double heading = 0.0) {
  SeaStateSpec s;
  s.name = "swell";
  s.type = SeaStateSpec::Type::regular;
  s.amplitude = amplitude;
  s.frequency = kTurn / period;
  s.heading = heading;
  return s;
}

SeaStateSpec storm(double height, int directions) {
  SeaStateSpec s;
  s.name = "storm";
  s.type = SeaStateSpec::Type::jonswap;
  s.significant_height = height;
  s.peak_period = 9.0;
  s.components = 40;
  s.directions = directions;
  s.spreading = directions > 1 ? 4.0 : 0.0;
  s.heading = 0.4;
  return s;
}

TEST_CASE("waves over a bed are as long and as fast as the dispersion relation says") {
  // w^2 = g k tanh kh by bisection in double precision; c_g = (w/2k)(1 + 2kh/sinh 2kh).
  struct Row {
    double period, depth, length, group;
  };
  for (const Row& row :
       {Row{8.0, 30.0, 96.02558194015387, 6.9314084591272165}, Row{10.0, 20.0, 121.20984403916933, 9.271612120563194},
        Row{12.0, 15.0, 135.3255647253044, 9.796119078811008},
        Row{16.0, 12.0, 168.09522349301037, 9.862345474533578}}) {
    const double w = kTurn / row.period, k = wave_number(w, kG, row.depth);
    CHECK(kTurn / k == Approx(row.length).epsilon(1e-12));
    CHECK(group_velocity(w, kG, row.depth) == Approx(row.group).epsilon(1e-12));
    CHECK(wave_frequency(k, kG, row.depth) == Approx(w).epsilon(1e-13));
  }
  // The two ends: shallow water, c = c_g = sqrt(g h) with (kh)^2/6 left out; deep water, the same bits.
  CHECK(group_velocity(0.01, kG, 5.0) == Approx(std::sqrt(kG * 5.0)).epsilon(1e-4));
  CHECK(wave_number(0.7, kG, 1000.0) == 0.7 * 0.7 / kG);
  CHECK(wave_number(0.7, kG, kDeep) == 0.7 * 0.7 / kG);
  CHECK(group_velocity(0.7, kG, kDeep) == Approx(0.5 * kG / 0.7).epsilon(1e-15));
  // Where the deep form takes over nothing jumps: kh = 20.
  const double w = std::sqrt(kG * 20.0 / 50.0);
  CHECK(wave_number(w * (1.0 - 1e-12), kG, 50.0) == Approx(wave_number(w * (1.0 + 1e-12), kG, 50.0)).epsilon(1e-11));
}

TEST_CASE("the water moves as Airy's wave over a bed") {
  // T = 10 s, h = 20 m, per metre of amplitude: horizontal velocity, head and vertical velocity at z. The amplitude is
  // so small that stretching, a shift by zeta, changes them by k a = 5e-12.
  struct Row {
    double z, u, p, w;
  };
  const double a = 1e-10;
  const WaveField field = build_wave_field(regular_state(a, 10.0), kG, 0.0, 20.0);
  REQUIRE_FALSE(field.deep());
  for (const Row& row : {Row{0.0, 0.8090638246206265, 1.0, 0.6283185307179586},
                         Row{-10.0, 0.5797347214981897, 0.7165500469261864, 0.2762105194311073},
                         Row{-20.0, 0.5097058919280624, 0.6299946634829033, 0.0}}) {
    const double quarter = 2.5;  // s before the crest the water rises
    const Vector3 p(0.0, 0.0, row.z);
    CHECK(field.velocity(p, 0.0).x() / a == Approx(row.u).epsilon(1e-9));
    CHECK(field.velocity(p, 10.0 - quarter).z() / a == Approx(row.w).epsilon(1e-9).margin(1e-15));
    const double omega = kTurn / 10.0;
    CHECK(field.acceleration(p, 10.0 - quarter).x() / a == Approx(omega * row.u).epsilon(1e-9));
    CHECK(field.acceleration(p, 0.0).z() / a == Approx(-omega * row.w).epsilon(1e-9).margin(1e-15));
    double elevation = 0.0, head = 0.0;
    const double x = 0.0, y = 0.0;
    const double z = row.z - 1e-6;  // under the surface; the profile there is flat to 1e-7
    WaveSamples out{{&elevation, 1}, {}, {}, {&head, 1}, {}, {}, {}};
    field.sample(0.0, {&x, 1}, {&y, 1}, {&z, 1}, false, out);
    // The still pressure, 20 m, is lost to rounding: 4e-15 of it over a.
    CHECK((head + z) / a == Approx(row.p).epsilon(1e-4));
  }
}

TEST_CASE("Wheeler's stretching leaves the bed at the bed and the pressure zero at the surface") {
  const WaveField field = build_wave_field(regular_state(2.0, 10.0), kG, 0.0, 20.0);
  const double k = wave_number(kTurn / 10.0, kG, 20.0);
  for (const double t : {0.0, 1.7, 5.0}) {
    const double zeta = field.elevation(0.0, 0.0, t);
    // At the bed the value of the linear wave there, whatever the surface does: horizontal velocity a w / sinh kh.
    const Vector3 bed = field.velocity({0.0, 0.0, -20.0}, t);
    CHECK(bed.x() == Approx(zeta * kTurn / 10.0 / std::sinh(k * 20.0)).epsilon(1e-12));
    CHECK(std::abs(bed.z()) < 1e-14);
    // At the surface that of z = 0, and above it the same.
    const Vector3 top = field.velocity({0.0, 0.0, zeta}, t);
    CHECK(top.x() == Approx(zeta * kTurn / 10.0 / std::tanh(k * 20.0)).epsilon(1e-12));
    CHECK(field.velocity({0.0, 0.0, zeta + 3.0}, t) == top);
    // Vertical stretching: the profile under z = 0 unstretched, that of z = 0 above it.
    CHECK(field.velocity({0.0, 0.0, 1.0}, t, Stretching::vertical).x() == Approx(top.x()).epsilon(1e-12));
    CHECK(field.velocity({0.0, 0.0, -10.0}, t, Stretching::vertical).x() ==
          Approx(zeta * kTurn / 10.0 * std::cosh(k * 10.0) / std::sinh(k * 20.0)).epsilon(1e-12));
    double elevation = 0.0, head = 1.0;
    const double x = 0.0, y = 0.0;
    for (const double z : {zeta, zeta - 1e-9, -20.0}) {
      WaveSamples out{{&elevation, 1}, {}, {}, {&head, 1}, {}, {}, {}};
      field.sample(t, {&x, 1}, {&y, 1}, {&z, 1}, false, out);
      const double dynamic = z == -20.0 ? zeta / std::cosh(k * 20.0) : zeta;
      CHECK(head == Approx(dynamic - z).margin(1e-9));
    }
  }
}

TEST_CASE("the water over a bed is incompressible, free of rotation and pushed by its pressure") {
  const WaveField field = build_wave_field(storm(1e-4, 5), kG, 30.0, 9.0);
  REQUIRE_FALSE(field.deep());
  for (const Vector3& p : {Vector3(12.0, -31.0, -3.0), Vector3(-40.0, 8.0, -8.5)}) {
    const double t = 77.0, h = 1e-2;
    Matrix3 slope;  // of velocity i along j; Richardson's central differences: (k h)^4 / 30, rounding 1e-16 / h
    for (int j = 0; j < 3; ++j) {
      const auto central = [&](double d) -> Vector3 {
        return (field.velocity(p + d * Vector3::Unit(j), t, Stretching::vertical) -
                field.velocity(p - d * Vector3::Unit(j), t, Stretching::vertical)) /
               (2.0 * d);
      };
      slope.col(j) = (4.0 * central(h / 2) - central(h)) / 3.0;
    }
    const double scale = slope.cwiseAbs().maxCoeff();
    CHECK(std::abs(slope.trace()) < 1e-6 * scale);
    CHECK((slope - slope.transpose()).cwiseAbs().maxCoeff() < 1e-6 * scale);
    // Euler's equation, linear: dv/dt = -g grad(dynamic head). Stretching changes the head by k zeta ~ 1e-5, relative.
    std::vector<double> value[7];
    for (auto& v : value) v.resize(1);
    const std::vector<double> x{p.x()}, y{p.y()}, z{p.z()};
    field.sample(t, x, y, z, true, {value[0], value[1], value[2], value[3], value[4], value[5], value[6]});
    const Vector3 push(value[4][0], value[5][0], value[6][0] + 1.0), a = field.acceleration(p, t);
    CHECK((a + kG * push).norm() < 1e-4 * a.norm());
  }
  // In the ramp, too, acceleration is the rate of velocity.
  const Vector3 p(3.0, 4.0, -2.0);
  const auto rate = [&](double d) -> Vector3 {
    return (field.velocity(p, 11.0 + d, Stretching::vertical) - field.velocity(p, 11.0 - d, Stretching::vertical)) /
           (2.0 * d);
  };
  const Vector3 differences = (4.0 * rate(5e-3) - rate(1e-2)) / 3.0;
  CHECK((field.acceleration(p, 11.0, Stretching::vertical) - differences).norm() < 1e-8 * differences.norm());
}

TEST_CASE("over a bed the vector kernel agrees with scalar long double, gradients too") {
  const double depth = 11.0, t = 345.6;
  const WaveField field = build_wave_field(storm(2.5, 7), kG, 0.0, depth);
  const auto zeta_at = [&](Real x, Real y) {
    Real sum = 0;
    for (const WaveComponent& c : field.components())
      sum += c.amplitude *
             std::cos(Real(c.wavenumber) * (x * c.cos_heading + y * c.sin_heading) - Real(c.frequency) * t + c.phase);
    return sum;
  };
  const auto head_at = [&](Real x, Real y, Real z) {
    const Real zeta = zeta_at(x, y), s = depth * (z - zeta) / (depth + zeta);
    Real sum = -z;
    for (const WaveComponent& c : field.components()) {
      const Real k = c.wavenumber;
      sum += c.amplitude * std::cosh(k * (s + depth)) / std::cosh(k * depth) *
             std::cos(k * (x * c.cos_heading + y * c.sin_heading) - Real(c.frequency) * t + c.phase);
    }
    return sum;
  };
  std::vector<double> x, y, z, value[7];
  for (int i = 0; i < 53; ++i) {
    x.push_back(-60.0 + 2.3 * i);
    y.push_back(25.0 * std::sin(1.7 * i));
    z.push_back(-10.9 + 0.16 * i);
  }
  for (auto& v : value) v.resize(x.size());
  field.sample(t, x, y, z, true, {value[0], value[1], value[2], value[3], value[4], value[5], value[6]});
  int below = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (z[i] > value[0][i] - 0.01) continue;  // the kink at the surface; above it nothing is new
    ++below;
    // 2.5 m of waves in 280 components: 30 m of amplitudes, phases of 1000 rad, each 1e-13 off.
    CHECK(std::abs(value[3][i] - double(head_at(x[i], y[i], z[i]))) < 1e-11);
    const Real h = 1e-3L;
    const auto slope = [&](auto f) {
      const auto central = [&](Real d) { return (f(d) - f(-d)) / (2 * d); };
      return double((4 * central(h / 2) - central(h)) / 3);
    };
    CHECK(value[4][i] == Approx(slope([&](Real d) { return head_at(x[i] + d, y[i], z[i]); })).margin(1e-10));
    CHECK(value[5][i] == Approx(slope([&](Real d) { return head_at(x[i], y[i] + d, z[i]); })).margin(1e-10));
    CHECK(value[6][i] == Approx(slope([&](Real d) { return head_at(x[i], y[i], z[i] + d); })).margin(1e-10));
  }
  CHECK(below > 30);
}

TEST_CASE("a sea none of whose waves feels the bed is the sea of deep water, bit by bit") {
  const SeaStateSpec s = storm(2.0, 5);
  const WaveField deep = build_wave_field(s, kG, 20.0), over = build_wave_field(s, kG, 20.0, 1000.0);
  CHECK(over.deep());
  CHECK(deep == over);
  CHECK_FALSE(build_wave_field(s, kG, 20.0, 30.0).deep());
}

/// A vertical cylinder of radius a from the bed to above the water, 4 m panels in height.
Mesh pile(double radius, double depth) {
  constexpr int kSides = 96;
  // Of the same area as the circle.
  const double r = radius * std::sqrt(kTurn / kSides / std::sin(kTurn / kSides));
  const int rows = static_cast<int>(std::ceil(depth)) + 2;
  Mesh mesh;
  for (int i = 0; i <= rows; ++i)
    for (int s = 0; s < kSides; ++s) {
      const double angle = kTurn * s / kSides;
      mesh.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), -depth + (depth + 1.0) * i / rows);
    }
  for (int i = 0; i < rows; ++i)
    for (int s = 0; s < kSides; ++s) {
      const int a = i * kSides + s, b = i * kSides + (s + 1) % kSides;
      mesh.triangles.push_back({a, b, b + kSides});
      mesh.triangles.push_back({a, b + kSides, a + kSides});
    }
  for (int s = 2; s < kSides; ++s) {
    mesh.triangles.push_back({0, s, s - 1});
    mesh.triangles.push_back({rows * kSides, rows * kSides + s - 1, rows * kSides + s});
  }
  return mesh;
}

TEST_CASE("the force on a slender pile is that of MacCamy and Fuchs") {
  // |F| / (rho g pi a^2 tanh kh) and its lag, from their closed form (1954); the Froude-Krylov force is half of it
  // where Cm = 2. Their theory has 0.4 % more at ka = 0.05 and 1.1 % at 0.1, for the wave that the pile throws back.
  const double depth = 20.0, rho = 1025.0;
  struct Row {
    double ka, cm, tolerance;
  };
  for (const Row& row : {Row{0.05, 2.00654, 0.01}, Row{0.1, 2.01918, 0.02}}) {
    const double k = 0.1, radius = row.ka / k, w = wave_frequency(k, kG, depth);
    const LinearFroudeKrylov fk(pile(radius, depth), 0.0, rho, kG, depth);
    const std::complex<double> F = 2.0 * fk.excitation(w, 0.0)[0];
    const double unit = rho * kG * std::numbers::pi * radius * radius * std::tanh(k * depth);
    CHECK(std::abs(F) / unit == Approx(row.cm).epsilon(row.tolerance));
    // The force leads the crest by a quarter period.
    CHECK(std::arg(F) == Approx(-std::numbers::pi / 2).margin(0.01));
    // The same pile in deep water has another force: exp(kz) to z = -20 m.
    const LinearFroudeKrylov deep(pile(radius, depth), 0.0, rho, kG);
    CHECK(std::abs(deep.excitation(std::sqrt(kG * k), 0.0)[0]) * 2.0 / unit < 0.95 * row.cm);
  }
}

std::string refusal(const SeaStateSpec& s, double depth) {
  try {
    build_wave_field(s, kG, 10.0, depth);
  } catch (const SpecificationError& error) {
    return error.what();
  }
  return "";
}

TEST_CASE("seas that the depth cannot carry are refused") {
  using Catch::Matchers::Contains;
  // 0.78 of 5 m: 3.9 m high; T = 12 s, 81 m long: not too steep.
  CHECK(refusal(regular_state(1.9, 12.0), 5.0).empty());
  CHECK_THAT(refusal(regular_state(2.0, 12.0), 5.0),
             Contains("sea.states.swell.amplitude: the wave would break: it is 4 m"));
  // T = 5 s in 3 m: 24.9 m long, kh = 0.757, tanh 0.639: at most 2.27 m by steepness, 2.34 m by depth.
  CHECK(refusal(regular_state(1.1, 5.0), 3.0).empty());
  CHECK_THAT(refusal(regular_state(1.15, 5.0), 3.0), Contains("1/7 tanh kh"));
  CHECK(refusal(regular_state(1.15, 5.0), kDeep).empty());
  CHECK(refusal(storm(3.9, 1), 8.0).empty());
  CHECK_THAT(refusal(storm(4.1, 1), 8.0), Contains("significant height of 4.1 m in 8 m of water"));
  CHECK_THAT(refusal(storm(1.0, 1), -2.0), Contains("sea.depth: must be > 0 m"));
}

TEST_CASE("a hull or a body under the sea bed is refused") {
  using Catch::Matchers::Contains;
  Specification spec;
  spec.name = "stranded";
  spec.sea.depth = 12.0;
  spec.solver.static_start = false;
  BodySpec body;
  body.name = "block";
  body.mass = 1e5;
  body.inertia = 1e6 * Matrix3::Identity();
  body.position = {0.0, 0.0, -12.4};  // settled in
  spec.bodies.push_back(body);
  CHECK_NOTHROW(build_model(spec));
  spec.bodies[0].position.z() = -12.6;
  CHECK_THROWS_WITH(build_model(spec), Contains("bodies.block.position: lies 0.6 m below the sea bed"));
  spec.bodies[0].position.z() = -10.0;
  spec.bodies[0].hull.shape = HullSpec::Shape::box;
  spec.bodies[0].hull.size = {10.0, 6.0, 8.0};
  CHECK_THROWS_WITH(build_model(spec), Contains("bodies.block.position: lies 2 m below the sea bed"));
  spec.sea.depth = 0.0;
  CHECK_NOTHROW(build_model(spec));
}

}  // namespace
}  // namespace stillhook
