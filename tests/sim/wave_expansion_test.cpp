#include "sim/body_spec.h"

#include "sim/sea/wave_expansion.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "sim/hull/hydrostatics.h"

namespace stillhook {
namespace {

constexpr double kDeep = std::numeric_limits<double>::infinity();

std::shared_ptr<const WaveField> sea(double ramp, double depth = kDeep) {
  SeaStateSpec s;
  s.name = "sea";
  s.type = SeaStateSpec::Type::jonswap;
  s.significant_height = 2.0;
  s.peak_period = 7.0;
  s.components = 40;
  s.directions = 5;
  s.spreading = 4.0;
  s.seed = 3;
  return std::make_shared<const WaveField>(build_wave_field(s, 9.80665, ramp, depth));
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

TEST_CASE("the Hermite weights of three instants reproduce polynomials of degree eight") {
  const double H = 0.4;
  for (int degree = 0; degree <= 8; ++degree)
    for (const double s : {0.0, 0.3, 0.8, 1.0}) {
      const auto weights = hermite_weights(s, H);
      const auto f = [&](double t) { return std::pow(t, degree); };
      const auto rate = [&](double t) { return degree == 0 ? 0.0 : degree * std::pow(t, degree - 1); };
      const auto curvature = [&](double t) {
        return degree < 2 ? 0.0 : degree * (degree - 1) * std::pow(t, degree - 2);
      };
      double sum = 0.0;
      for (int i = 0; i < 3; ++i) {
        const double t = (i - 1) * H;
        sum += weights[i].value * f(t) + weights[i].rate * rate(t) + weights[i].curvature * curvature(t);
      }
      CHECK(sum == Approx(f(s * H)).margin(1e-15));  // rounding
    }
}

TEST_CASE("a sea expanded at three instants is the sea between them, near the points") {
  const std::size_t n = 200;
  const Points at(n);
  const double depth = GENERATE(0, 12) == 0 ? kDeep : 12.0;
  CAPTURE(depth);
  // While the sea grows and when it has grown.
  for (const double start : {7.0, 41.3}) {
    const auto waves = sea(20.0, depth);
    CHECK(waves->deep() == (depth == kDeep));
    const WaveExpansion expansion(waves);
    const double H = expansion.interval();
    CHECK(H > 0.4);  // eight steps of 0.05 s: this sea's period is 7 s
    CHECK(H < 1.0);
    std::vector<double> terms[3];
    for (int i = 0; i < 3; ++i) {
      terms[i].resize(kExpansionTerms * n);
      expansion.expand(start + (i - 1) * H, at.x, at.y, at.z, n, terms[i].data());
    }
    for (const double far : {0.0, 0.5})
      for (const double share : {0.0, 0.37, 0.6, 0.9, 1.0}) {
        // Displaced by half the reach along each axis, to and fro: up to 0.87 of it in all.
        const double by = far * expansion.reach();
        std::vector<double> d[3];
        Points moved = at;
        for (std::size_t i = 0; i < n; ++i)
          for (int k = 0; k < 3; ++k) {
            const double step = by * ((i >> k) % 2 == 0 ? 1.0 : -1.0);
            d[k].push_back(step);
            (k == 0 ? moved.x : k == 1 ? moved.y : moved.z)[i] += step;
          }
        Field got(n), truth(n);
        const auto weights = hermite_weights(share, H);
        for (int i = 0; i < 3; ++i) WaveExpansion::add(terms[i].data(), n, weights[i], d[0], d[1], d[2], got.spans());
        waves->sample(start + share * H, moved.x, moved.y, moved.z, true, truth.spans());
        std::vector<double> elevation(n, 0.0), head(n, 0.0), slope(n, 0.0);
        for (std::size_t i = 0; i < n; ++i) {
          elevation[i] = got.value[0][i] - truth.value[0][i];
          if (moved.z[i] > truth.value[0][i]) continue;  // above the surface the two are continued differently
          head[i] = got.value[3][i] - moved.z[i] - truth.value[3][i];
          for (int k = 0; k < 3; ++k) slope[i] += std::abs(got.value[4 + k][i] - (k == 2) - truth.value[4 + k][i]);
        }
        // Hs 2 m: rms 0.5 m.
        const double grown = 0.5 * waves->ramp(start);
        if (far == 0.0) {
          // As promised in time, and ten times as much for the products in Wheeler's head, whose frequencies add up.
          CHECK(rms(elevation) < 1.5e-6 * grown);
          CHECK(rms(head) < 1.5e-5 * grown);
          continue;
        }
        // In space 1e-3 of the rms as promised, a half more for Wheeler's products and the sea's growth. Slopes: the
        // same over the displacement.
        CHECK(rms(elevation) < 1.5e-3 * grown);
        CHECK(rms(head) < 1.5e-3 * grown);
        CHECK(rms(slope) < 3 * 1.5e-3 * grown / by);
      }
  }
}

// A barge that drifts and rolls, and the element around it.
struct Barge {
  explicit Barge(std::shared_ptr<const WaveField> waves = sea(0.0)) {
    spec.name = "barge";
    spec.cog = {0.5, 0.0, 0.4};
    spec.hull.shape = HullSpec::Shape::box;
    spec.hull.size = {80.0, 25.0, 5.0};
    sea_spec.density = 1025.0;
    sea_spec.gravity = 9.80665;
    element = build_hydrostatics(spec, 0, std::move(waves), sea_spec);
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

// Adrift: 30 m in 100 s, turning by 30 deg, in its own waves' motion.
BodyKinematics adrift(double t) {
  BodyKinematics b = Barge::at(t);
  b.p_WC.x() += 0.3 * t;
  b.v_WC.x() += 0.3;
  const double rate = 0.3 / 180.0 * 3.14159265358979323846;  // rad/s
  const Matrix3 turn = exp_rotation(Vector3(0.0, 0.0, rate * t));
  b.w_B += b.R_WB.transpose() * Vector3(0.0, 0.0, rate);
  b.R_WB = turn * b.R_WB;
  return b;
}

std::shared_ptr<const WaveField> regular_wave() {
  SeaStateSpec s;
  s.name = "regular";
  s.type = SeaStateSpec::Type::regular;
  s.amplitude = 1.0;
  s.frequency = 0.9;
  s.heading = 0.7;
  return std::make_shared<const WaveField>(build_wave_field(s, 9.80665, 0.0));
}

TEST_CASE("a hull on its way through a sea feels the sea as it is") {
  struct Way {
    const char* name;
    std::shared_ptr<const WaveField> waves;
    BodyKinematics (*at)(double);
    double bound;
  };
  // Forces are compared with half a metre of water on the deck, the rms elevation, moments with that on an arm of half
  // the length. Irregular: 1e-5 in time, as much for the hull's displacement from where the series stand; twice the
  // sum. Regular: the step's linearity alone, (k d)^2 / 2 with k = 0.083 1/m and d < 3 mm.
  const Way ways[] = {{"irregular, at its place", sea(0.0), Barge::at, 4e-5},
                      {"irregular, adrift", sea(0.0), adrift, 4e-5},
                      {"irregular over a bed, adrift", sea(0.0, 12.0), adrift, 4e-5},
                      {"regular, adrift", regular_wave(), adrift, 5e-8}};
  for (const Way& way : ways) {
    INFO(way.name);
    Barge barge(way.waves);
    REQUIRE(barge.element->state_size() > 0);
    barge.element->start({}, barge.memory());
    const double h = 0.05;
    double worst = 0.0, size = 0.0;
    std::vector<double> other(barge.scratch.size());
    for (int step = 0; step < 2000; ++step) {
      const double t = step * h;
      const std::vector<BodyKinematics> before{way.at(t)}, now{way.at(t + h)};
      barge.element->begin_step({t, before, {}}, h, barge.memory());
      const Instant instant{t + h, now, {}};
      const Vector6 got = barge.force(instant, h, barge.memory());
      const double still = 1025.0 * 9.80665 * 80.0 * 25.0;  // N per metre of draft
      // A copy of the state with an empty scratch gives the same bits: nothing is remembered but the state.
      if (step % 97 == 5) {
        std::vector<double> blank(barge.scratch.size(), 0.0);
        CHECK(barge.force(instant, h, {barge.state, blank}) == got);
      }
      if (step % 13 != 0) continue;
      // h = 0 is statics, which sum the components at the vertices; calm water is what the waves add to.
      const Vector6 direct = barge.force(instant, 0.0, {barge.state, other});
      worst = std::max(worst, (got - direct).head<3>().cwiseAbs().maxCoeff() / (0.5 * still));
      worst = std::max(worst, (got - direct).tail<3>().cwiseAbs().maxCoeff() / (0.5 * still * 40.0));
      size = std::max(size, std::abs(direct[2] - direct[0]) / still);
    }
    REQUIRE(size > 0.1);
    CAPTURE(worst);
    CHECK(worst < way.bound);
  }
}

TEST_CASE("a hull that is far from the pose of its step takes the sea where it is") {
  // A blow in the step: half a metre off, where the step's own pose would be wrong by (0.4 0.5)^2 / 2 of a short wave.
  Barge barge;
  barge.element->start({}, barge.memory());
  const double t = 33.0, h = 0.05;
  const std::vector<BodyKinematics> before{Barge::at(t)};
  barge.element->begin_step({t, before, {}}, h, barge.memory());
  std::vector<BodyKinematics> now{Barge::at(t + h)};
  now[0].p_WC += Vector3(0.3, 0.4, -0.1);
  const Instant instant{t + h, now, {}};
  std::vector<double> other(barge.scratch.size());
  const Vector6 got = barge.force(instant, h, barge.memory());
  const Vector6 direct = barge.force(instant, 0.0, {barge.state, other});
  const double still = 1025.0 * 9.80665 * 80.0 * 25.0;
  // The series half a metre off: (k d)^3 / 6 with k = 0.4 1/m of the waves that carry a tenth of the energy.
  CHECK((got - direct).head<3>().norm() / (0.5 * still) < 1e-3);
  CHECK((got - direct).head<3>().norm() > 0.0);
}

TEST_CASE("between two expansions the hull's Jacobian is the derivative of its force") {
  Barge barge(sea(0.0, GENERATE(0, 12) == 0 ? kDeep : 12.0));
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
