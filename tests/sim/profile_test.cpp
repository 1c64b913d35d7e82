#include "sim/lifting/profile.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

using namespace stillhook;
using Shape = ProfileSpec::Shape;
using Shaper = ProfileSpec::Shaper;

namespace {

ProfileSpec spec_of(Shape shape, double ramp, std::vector<double> knots = {}) {
  ProfileSpec s;
  s.shape = shape;
  s.ramp = ramp;
  s.knots = std::move(knots);
  return s;
}

ProfileSpec shaped(ProfileSpec spec, ProfileSpec::Shaper shaper, double period, double damping = 0.0) {
  spec.shaper = shaper;
  spec.shaper_period = period;
  spec.shaper_damping = damping;
  return spec;
}

// Simpson's rule on pieces far shorter than any ramp.
double integral_of_rate(const RateProfile& p, double to) {
  const int n = 20000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double a = to * i / n, b = to * (i + 1) / n;
    sum += (b - a) / 6.0 * (p.rate(a) + 4.0 * p.rate(0.5 * (a + b)) + p.rate(b));
  }
  return sum;
}

const std::vector<ProfileSpec> kShapes = {
    spec_of(Shape::trapezoid, 7.0),
    spec_of(Shape::s_curve, 11.0),
    spec_of(Shape::knots, 5.0, {0.4, 1.0, 0.7, 0.9}),
    spec_of(Shape::knots, 5.0, {0.0, 2.0, 0.5}),
    spec_of(Shape::knots, 5.0, {3.0}),
    shaped(spec_of(Shape::s_curve, 11.0), Shaper::zv, 17.0),
    shaped(spec_of(Shape::s_curve, 11.0), Shaper::zvd, 6.0, 0.1),
    shaped(spec_of(Shape::trapezoid, 7.0), Shaper::zvd, 31.0, 0.05),
    shaped(spec_of(Shape::knots, 5.0, {0.4, 1.0, 0.7, 0.9}), Shaper::zv, 3.3),
};

}  // namespace

TEST_CASE("a rate profile goes from rest to rest over its travel") {
  for (const ProfileSpec& spec : kShapes) {
    for (const double travel : {4.3, -4.3, 0.03, -1e-6}) {
      const RateProfile p(spec, travel, 0.0139);
      CAPTURE(static_cast<int>(spec.shape), travel);
      CHECK(p.position(-1.0) == 0.0);
      CHECK(p.position(0.0) == 0.0);
      CHECK(p.position(p.duration()) == travel);
      CHECK(p.position(p.duration() + 5.0) == travel);
      CHECK(p.rate(0.0) == 0.0);
      CHECK(p.rate(p.duration()) == 0.0);
      CHECK(p.duration() >= 2.0 * spec.ramp * (1.0 - 1e-12));
      // No jump at the ends: what is left a millisecond before the end is of the order of the rate there.
      const double left = std::abs(travel - p.position(p.duration() - 1e-3));
      CHECK(left <= 1e-6 * p.peak_rate());
    }
  }
}

TEST_CASE("position is the integral of rate and moves one way") {
  for (const ProfileSpec& spec : kShapes) {
    for (const double travel : {4.3, -0.06}) {
      const RateProfile p(spec, travel, 0.0139);
      CAPTURE(static_cast<int>(spec.shape), travel);
      for (const double share : {0.02, 0.13, 0.41, 0.66, 0.97, 1.0}) {
        const double t = share * p.duration();
        // Simpson on 20 000 pieces: a kink of the polyline leaves 1/12 (jump of slope) (piece)^2, up to 3e-8 of the
        // travel.
        CHECK(p.position(t) == Approx(integral_of_rate(p, t)).margin(1e-7 * std::abs(travel)).epsilon(0.0));
      }
      double before = 0.0;
      for (int i = 1; i <= 1000; ++i) {
        const double now = p.position(p.duration() * i / 1000.0) * std::copysign(1.0, travel);
        CHECK(now >= before - 1e-15);
        before = now;
      }
    }
  }
}

TEST_CASE("long travels reach the speed, short ones keep their ramps and go slower") {
  const double v = 0.0333;
  for (const Shape shape : {Shape::trapezoid, Shape::s_curve}) {
    const RateProfile fast(spec_of(shape, 10.0), 14.63, v);
    CHECK(fast.peak_rate() == Approx(v).epsilon(1e-14));
    CHECK(fast.duration() == Approx(14.63 / v + 10.0).epsilon(1e-14));  // travel = v (duration - ramp)
    CHECK(fast.rate(0.5 * fast.duration()) == Approx(v).epsilon(1e-14));

    const RateProfile slow(spec_of(shape, 10.0), -0.1, v);  // a third of what the two ramps alone would cover
    CHECK(slow.duration() == Approx(20.0).epsilon(1e-14));
    CHECK(slow.peak_rate() == Approx(0.01).epsilon(1e-13));
    CHECK(slow.rate(10.0) == Approx(-0.01).epsilon(1e-12));
  }
  CHECK(RateProfile(spec_of(Shape::trapezoid, 10.0), 3.0, v).peak_acceleration() == Approx(v / 10.0).epsilon(1e-13));
  CHECK(RateProfile(spec_of(Shape::s_curve, 10.0), 3.0, v).peak_acceleration() ==
        Approx(0.5 * std::numbers::pi * v / 10.0).epsilon(1e-13));
}

TEST_CASE("peak acceleration is the largest slope of the rate") {
  for (const ProfileSpec& spec : kShapes) {
    const RateProfile p(spec, 2.7, 0.02);
    double largest = 0.0, fastest = 0.0;
    const double dt = p.duration() / 200000.0;
    for (int i = 0; i < 200000; ++i) {
      largest = std::max(largest, std::abs(p.rate((i + 1) * dt) - p.rate(i * dt)) / dt);
      fastest = std::max(fastest, std::abs(p.rate(i * dt)));
    }
    // The sampled slope misses the peak of a smooth ramp by its curvature over one sample.
    CHECK(p.peak_acceleration() == Approx(largest).epsilon(1e-6));
    CHECK(p.peak_rate() == Approx(fastest).epsilon(1e-4));
  }
}

TEST_CASE("knots stand at equal times between the ramps") {
  // Areas: ramps 2 x (0.5 + 1)/2 = 1.5, three spans; 0.75 + 0.9 + 0.9 = 2.55 per interval (speeds over 0.1 m/s).
  const RateProfile p(spec_of(Shape::knots, 2.0, {1.0, 2.0, 1.6, 2.0}), 0.1 * (1.5 + 2.55 * 8.0), 0.1);
  CHECK(p.duration() == Approx(2.0 + 3.0 * 8.0 + 2.0).epsilon(1e-14));
  CHECK(p.rate(2.0) == Approx(0.05).epsilon(1e-13));
  CHECK(p.rate(10.0) == Approx(0.1).epsilon(1e-13));
  CHECK(p.rate(18.0) == Approx(0.08).epsilon(1e-13));
  CHECK(p.rate(26.0) == Approx(0.1).epsilon(1e-13));

  // Too short: the rate between knots never changes faster than in a ramp to full speed.
  const RateProfile shorter(spec_of(Shape::knots, 2.0, {1.0, 2.0, 1.6, 2.0}), 0.05, 0.1);
  CHECK(shorter.peak_rate() < 0.1);
  CHECK(shorter.peak_acceleration() <= shorter.peak_rate() / 2.0 * (1.0 + 1e-12));
}

TEST_CASE("a profile without travel takes no time, one without ramp jumps") {
  const RateProfile none(spec_of(Shape::s_curve, 10.0), 0.0, 0.1);
  CHECK(none.duration() == 0.0);
  CHECK(none.position(3.0) == 0.0);
  CHECK(none.rate(0.0) == 0.0);
  CHECK(none.peak_acceleration() == 0.0);
  CHECK(RateProfile().duration() == 0.0);
  for (const Shape shape : {Shape::trapezoid, Shape::s_curve}) {
    const RateProfile jump(spec_of(shape, 0.0), 3.0, 0.1);
    CHECK(jump.duration() == Approx(30.0).epsilon(1e-14));
    CHECK(jump.position(10.0) == Approx(1.0).epsilon(1e-13));
    CHECK(jump.rate(10.0) == Approx(0.1).epsilon(1e-13));
    CHECK(std::isinf(jump.peak_acceleration()));
  }
}

TEST_CASE("a shaped profile is the base profile in shares, one after the other") {
  for (const ProfileSpec& spec :
       {spec_of(Shape::trapezoid, 7.0), spec_of(Shape::s_curve, 7.0), spec_of(Shape::knots, 5.0, {0.4, 1.0, 0.7})})
    for (const double travel : {4.3, -0.02}) {
      const RateProfile base(spec, travel, 0.0139);
      const RateProfile zv(shaped(spec, Shaper::zv, 9.0), travel, 0.0139);
      const RateProfile zvd(shaped(spec, Shaper::zvd, 9.0), travel, 0.0139);
      CHECK(zv.duration() == Approx(base.duration() + 4.5).epsilon(1e-14));
      CHECK(zvd.duration() == Approx(base.duration() + 9.0).epsilon(1e-14));
      CHECK(zvd.position(zvd.duration()) == travel);
      for (double t = -1.0; t < zvd.duration() + 1.0; t += 0.37) {
        CHECK(zv.rate(t) == Approx(0.5 * (base.rate(t) + base.rate(t - 4.5))).margin(1e-16));
        CHECK(zvd.position(t) ==
              Approx(0.25 * base.position(t) + 0.5 * base.position(t - 4.5) + 0.25 * base.position(t - 9.0)));
      }
      CHECK(zv.peak_rate() <= base.peak_rate() * (1.0 + 1e-14));
      CHECK(zv.peak_acceleration() <= base.peak_acceleration() * (1.0 + 1e-12));
    }
  // Ramps of 2 s half a period of 8 s apart do not overlap: each is half as steep.
  const RateProfile apart(shaped(spec_of(Shape::trapezoid, 2.0), Shaper::zv, 8.0), 3.0, 0.1);
  CHECK(apart.peak_acceleration() == Approx(0.5 * 0.1 / 2.0).epsilon(1e-13));
  CHECK(apart.peak_rate() == Approx(0.1).epsilon(1e-13));
  // A travel of two ramps only: the halves meet at half the speed where the second begins.
  const RateProfile brief(shaped(spec_of(Shape::trapezoid, 2.0), Shaper::zv, 8.0), 0.2, 0.1);
  CHECK(brief.duration() == Approx(8.0).epsilon(1e-13));
  CHECK(brief.peak_rate() == Approx(0.05).epsilon(1e-13));
}

TEST_CASE("shaped moves leave an oscillator at rest, ZVD also one of a slightly other period") {
  // x'' + 2 zeta w x' + w^2 x = -rate', from rest, by Runge-Kutta in steps of a millisecond; what is left after the
  // move is the amplitude sqrt(x^2 + ((x' + zeta w x) / wd)^2).
  const auto left = [](const RateProfile& profile, double period, double zeta) {
    const double w = 2.0 * std::numbers::pi / period, h = 1e-3, end = profile.duration();
    // v = x' + rate, so that the rate itself enters and not its jumps: x' = v - rate, v' = -2 zeta w x' - w^2 x.
    double x = 0.0, v = 0.0;
    const auto x_rate = [&](double t, double at_v) { return at_v - profile.rate(t); };
    const auto v_rate = [&](double t, double at_x, double at_v) {
      return -2.0 * zeta * w * x_rate(t, at_v) - w * w * at_x;
    };
    const int steps = static_cast<int>(std::ceil(end / h));
    for (int k = 0; k < steps; ++k) {
      const double t = k * h;
      const double x1 = x_rate(t, v), v1 = v_rate(t, x, v);
      const double x2 = x_rate(t + h / 2, v + h / 2 * v1), v2 = v_rate(t + h / 2, x + h / 2 * x1, v + h / 2 * v1);
      const double x3 = x_rate(t + h / 2, v + h / 2 * v2), v3 = v_rate(t + h / 2, x + h / 2 * x2, v + h / 2 * v2);
      const double x4 = x_rate(t + h, v + h * v3), v4 = v_rate(t + h, x + h * x3, v + h * v3);
      x += h / 6 * (x1 + 2 * x2 + 2 * x3 + x4);
      v += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    }
    return std::hypot(x, (v + zeta * w * x) / (w * std::sqrt(1.0 - zeta * zeta)));
  };
  for (const double zeta : {0.0, 0.08}) {
    const ProfileSpec base = spec_of(Shape::s_curve, 3.0);
    const double period = 9.0, unshaped = left(RateProfile(base, 2.0, 0.1), period, zeta);
    CAPTURE(zeta, unshaped);
    CHECK(unshaped > 0.01);
    for (const Shaper shaper : {Shaper::zv, Shaper::zvd}) {
      const RateProfile profile(shaped(base, shaper, period, zeta), 2.0, 0.1);
      // Kinks of the rate within a step: (jump of slope) h^2, 1e-7 m.
      CHECK(left(profile, period, zeta) <= 1e-5 * unshaped);
      const double other = left(profile, 1.05 * period, zeta) / left(RateProfile(base, 2.0, 0.1), 1.05 * period, zeta);
      // cos(pi / 2 / 1.05) = 0.075 for two impulses without damping, its square for three.
      CHECK(other < (shaper == Shaper::zv ? 0.1 : 0.01));
      CHECK(other > (shaper == Shaper::zv ? 0.05 : 0.001));
    }
  }
}

TEST_CASE("a profile that cannot be is refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(RateProfile(spec_of(Shape::s_curve, 10.0), 1.0, 0.0), std::invalid_argument);
  CHECK_THROWS_AS(RateProfile(spec_of(Shape::s_curve, 10.0), nan, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(RateProfile(spec_of(Shape::s_curve, -1.0), 1.0, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(RateProfile(spec_of(Shape::knots, 1.0), 1.0, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(RateProfile(spec_of(Shape::knots, 1.0, {0.0, 0.0}), 1.0, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(RateProfile(spec_of(Shape::knots, 1.0, {1.0, -0.2}), 1.0, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(RateProfile(shaped(spec_of(Shape::s_curve, 1.0), Shaper::zv, 0.0), 1.0, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(RateProfile(shaped(spec_of(Shape::s_curve, 1.0), Shaper::zvd, nan), 1.0, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(RateProfile(shaped(spec_of(Shape::s_curve, 1.0), Shaper::zv, 5.0, 1.0), 1.0, 0.1),
                  std::invalid_argument);
}
