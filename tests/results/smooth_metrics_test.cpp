// The smooth counterparts of metrics against what their formulas are in closed form on signals that are known, and
// against the metric that each stands for.
//
// The mean of exp(z sin) over whole periods is the modified Bessel function I0(z), so the log-sum-exp of a sine is known.
#include "results/smooth_metrics.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "tests/results/synthetic_lift.h"

using namespace stillhook;
using truth::SyntheticLift;

namespace {

/// A lift whose hoist wires pull less than their load, but while it hangs: the peak is that of the hanging phases alone.
SyntheticLift hanging_peaks() {
  SyntheticLift lift;
  Trajectory& run = lift.trajectory;
  for (const char* wire : {"hoist_port.tension", "hoist_starboard.tension"}) {
    const std::size_t c = static_cast<std::size_t>(run.find(wire));
    for (std::size_t i = 0; i < run.time.size(); ++i)
      if (run.time[i] < 119.9 || run.time[i] > 720.1) run.values[c][i] = 0.5 * SyntheticLift::kStatic;
    for (std::size_t p = 0; p < run.phases.size(); ++p)
      if (run.phases[p].stage != PhaseSpec::Stage::hanging) run.extremes[p][c].max = 0.5 * SyntheticLift::kStatic;
  }
  return lift;
}

double smooth_of(const SyntheticLift& lift, const std::string& name, const SmoothOptions& options = {}) {
  const auto value = smooth_metric(lift.specification, lift.trajectory, name, options);
  REQUIRE(value.has_value());
  return *value;
}

/// Log-sum-exp of amplitude * sin over whole periods; `scale` is the power of two next above the range of the samples.
double soft_sine(double amplitude, double scale, double sharpness) {
  const double s = sharpness / scale;
  return std::log(std::cyl_bessel_i(0.0, s * amplitude)) / s;
}

void add_channel(SyntheticLift& lift, const std::string& name, const std::string& unit, const std::function<double(double)>& at) {
  Trajectory& run = lift.trajectory;
  run.channels.push_back({name, unit, ""});
  run.values.emplace_back();
  for (const double t : run.time) run.values.back().push_back(at(t));
  for (auto& phase : run.extremes) phase.emplace_back();
}

}  // namespace

TEST_CASE("a smooth amplification is the log-sum-exp of its sine, below the peak and nearer with sharpness", "[metrics][smooth]") {
  const SyntheticLift lift = hanging_peaks();
  const double port = SyntheticLift::kDynamicPort, starboard = SyntheticLift::kDynamicStarboard;
  double previous = 1.0;
  for (const double sharpness : {5.0, 20.0, 80.0, 320.0}) {
    CAPTURE(sharpness);
    SmoothOptions options;
    options.sharpness = sharpness;
    const double soft = smooth_of(lift, "daf.hoist_port", options);
    // Fifty samples a period: the sum over them differs from the integral by I_50 beside I_0, 1e-4 at s d = 128, over s.
    CHECK(soft == Approx(1.0 + soft_sine(port, 0.125, sharpness)).margin(1e-6));
    CHECK(smooth_of(lift, "daf.hoist_starboard", options) == Approx(1.0 + soft_sine(starboard, 0.0625, sharpness)).margin(1e-6));
    // Both wires: they swing in phase, so the sum has the mean of their amplitudes.
    CHECK(smooth_of(lift, "daf_total", options) == Approx(1.0 + soft_sine(0.5 * (port + starboard), 0.125, sharpness)).margin(1e-6));
    CHECK(soft > previous);
    CHECK(soft < 1.0 + port);
    previous = soft;
  }
  CHECK(previous == Approx(1.0 + port).margin(0.002));  // ln sqrt(2 pi s d) / s at 320
}

TEST_CASE("a peak with next to no range has its log-sum-exp too", "[metrics][smooth]") {
  // A lift in calm water: a hundredth of the swing of the others. The exponentials of its peak must not vanish.
  SyntheticLift lift = hanging_peaks();
  Trajectory& run = lift.trajectory;
  std::vector<double>& tension = run.values[static_cast<std::size_t>(run.find("hoist_port.tension"))];
  for (double& value : tension)
    if (value > 0.6 * SyntheticLift::kStatic) value = SyntheticLift::kStatic + 0.01 * (value - SyntheticLift::kStatic);
  const double amplitude = 0.01 * SyntheticLift::kDynamicPort;
  // 2^-9 is next above the range of 1e-3. Of rounding the ratio keeps 1e-16, the exponent 1e4 times that.
  CHECK(smooth_of(lift, "daf.hoist_port") - 1.0 == Approx(soft_sine(amplitude, 1.0 / 512.0, 20.0)).epsilon(1e-6));
}

TEST_CASE("the smooth larger of two wires is the mean of high powers", "[metrics][smooth]") {
  const SyntheticLift lift = hanging_peaks();
  const double a = smooth_of(lift, "daf.hoist_port"), b = smooth_of(lift, "daf.hoist_starboard");
  const double power = 64.0;  // at the usual sharpness
  const double together = std::pow(0.5 * (std::pow(a, power) + std::pow(b, power)), 1.0 / power);
  CHECK(smooth_of(lift, "daf_max") == Approx(together).epsilon(1e-9));
  CHECK(smooth_of(lift, "daf_excess") == Approx(together - 1.0).epsilon(1e-7));
  CHECK(together < a);
  CHECK(together > a * (1.0 - std::log(2.0) / power));
}

TEST_CASE("a larger amplification outside the hanging phases counts as it is", "[metrics][smooth]") {
  SyntheticLift lift = hanging_peaks();
  Trajectory& run = lift.trajectory;
  const std::size_t c = static_cast<std::size_t>(run.find("hoist_port.tension"));
  for (std::size_t p = 0; p < run.phases.size(); ++p)
    if (run.phases[p].stage == PhaseSpec::Stage::set_down) {
      run.extremes[p][c].max = 1.2 * SyntheticLift::kStatic;
      run.extremes[p][c].t_max = 800.0;
      run.values[c][4000] = 1.2 * SyntheticLift::kStatic;
    }
  CHECK(smooth_of(lift, "daf.hoist_port") == Approx(1.2).epsilon(1e-12));
}

TEST_CASE("smooth sway is taken over a window that ends between samples", "[metrics][smooth]") {
  SyntheticLift lift;
  const double w = SyntheticLift::kSwing, x = std::pow(SyntheticLift::kSwayX, 2), y = std::pow(SyntheticLift::kSwayY, 2);
  const double from = 125.07, to = 416.67;
  PhaseRecord& phase = lift.trajectory.phases[2];
  REQUIRE(phase.name == "hoist_up");
  CHECK(smooth_of(lift, "sway_rms.hoist_up") == Approx(std::sqrt(0.5 * (x + y))).epsilon(1e-9));  // whole periods
  phase.start = from;
  phase.end = to;
  const double broken = (std::sin(2.0 * w * to) - std::sin(2.0 * w * from)) / (2.0 * w * (to - from));
  // Straight lines between samples: (2 w h)^2 / 12 of the broken period, 5e-6 of the whole. A window of whole samples
  // would be off by 5e-5.
  CHECK(smooth_of(lift, "sway_rms.hoist_up") ==
        Approx(std::sqrt(0.5 * x * (1.0 - broken) + 0.5 * y * (1.0 + broken))).epsilon(1e-5));
}

TEST_CASE("the smooth peak of sway is the log-sum-exp of its square", "[metrics][smooth]") {
  const SyntheticLift lift;
  const double x = std::pow(SyntheticLift::kSwayX, 2), y = std::pow(SyntheticLift::kSwayY, 2);
  // x sin^2 + y cos^2: a sine of half the difference about half the sum, over whole periods; its range is 0.95 m2.
  const double square = 0.5 * (x + y) + soft_sine(0.5 * (x - y), 1.0, 20.0);
  CHECK(smooth_of(lift, "sway_peak") == Approx(std::sqrt(square)).epsilon(1e-6));
  CHECK(smooth_of(lift, "sway_peak") < SyntheticLift::kSwayX);
}

TEST_CASE("smooth re-hits are the impulse that bounces leave, and nothing where nothing touches", "[metrics][smooth]") {
  constexpr double kSpeed = 0.5, kContact = 20.0;  // m/s at each touch, s that it lasts: half a period of the load on its deck
  const double w = std::acos(-1.0) / kContact, mass = 1e6;
  // It rests at 5 cm until 90 s, rises, comes down at kSpeed at 98 s, bounces, and is left.
  const auto gap_after = [=](int bounces) {
    return [=](double t) {
      if (t < 90.0) return -0.05;
      if (t < 94.0) return kSpeed * (t - 90.0);
      if (bounces == 0) return 4.0 * kSpeed;
      double touch = 98.0;
      for (int n = 0; n < bounces; ++n, touch += kContact + 8.0) {
        if (t < touch) return kSpeed * std::min(4.0, touch - t);
        if (t < touch + kContact) return -kSpeed / w * std::sin(w * (t - touch));
        if (t < touch + kContact + 4.0) return kSpeed * (t - touch - kContact);
      }
      return 4.0 * kSpeed;
    };
  };
  for (const int bounces : {0, 1, 3}) {
    CAPTURE(bounces);
    SyntheticLift lift;
    lift.specification.bodies[1].mass = mass;
    lift.specification.contacts[0].stiffness = mass * w * w;
    add_channel(lift, "deck.gap", "m", gap_after(bounces));
    SmoothOptions options;
    options.rehit_speed = 0.8;
    const double smooth = smooth_of(lift, "rehits", options);
    if (bounces == 0) {
      CHECK(smooth == 0.0);  // to the bit: what rested before lift-off does not count
    } else {
      // 2 m v a bounce over m v0. A hundred samples of half a sine: 1e-4; the rounded foot of the law adds 1e-6.
      CHECK(smooth == Approx(bounces * 2.0 * kSpeed / options.rehit_speed).epsilon(1e-3));
    }
  }
}

TEST_CASE("smooth saturation is the share of time at a limit", "[metrics][smooth]") {
  SyntheticLift lift;
  const TaglineSpec line = lift.specification.taglines[0];
  Trajectory& run = lift.trajectory;
  add_channel(lift, "tag_port.command", "N", [](double) { return 0.0; });
  std::vector<double>& speed = run.values[static_cast<std::size_t>(run.find("tag_port.line_speed"))];
  const auto set_speed = [&](const std::function<double(double)>& at) {
    for (std::size_t i = 0; i < run.time.size(); ++i) speed[i] = at(run.time[i]);
  };
  set_speed([](double) { return 0.0; });
  CHECK(smooth_of(lift, "tagline_saturated") < 1e-7);
  // A quarter of the time at its speed limit, as the metric has it too; of each step half a sample in 20 s is unsure.
  set_speed([&](double t) { return std::fmod(t, 20.0) < 5.0 ? -line.speed_max : 0.0; });
  CHECK(smooth_of(lift, "tagline_saturated") == Approx(0.25).margin(0.01));
  // Near it, the logistic: a tenth below, in twentieths, 2 / (1 + e^2).
  set_speed([&](double) { return 0.9 * line.speed_max; });
  CHECK(smooth_of(lift, "tagline_saturated") == Approx(2.0 / (1.0 + std::exp(2.0))).epsilon(1e-6));
  // At the pull's limit alone, and never more than all of the time.
  set_speed([](double) { return 0.0; });
  std::ranges::fill(run.values.back(), line.tension_max);
  CHECK(smooth_of(lift, "tagline_saturated") == Approx(1.0).epsilon(1e-6));
  set_speed([&](double) { return line.speed_max; });
  CHECK(smooth_of(lift, "tagline_saturated") == 1.0);
}
