#include "sim/lifting/profile.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

using namespace stillhook;
using Shape = ProfileSpec::Shape;

namespace {

ProfileSpec spec_of(Shape shape, double ramp, std::vector<double> knots = {}) {
  ProfileSpec s;
  s.shape = shape;
  s.ramp = ramp;
  s.knots = std::move(knots);
  return s;
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

TEST_CASE("a profile that cannot be is refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(RateProfile(spec_of(Shape::s_curve, 10.0), 1.0, 0.0), std::invalid_argument);
  CHECK_THROWS_AS(RateProfile(spec_of(Shape::s_curve, 10.0), nan, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(RateProfile(spec_of(Shape::s_curve, -1.0), 1.0, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(RateProfile(spec_of(Shape::knots, 1.0), 1.0, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(RateProfile(spec_of(Shape::knots, 1.0, {0.0, 0.0}), 1.0, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(RateProfile(spec_of(Shape::knots, 1.0, {1.0, -0.2}), 1.0, 0.1), std::invalid_argument);
}
