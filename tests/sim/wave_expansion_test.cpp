#include "sim/sea/wave_expansion.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>

#include "sim/hull/hydrostatics.h"

namespace stillhook {
namespace {

std::shared_ptr<const WaveField> sea(double ramp, double height = 2.0, double period = 7.0) {
  SeaStateSpec s;
  s.name = "sea";
  s.type = SeaStateSpec::Type::jonswap;
  s.significant_height = height;
  s.peak_period = period;
  s.components = 40;
  s.directions = 5;
  s.spreading = 4.0;
  s.seed = 3;
  return std::make_shared<const WaveField>(build_wave_field(s, 9.80665, ramp));
}

// Points under and a little above the surface.
struct Points {
  explicit Points(std::size_t n) : x(n), y(n), z(n) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> across(-50.0, 50.0), down(-6.0, 0.3);
    for (std::size_t i = 0; i < n; ++i) x[i] = across(random), y[i] = across(random), z[i] = down(random);
  }
  std::vector<double> x, y, z;
};

struct Field {
  explicit Field(std::size_t n) {
    for (auto& v : value) v.assign(n, 0.0);
  }
  WaveSamples spans() { return {value[0], value[1], value[2], value[3], value[4], value[5], value[6]}; }
  std::vector<double> value[7];
};

double rms(const std::vector<double>& v) {
  return std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0) / static_cast<double>(v.size()));
}

TEST_CASE("the quintic Hermite weights reproduce polynomials of degree five") {
  const double H = 0.4;
  for (int degree = 0; degree <= 5; ++degree)
    for (const double s : {0.0, 0.3, 0.8, 1.0}) {
      const auto [a, b] = quintic_hermite(s, H);
      const auto f = [&](double t) { return std::pow(t, degree); };
      const auto rate = [&](double t) { return degree == 0 ? 0.0 : degree * std::pow(t, degree - 1); };
      const auto curvature = [&](double t) {
        return degree < 2 ? 0.0 : degree * (degree - 1) * std::pow(t, degree - 2);
      };
      const double sum = a.value * f(0) + a.rate * rate(0) + a.curvature * curvature(0) + b.value * f(H) +
                         b.rate * rate(H) + b.curvature * curvature(H);
      CHECK(sum == Approx(f(s * H)).margin(1e-15));  // rounding
    }
}

TEST_CASE("a sea expanded at two instants is the sea between them, near the points") {
  const std::size_t n = 200;
  const Points at(n);
  // While the sea grows and when it has grown.
  for (const double start : {7.0, 41.3}) {
    const auto waves = sea(20.0);
    const WaveExpansion expansion(waves);
    const double H = expansion.interval();
    CHECK(H > 0.2);  // seven times a step of 0.05 s would be 0.35 s: this sea's period is 7 s
    CHECK(H < 1.0);
    std::vector<double> first(kExpansionTerms * n), second(kExpansionTerms * n);
    expansion.expand(start, at.x, at.y, at.z, n, first.data());
    expansion.expand(start + H, at.x, at.y, at.z, n, second.data());
    for (const double share : {0.0, 0.37, 0.5, 0.9, 1.0}) {
      // Displaced by half the reach along each axis, to and fro: up to 0.87 of it in all.
      std::vector<double> d[3];
      Points moved = at;
      for (std::size_t i = 0; i < n; ++i)
        for (int k = 0; k < 3; ++k) {
          const double by = expansion.reach() / 2.0 * ((i >> k) % 2 == 0 ? 1.0 : -1.0);
          d[k].push_back(by);
          (k == 0 ? moved.x : k == 1 ? moved.y : moved.z)[i] += by;
        }
      Field got(n), truth(n);
      const auto [a, b] = quintic_hermite(share, H);
      WaveExpansion::add(first.data(), n, a, d[0], d[1], d[2], true, got.spans());
      WaveExpansion::add(second.data(), n, b, d[0], d[1], d[2], true, got.spans());
      waves->sample(start + share * H, moved.x, moved.y, moved.z, true, truth.spans());
      std::vector<double> elevation(n, 0.0), head(n, 0.0), slope(n, 0.0);
      for (std::size_t i = 0; i < n; ++i) {
        elevation[i] = got.value[0][i] - truth.value[0][i];
        if (moved.z[i] > truth.value[0][i]) continue;  // above the surface the two are continued differently
        head[i] = got.value[3][i] - moved.z[i] - truth.value[3][i];
        for (int k = 0; k < 3; ++k) slope[i] += std::abs(got.value[4 + k][i] - (k == 2) - truth.value[4 + k][i]);
      }
      // Hs 2 m: rms 0.5 m. At the ends the error in time is none and that in space (0.87 k reach)^3 / 6; between them
      // 1e-3 of the rms as promised; a half more for Wheeler's products and the sea's growth. Slopes: the same over the
      // displacement.
      const double grown = 0.5 * waves->ramp(start);
      CHECK(rms(elevation) < 1.5e-3 * grown);
      CHECK(rms(head) < 1.5e-3 * grown);
      CHECK(rms(slope) < 3 * 1.5e-3 * grown / (expansion.reach() / 2.0));
    }
  }
}

// A barge that drifts and rolls, and the element around it.
struct Barge {
  Barge() {
    spec.name = "barge";
    spec.cog = {0.5, 0.0, 0.4};
    spec.hull.shape = HullSpec::Shape::box;
    spec.hull.size = {80.0, 25.0, 5.0};
    sea_spec.density = 1025.0;
    sea_spec.gravity = 9.80665;
    element = build_hydrostatics(spec, 0, sea(0.0), sea_spec);
    state.resize(static_cast<std::size_t>(element->state_size()));
    scratch.resize(static_cast<std::size_t>(element->scratch_size()));
  }
  static BodyKinematics at(double t) {
    BodyKinematics b;
    b.p_WC = {3.0 + 0.4 * std::sin(0.8 * t), -0.3 * t, -0.1 + 0.3 * std::sin(0.7 * t)};
    b.v_WC = {0.32 * std::cos(0.8 * t), -0.3, 0.21 * std::cos(0.7 * t)};
    b.R_WB = exp_rotation(Vector3(0.05 * std::sin(t), 0.0, 0.0));
    b.w_B = {0.05 * std::cos(t), 0.0, 0.0};
    return b;
  }
  Vector6 force(const Instant& now, double h, Memory m) const {
    ForceSum sum(1);
    element->add_forces(now, h, m, sum);
    return sum.value();
  }
  Memory memory() { return {state, scratch}; }
  BodySpec spec;
  SeaSpec sea_spec;
  std::unique_ptr<ForceElement> element;
  std::vector<double> state, scratch;
};

TEST_CASE("a hull on its way through an irregular sea feels the sea as it is") {
  Barge barge;
  REQUIRE(barge.element->state_size() > 0);
  barge.element->start({}, barge.memory());
  const double h = 0.05;
  double worst = 0.0, size = 0.0;
  for (int step = 0; step < 400; ++step) {
    const double t = 20.0 + step * h;
    const std::vector<BodyKinematics> before{Barge::at(t)}, now{Barge::at(t + h)};
    barge.element->begin_step({t, before, {}}, h, barge.memory());
    const Instant instant{t + h, now, {}};
    const Vector6 got = barge.force(instant, h, barge.memory());
    // h = 0 is statics, which sum the components at the vertices; calm water is what the waves add to.
    const Vector6 direct = barge.force(instant, 0.0, barge.memory());
    const double still = 1025.0 * 9.80665 * 80.0 * 25.0;  // N per metre of draft
    worst = std::max(worst, (got - direct).head<3>().cwiseAbs().maxCoeff() / (0.5 * still));
    size = std::max(size, std::abs(direct[2] - direct[0]) / still);
    // A copy of the state with an empty scratch gives the same bits: nothing is remembered but the state.
    if (step % 97 == 5) {
      std::vector<double> blank(barge.scratch.size(), 0.0);
      CHECK(barge.force(instant, h, {barge.state, blank}) == got);
    }
  }
  REQUIRE(size > 0.1);
  // 3e-5 of the rms elevation of 0.5 m as above, three times that at its worst vertex in 400 steps.
  CHECK(worst < 1e-4);
}

TEST_CASE("between two expansions the hull's Jacobian is the derivative of its force") {
  Barge barge;
  barge.element->start({}, barge.memory());
  const double t = 33.0, h = 0.05;
  const std::vector<BodyKinematics> before{Barge::at(t)};
  barge.element->begin_step({t, before, {}}, h, barge.memory());
  std::vector<BodyKinematics> now{Barge::at(t + h)};
  JacobianSum J(1);
  barge.element->add_jacobian({t + h, now, {}}, h, barge.memory(), J);
  Matrix6 numeric;
  for (int i = 0; i < 6; ++i) {
    const double step = i < 3 ? 2e-5 : 5e-7;
    const auto moved = [&](double d) -> Vector6 {
      std::vector<BodyKinematics> there = now;
      const Vector6 xi = d * Vector6::Unit(i);
      there[0].p_WC += xi.head<3>();
      there[0].R_WB = there[0].R_WB * exp_rotation(xi.tail<3>());
      return barge.force({t + h, there, {}}, h, barge.memory());
    };
    const auto central = [&](double d) -> Vector6 { return (moved(d) - moved(-d)) / (2 * d); };
    numeric.col(i) = (4 * central(step / 2) - central(step)) / 3;
  }
  Vector6 unit;
  unit << 1, 1, 1, 1.0 / 80, 1.0 / 80, 1.0 / 80;
  const Matrix6 got = unit.asDiagonal() * J.stiffness() * unit.asDiagonal();
  const Matrix6 want = unit.asDiagonal() * numeric * unit.asDiagonal();
  CHECK((got - want).cwiseAbs().maxCoeff() < 1e-7 * want.cwiseAbs().maxCoeff());  // rounding over the step
}

}  // namespace
}  // namespace stillhook
