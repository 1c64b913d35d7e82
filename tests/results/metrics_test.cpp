#include "results/metrics.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "results/limits.h"
#include "results/smooth_metrics.h"
#include "tests/results/synthetic_lift.h"

using namespace stillhook;
using truth::SyntheticLift;

namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;
// The signals are sampled at 0.2 s: an extreme of a combination lies within half a sample of the true one, which costs
// (w dt / 2)^2 / 2 of an amplitude, 2e-3 for the 10 s wave and 5e-4 for the 20 s swing. Means and rms over whole
// periods are exact for the trapezoidal rule up to rounding.
constexpr double kSampled = 2e-3;
constexpr double kExact = 1e-9;

}  // namespace

TEST_CASE("sway is the swing about the static path over whole periods") {
  const SyntheticLift lift;
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  const double ax = SyntheticLift::kSwayX, ay = SyntheticLift::kSwayY;
  CHECK(m.value("sway_x_rms") == Approx(ax / std::sqrt(2.0)).epsilon(kExact));
  CHECK(m.value("sway_y_rms") == Approx(ay / std::sqrt(2.0)).epsilon(kExact));
  CHECK(m.value("sway_rms") == Approx(std::sqrt(0.5 * (ax * ax + ay * ay))).epsilon(kExact));
  CHECK(m.value("sway_rms.turn") == Approx(m.value("sway_rms")).epsilon(kExact));
  CHECK(m.value("sway_peak") == Approx(std::max(ax, ay)).epsilon(kSampled));
  CHECK(m.find("sway_rms.settle") == nullptr);  // nothing hangs there
}

TEST_CASE("the motion of the load in the world is that about its static path") {
  const SyntheticLift lift;
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  // Sine and cosine over whole periods about a path that is straight in each phase.
  const double rms = std::sqrt(0.5 * (std::pow(SyntheticLift::kSwayX, 2) + std::pow(SyntheticLift::kSwayY, 2)));
  CHECK(m.value("load_motion_rms") == Approx(rms).epsilon(1e-3));
}

TEST_CASE("ranges are peak to peak in a phase, means are over time") {
  const SyntheticLift lift;
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  CHECK(m.value("range_x.hoist_up") == Approx(2.0 * SyntheticLift::kSwayX).epsilon(1e-5));  // from every step
  CHECK(m.value("range_y.hoist_up") == Approx(2.0 * SyntheticLift::kSwayY).epsilon(1e-5));
  CHECK(m.value("range_roll.hoist_up") == Approx(2.0 * 0.02 * kDegrees).epsilon(1e-5));
  CHECK(m.value("mean_x.hoist_up") == Approx(74.0).epsilon(kExact));
  // Travel -8 (t/300)^2: its mean is -8/3, to the trapezoidal rule's 8/3 * (0.2/300)^2 / 2 = 6e-7.
  CHECK(m.value("mean_x.turn") == Approx(74.0 - 8.0 / 3.0).epsilon(1e-6));
  CHECK(m.find("range_x.turn")->phase == "turn");
}

namespace {

/// Writes a signal over a channel between two times, samples and extremes.
template <class F>
void rewrite(Trajectory& run, const std::string& channel, double from, double to, F value) {
  const auto c = static_cast<std::size_t>(run.find(channel));
  for (std::size_t i = 0; i < run.time.size(); ++i)
    if (run.time[i] >= from && run.time[i] <= to) run.values[c][i] = value(run.time[i]);
  for (std::size_t p = 0; p < run.phases.size(); ++p) {
    Extreme& e = run.extremes[p][c] = {1e12, -1e12, 0.0, 0.0};
    for (std::size_t i = 0; i < run.time.size(); ++i) {
      if (run.time[i] < run.phases[p].start || run.time[i] > run.phases[p].end) continue;
      const double v = run.values[c][i];
      if (v > e.max) e.max = v, e.t_max = run.time[i];
      if (v < e.min) e.min = v, e.t_min = run.time[i];
    }
  }
}

}  // namespace

TEST_CASE("a snap while lowering counts against what the wire holds at rest when the load hangs") {
  SyntheticLift lift;
  // The hook load of a set-down that was reported as 1.041 and is 517.5 t over 421.8 t.
  for (const char* wire : {"hoist_port", "hoist_starboard"})
    rewrite(lift.trajectory, std::string(wire) + ".tension", 800.0, 800.2,
            [](double) { return SyntheticLift::kStatic * 517.5 / 421.8; });
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  CHECK(m.value("daf_total") == Approx(517.5 / 421.8).epsilon(1e-12));
  CHECK(m.value("daf_max") == Approx(517.5 / 421.8).epsilon(1e-12));
  CHECK(m.find("daf_total")->phase == "lower");
  CHECK(m.find("daf_total")->time == Approx(800.0));
}

TEST_CASE("a snap at lift-off, and one on the wire of a load that lies at its target, count as well") {
  SyntheticLift lift;
  rewrite(lift.trajectory, "hoist_port.tension", 94.0, 94.2, [](double) { return 1.6 * SyntheticLift::kStatic; });
  CHECK(compute_metrics(lift.specification, lift.trajectory).value("daf.hoist_port") == Approx(1.6).epsilon(1e-12));
  rewrite(lift.trajectory, "hoist_port.tension", 930.0, 930.2, [](double) { return 1.7 * SyntheticLift::kStatic; });
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  CHECK(m.value("daf.hoist_port") == Approx(1.7).epsilon(1e-12));  // of the load's weight: it rests at both ends
  CHECK(m.find("daf.hoist_port")->phase == "hold");
}

TEST_CASE("slack counts from lift-off to the landing, in whatever phase that is") {
  SyntheticLift lift;
  const auto slack_at = [&](double t) {
    SyntheticLift one;
    rewrite(one.trajectory, "hoist_port.tension", t, t + 0.2, [](double) { return 0.0; });
    return compute_metrics(one.specification, one.trajectory).value("slack_ratio_min");
  };
  // The rewritten tension has only the samples, and the trough of the 10 s wave lies in the middle of two of them.
  const double swinging = 1.0 - SyntheticLift::kDynamicPort * std::cos(SyntheticLift::kWave * 0.1);
  CHECK(slack_at(70.0) == Approx(swinging).epsilon(kExact));   // before lift-off at 90 s
  CHECK(slack_at(104.0) == 0.0);                               // a re-hit of the transfer
  CHECK(slack_at(800.0) == 0.0);                               // lowering
  CHECK(slack_at(877.0) == Approx(swinging).epsilon(kExact));  // after the first touch of the target at 874 s
}

TEST_CASE("a wire that is to hold a part of the landed load must not jerk") {
  SyntheticLift lift;
  // 400 kN are to stay in the wire: in the set-down's last pose and in the last of all. In waves it goes from 0 to 800.
  for (const std::size_t pose : {5u, 6u}) lift.trajectory.static_poses[pose].values["hoist_port.tension"] = 4e5;
  rewrite(lift.trajectory, "hoist_port.tension", 880.2, 960.0,
          [](double t) { return 4e5 * (1.0 + std::sin(SyntheticLift::kWave * t)); });
  // The samples lie on either side of the trough: 1 - cos(0.1 s of the wave) is the least they know.
  CHECK(compute_metrics(lift.specification, lift.trajectory).value("slack_ratio_min.hoist_port") ==
        Approx(1.0 - std::cos(SyntheticLift::kWave * 0.1)).epsilon(kExact));
  // The extreme of `hold`, from every step, knows the trough itself.
  Extreme& hold = lift.trajectory.extremes[5][static_cast<std::size_t>(lift.trajectory.find("hoist_port.tension"))];
  hold.min = 0.0;
  hold.t_min = 907.5;
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  CHECK(m.value("slack_ratio_min.hoist_port") == Approx(0.0).margin(1e-9));
  CHECK(m.find("slack_ratio_min.hoist_port")->phase == "hold");
  // Its tension there is far below what it has held: no amplification.
  CHECK(m.value("daf.hoist_port") == Approx(1.0 + SyntheticLift::kDynamicPort).epsilon(1e-3));
}

TEST_CASE("heel, trim, leads and hook load by crane and in total") {
  SyntheticLift lift;
  Specification& s = lift.specification;
  // The starboard wire hangs on a second vessel, whose boom is hinged to it.
  BodySpec second, boom;
  second.name = "second";
  boom.name = "second_boom";
  s.bodies.push_back(second);
  s.bodies.push_back(boom);
  JointSpec pin;
  pin.name = "pin";
  pin.parent = "second";
  pin.child = "second_boom";
  s.joints = {pin};
  s.wires[0].from = "crane";
  s.wires[1].from = "second_boom";
  Trajectory& run = lift.trajectory;
  for (const char* angle : {"roll", "pitch"}) {
    run.channels.push_back({std::string("second.") + angle, "rad", ""});
    run.values.emplace_back(run.time.size(), 0.0);
    for (auto& phase : run.extremes) phase.push_back({0.0, 0.0, 0.0, 0.0});
    for (StaticPose& pose : run.static_poses) pose.values[std::string("second.") + angle] = 0.02;
    rewrite(run, std::string("second.") + angle, 0.0, 1e9, [](double) { return 0.03; });
  }
  const Metrics m = compute_metrics(s, run);
  CHECK(m.value("heel_max.crane") == Approx(SyntheticLift::kRoll * kDegrees).epsilon(1e-6));
  CHECK(m.value("heel_max.second") == Approx(0.03 * kDegrees).epsilon(1e-9));
  CHECK(m.value("heel_max") == Approx(0.03 * kDegrees).epsilon(1e-9));
  CHECK(m.value("heel_static_max.second") == Approx(0.02 * kDegrees).epsilon(1e-9));
  CHECK(m.value("trim_max.second") == Approx(0.03 * kDegrees).epsilon(1e-9));
  const double port = 4903.3 * (1.0 + SyntheticLift::kDynamicPort),
               starboard = 4903.3 * (1.0 + SyntheticLift::kDynamicStarboard);
  CHECK(m.value("hook_load_max.crane") == Approx(port).epsilon(1e-6));
  CHECK(m.value("hook_load_max.second") == Approx(starboard).epsilon(1e-6));
  CHECK(m.value("hook_load_max.second_boom") == m.value("hook_load_max.second"));
  CHECK(m.value("hook_load_max") == Approx(port + starboard).epsilon(0.05 * kSampled));
  // One wire each: the amplification of a crane is that of its wire.
  CHECK(m.value("daf.crane") == Approx(1.0 + SyntheticLift::kDynamicPort).epsilon(1e-6));
  CHECK(m.value("daf.second") == Approx(1.0 + SyntheticLift::kDynamicStarboard).epsilon(1e-6));
  CHECK(m.value("daf.second_boom") == m.value("daf.second"));
  CHECK(metric_exists("daf.second", s));
  const std::vector<std::string> needs = channels_of_metric(s, "daf.second");
  CHECK(std::find(needs.begin(), needs.end(), "hoist_starboard.tension") != needs.end());
  // The smooth stand-in of a search is that of the crane's wires too: 1 % is what its soft peak may lie below.
  CHECK(*smooth_metric(s, run, "daf.second", {}) == Approx(1.0 + SyntheticLift::kDynamicStarboard).epsilon(0.01));
  CHECK(m.value("offlead_max.second") == m.value("offlead_max.hoist_starboard"));
  CHECK(metric_exists("trim_static_max.second", s));
  CHECK_FALSE(metric_exists("heel_max.second_boom", s));
}

TEST_CASE("DAF and slack of a run without snaps are those of the swing, and know where") {
  const SyntheticLift lift;
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  const double port = SyntheticLift::kDynamicPort, starboard = SyntheticLift::kDynamicStarboard;
  CHECK(m.value("daf.hoist_port") == Approx(1.0 + port).epsilon(1e-6));  // the extremes see every step
  CHECK(m.value("daf.hoist_starboard") == Approx(1.0 + starboard).epsilon(1e-6));
  CHECK(m.value("daf_max") == Approx(1.0 + port).epsilon(1e-6));
  CHECK(m.value("daf_total") == Approx(1.0 + 0.5 * (port + starboard)).epsilon(0.05 * kSampled));
  CHECK(m.value("daf.luffing_port") == Approx(1.04).epsilon(1e-6));
  CHECK(m.value("slack_ratio_min") == Approx(1.0 - port).epsilon(1e-6));  // not 0, as on the barge
  CHECK(m.value("tension_max.hoist_port") == Approx(4903.3 * (1.0 + port)).epsilon(1e-6));
  // Every crest from lift-off at 90 s on is equally high, over the weight that the wire then holds; the first is named.
  CHECK(m.find("daf_max")->phase == "load_transfer");
  CHECK(m.find("daf_max")->time == Approx(92.5).margin(0.011));  // to a step
  CHECK(m.value("wire_utilisation_max") == Approx(5.2e6 / 51.9e6).epsilon(1e-6));
}

TEST_CASE("DAF divides by the static tension of the moment, not of the phase's ends") {
  SyntheticLift lift;
  // The luffing wire's static tension falls to 60 % during `turn`, with the drive; the dynamic part is 4 % throughout.
  Trajectory& run = lift.trajectory;
  const auto c = static_cast<std::size_t>(run.find("luffing_port.tension"));
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    const double u = std::clamp((run.time[i] - 420.0) / 300.0, 0.0, 1.0);
    run.values[c][i] = 5.0e6 * (1.0 - 0.4 * u * u) * (1.0 + 0.04 * std::sin(SyntheticLift::kWave * run.time[i]));
  }
  for (std::size_t p = 0; p < run.phases.size(); ++p) {
    run.extremes[p][c] = {1e9, -1e9, 0.0, 0.0};
    for (std::size_t i = 0; i < run.time.size(); ++i) {
      if (run.time[i] < run.phases[p].start || run.time[i] > run.phases[p].end) continue;
      Extreme& e = run.extremes[p][c];
      const double v = run.values[c][i];
      if (v > e.max) e.max = v, e.t_max = run.time[i];
      if (v < e.min) e.min = v, e.t_min = run.time[i];
    }
  }
  for (std::size_t i = 4; i < run.static_poses.size(); ++i) run.static_poses[i].values["luffing_port.tension"] = 3.0e6;
  const Metrics m = compute_metrics(lift.specification, run);
  CHECK(m.value("daf.luffing_port") == Approx(1.04).epsilon(0.04 * kSampled));
}

TEST_CASE("leads count while the wire carries the load") {
  const SyntheticLift lift;
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  CHECK(m.value("offlead_max") == Approx(0.03 * kDegrees).epsilon(1e-5));  // and not the slack wire's 0.2 rad
  CHECK(m.value("offlead_max.hoist_starboard") == Approx(0.03 * kDegrees).epsilon(1e-5));
  CHECK(m.value("sidelead_max") == Approx(0.01 * kDegrees).epsilon(1e-5));
}

TEST_CASE("re-hits are the pickup contacts after the first lift-off") {
  const SyntheticLift lift;
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  CHECK(m.value("lift_off_time") == 90.0);
  CHECK(m.value("rehits") == 3.0);
  CHECK(m.value("rehit_speed_max") == 0.34);
  CHECK(m.find("rehit_speed_max")->time == 104.0);
  CHECK(m.find("rehit_speed_max")->phase == "load_transfer");
  CHECK(m.value("rehit_impulse_max") == Approx(900.0));
  CHECK(m.value("contact_speed_max") == 0.34);
  CHECK(m.value("contact_impulse_max") == Approx(1100.0));  // neither the wait before lift-off nor the final rest
  CHECK(m.value("setdown_speed") == 0.17);                  // the first touch, not the second
}

TEST_CASE("without a re-hit its speed is zero, without a lift-off there is no count") {
  SyntheticLift lift;
  auto& contacts = lift.trajectory.contacts;
  contacts.erase(contacts.begin() + 2, contacts.begin() + 5);
  Metrics m = compute_metrics(lift.specification, lift.trajectory);
  CHECK(m.value("rehits") == 0.0);
  CHECK(m.value("rehit_speed_max") == 0.0);
  contacts[1].end = 960.0;  // never leaves the barge
  m = compute_metrics(lift.specification, lift.trajectory);
  CHECK(m.find("rehits") == nullptr);
  CHECK(check_limits({{"rehits", 0.0, {}, ""}}, m)[0].pass == false);
}

TEST_CASE("set-down is measured at the reference point against the target") {
  const SyntheticLift lift;
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  const double roll = 0.02, pitch = 0.015, ax = SyntheticLift::kSwayX, ay = SyntheticLift::kSwayY;
  // The reference point hangs 5 m under the origin: p_x = -5 sin(pitch) to first order, p_y = +5 sin(roll).
  CHECK(m.value("setdown_movement_x") == Approx(std::hypot(ax, 5.0 * pitch)).epsilon(5e-3));
  CHECK(m.value("setdown_movement_y") == Approx(std::hypot(ay, 5.0 * roll)).epsilon(5e-3));
  CHECK(m.value("setdown_movement_z") == Approx(0.25).epsilon(5e-3));  // the wave's part, not the 14.5 m of descent
  CHECK(m.value("load_yaw_max") == Approx(0.04 * kDegrees).epsilon(1e-5));
  CHECK(m.value("load_tilt_max") == Approx(roll * kDegrees).epsilon(kSampled));
  // At 960 s both swings are over; roll 0, pitch 0.015: the point stands 5 sin(0.015) behind. Second order: yaw 0.
  CHECK(m.value("setdown_offset") == Approx(5.0 * std::sin(pitch)).epsilon(1e-6));
}

TEST_CASE("winches, taglines, moorings, vessel") {
  const SyntheticLift lift;
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  CHECK(m.value("winch_speed_max.hoist") == Approx(2.0 * 14.5 / 180.0).epsilon(2e-3));  // rate just before its end
  CHECK(m.value("winch_speed_max.luffing") == 0.0);
  CHECK(m.value("winch_pull_max.hoist") == Approx(4903.3 * 1.05).epsilon(1e-6));
  CHECK(m.value("winch_utilisation_max") == Approx(5.2 / 9.0).epsilon(1e-6));
  CHECK(m.value("tagline_tension_max") == Approx(200.0).epsilon(1e-6));
  CHECK(m.value("tagline_speed_max.tag_port") == Approx(0.3).epsilon(1e-6));
  // A quarter of the time; each step from 1 to 0 costs the trapezoid half a sample of 0.2 s in 20 s.
  CHECK(m.value("tagline_saturated") == Approx(0.25).margin(0.1 / 20.0 + 1e-9));
  CHECK(m.find("tagline_saturated.tag_starboard") == nullptr);  // not active
  CHECK(m.value("mooring_tension_max.bow_port") == Approx(350.0).epsilon(1e-6));
  CHECK(m.value("heel_max") == Approx(SyntheticLift::kRoll * kDegrees).epsilon(1e-6));
  CHECK(m.value("trim_max") == Approx((SyntheticLift::kTrim + SyntheticLift::kPitch) * kDegrees).epsilon(1e-6));
  CHECK(m.value("trim_static_max") == Approx(SyntheticLift::kTrim * kDegrees).epsilon(1e-9));
  CHECK(m.value("heel_static_max") == 0.0);
  CHECK(m.value("duration") == 960.0);
}

TEST_CASE("lift-off: relative speed and cycles to clear of a sinusoidal relative motion") {
  const SyntheticLift lift;
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  const double r = SyntheticLift::kRelative, w = SyntheticLift::kWave;
  // sigma_v = r w / sqrt(2); the difference quotient over 0.2 s loses (w dt)^2 / 24 = 7e-4 of it; 40 s are 4 whole
  // periods.
  CHECK(m.value("lift_off_relative_speed") == Approx(std::sqrt(2.0) * r * w).epsilon(3e-3));
  CHECK(m.value("lift_off_relative_speed_extreme") ==
        Approx(r * w / std::sqrt(2.0) * std::sqrt(2.0 * std::log(60.0 / 10.0))).epsilon(3e-3));
  const double hoist = 2.0 * 1.92 / 60.0;  // m/s, largest rate in the transfer
  CHECK(m.value("cycles_to_clear") == Approx(2.0 * r / (hoist * 10.0)).epsilon(0.01));
}

TEST_CASE("a run without samples keeps every metric that is an extreme") {
  const SyntheticLift full, bare(false);
  const Metrics m = compute_metrics(bare.specification, bare.trajectory);
  const Metrics with = compute_metrics(full.specification, full.trajectory);
  CHECK(m.find("sway_rms") == nullptr);
  CHECK(m.find("clearance_min.load_bow") == nullptr);
  for (const char* name :
       {"daf.hoist_port", "range_x.turn", "tension_max.hoist_port", "heel_max", "rehits", "offlead_max", "duration"})
    CHECK(m.value(name) == Approx(with.value(name)).epsilon(1e-12));
}

TEST_CASE("what does not apply is absent, and a part of a run still has its metrics") {
  Metrics nothing = compute_metrics(Specification{}, Trajectory{});
  CHECK(nothing.items.empty());
  CHECK(std::isnan(nothing.value("sway_rms")));

  SyntheticLift lift;  // diverged in `hoist_up`
  Trajectory& run = lift.trajectory;
  run.status = RunStatus::diverged;
  run.message = "diverged at t = 300 s";
  run.phases.resize(3);
  run.extremes.resize(3);
  run.phases[2].end = 300.0;
  run.time.resize(1501);
  for (auto& values : run.values) values.resize(1501);
  const Metrics m = compute_metrics(lift.specification, run);
  CHECK(m.status == RunStatus::diverged);
  CHECK(m.message == run.message);
  CHECK(m.value("daf_max") == Approx(1.05).epsilon(1e-6));
  CHECK(m.find("setdown_offset") == nullptr);
  CHECK(m.value("duration") == 300.0);
  for (const Metric& item : m.items) CHECK(std::isfinite(item.value));
  CHECK_FALSE(within_limits(m, {}));
}

TEST_CASE("every computed metric is in the catalogue with its unit and exists for the case") {
  const SyntheticLift lift;
  const Metrics m = compute_metrics(lift.specification, lift.trajectory);
  const std::vector<std::string> names = metric_names(lift.specification);
  std::set<std::string> seen;
  for (const Metric& item : m.items) {
    INFO(item.name);
    const MetricDefinition* d = metric_definition(item.name);
    REQUIRE(d != nullptr);
    CHECK(d->unit == item.unit);
    CHECK(metric_exists(item.name, lift.specification));
    CHECK(std::find(names.begin(), names.end(), item.name) != names.end());
    CHECK(seen.insert(item.name).second);
  }
  CHECK(metric_exists("daf.hoist_port", lift.specification));
  CHECK_FALSE(metric_exists("daf.hoist_prt", lift.specification));
  CHECK_FALSE(metric_exists("daf", lift.specification));
  CHECK_FALSE(metric_exists("daf.%", lift.specification));
  CHECK_FALSE(metric_exists("slack_ratio_min.stay_port", lift.specification));  // not a hoist wire
  CHECK_FALSE(metric_exists("winch_speed_max.barge_tow", lift.specification));  // not a winch
  CHECK(metric_exists("range_x.hoist_up", lift.specification));
}
