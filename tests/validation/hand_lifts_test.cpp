// Four ordinary lifts, written from the pages alone (tests/lifts), run to their end; every number by hand calculation.
//
// Weights and moments are exact. Where the calculation is of first order, or leaves out what is small, the tolerance
// says so. Tonnes and metres here are 1e3 kg and SI.
#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "problems/case.h"
#include "results/metrics.h"
#include "sim/modes.h"
#include "sim/simulate.h"
#include "sim/spatial/constants.h"

using namespace stillhook;

namespace {

constexpr double kG = 9.80665, kRho = 1.025;  // m/s2, t/m3: the defaults of a case
constexpr double kTonne = 1e3 * kG;           // N, what a tonne weighs
constexpr double kPi = std::numbers::pi;

struct HandLift {
  explicit HandLift(const std::string& name, const std::vector<Override>& changes = {})
      : c(read_case(std::string(STILLHOOK_SOURCE_DIR) + "/tests/lifts/" + name + ".toml", changes)),
        model(build_model(c.specification)),
        operation(build_operation(model)),
        run(simulate(model, operation)),
        metrics(compute_metrics(c.specification, run)) {
    CAPTURE(run.message);
    REQUIRE(run.status == RunStatus::completed);
    for (const std::string& warning : model.warnings()) FAIL(warning);  // every load starts where it is said to
  }

  std::size_t pose(const std::string& name) const {
    for (std::size_t i = 0; i < operation.static_poses.size(); ++i)
      if (operation.static_poses[i].name == name) return i;
    throw std::runtime_error("no pose " + name);
  }
  /// A channel at rest at the end of a phase.
  double at(const std::string& phase, const std::string& channel) const {
    return operation.static_poses[pose(phase)].values.at(channel);
  }
  double metric(const std::string& name) const {
    const Metric* m = metrics.find(name);
    REQUIRE(m);
    return m->value;
  }
  const std::vector<double>& series(const std::string& channel) const {
    const int i = run.find(channel);
    REQUIRE(i >= 0);
    return run.values[static_cast<std::size_t>(i)];
  }
  double last(const std::string& channel) const { return series(channel).back(); }
  /// Half of what a channel goes through between two times, s.
  double amplitude(const std::string& channel, double from, double to) const {
    double low = 1e30, high = -1e30;
    for (std::size_t i = 0; i < run.time.size(); ++i)
      if (run.time[i] >= from && run.time[i] <= to) {
        low = std::min(low, series(channel)[i]);
        high = std::max(high, series(channel)[i]);
      }
    return 0.5 * (high - low);
  }
  /// Start of a phase, s.
  double start(const std::string& phase) const {
    for (const PhaseRecord& p : run.phases)
      if (p.name == phase) return p.start;
    throw std::runtime_error("no phase " + phase);
  }

  Case c;
  Model model;
  Operation operation;
  Trajectory run;
  Metrics metrics;
};

/// Period (s) with which the module of the deep lowering bounces: k (N/m) of the wire, its vessel's stiffness against
/// pitch (N m/rad). Of the modes of heave, pitch and module the one in which the module has most of the energy.
double bounce_of(double k, double pitch_stiffness) {
  const double lever = 56.0, cog = 0.769,
               mass = 7280e3;  // the sheave rises by the heave and, bow down, by 56 m of the turn
  Matrix3 M, K;
  M << mass + 8000e3, -mass * cog, 0, -mass * cog, mass * (25.0 * 25.0 + cog * cog + 1.0) + 4.0e9, 0, 0, 0, 180e3;
  K << kRho * 1e3 * kG * 100.0 * 20.0, 0, 0, 0, pitch_stiffness, 0, 0, 0, 0;
  const Vector3 stretch(1.0, lever, -1.0);
  K += k * stretch * stretch.transpose();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix3> modes(K, M);
  int most = 0;
  modes.eigenvectors().row(2).cwiseAbs().maxCoeff(&most);
  return 2.0 * kPi / std::sqrt(modes.eigenvalues()[most]);
}

}  // namespace

TEST_CASE("a pedestal crane slews 90 degrees from its own deck: loads, heel, leads by the boom, place") {
  const HandLift lift("slewing_crane");

  // Without a load the luffing wire holds the boom at 60 deg: 80 t at 20 m, about the hinge. In the house, from the
  // ring: hinge (2.5, 2), A-frame (-6, 14), tip (2.5 + 21, 2 + 36.373); the wire is 38.27 m long and passes the hinge
  // at 14.66 m.
  const double hinge_x = 2.5, hinge_z = 2.0, reach = 42.0 * std::cos(60.0 * kDegree);
  const double rise = 42.0 * std::sin(60.0 * kDegree);
  const double wire_x = hinge_x + reach + 6.0, wire_z = hinge_z + rise - 14.0, wire = std::hypot(wire_x, wire_z);
  const double arm = std::abs(wire_x * (hinge_z - 14.0) - wire_z * (hinge_x + 6.0)) / wire;
  const double boom_moment = 80.0 * 20.0 * std::cos(60.0 * kDegree);                               // t m
  CHECK(lift.at("start", "luffing.tension") == Approx(boom_moment / arm * kTonne).epsilon(1e-5));  // rounded input

  // With the skid the wire stretches and the boom goes down by it, first order: 0.25 deg, of which the square is left
  // out (0.0044 rad: 1 % of the change of the moments, which is 0.8 % of them).
  CHECK(lift.at("hoist_up", "fall.tension") == Approx(120.0 * kTonne).epsilon(1e-6));  // at rest it hangs plumb
  const double stretch = 120.0 * reach / arm * kTonne / (1.0e9 / wire);
  const double angle = 60.0 * kDegree - stretch / arm;
  const double moment = 120.0 * 42.0 * std::cos(angle) + 80.0 * 20.0 * std::cos(angle);
  CHECK(lift.at("hoist_up", "luffing.tension") == Approx(moment / arm * kTonne).epsilon(3e-3));

  // Outboard: the crane's moment to port less the ballast's, against the stability of a box of 90 x 26 m, draft 4.5 m,
  // with the skid's weight at the boom's tip. A wall-sided hull rights itself with GM sin + BM/2 tan^2 sin.
  const double radius = hinge_x + 42.0 * std::cos(angle), tip_z = 12.0 + hinge_z + 42.0 * std::sin(angle);
  const double boom_x = hinge_x + 20.0 * std::cos(angle), boom_z = 12.0 + hinge_z + 20.0 * std::sin(angle);
  const double displacement = 90.0 * 26.0 * 4.5 * kRho;
  const double heeling = 120.0 * radius + 80.0 * boom_x - 250.0 * 2.0 - 80.0 * 20.0;
  const double heights = 10343.25 * 1.5 + 250.0 * 14.0 + 80.0 * boom_z + 120.0 * tip_z;
  const double BM = 26.0 * 26.0 / (12.0 * 4.5), GM = -2.25 + BM - heights / displacement;
  double heel = heeling / (displacement * GM);
  heel = heeling * std::cos(heel) / (displacement * (GM + 0.5 * BM * std::tan(heel) * std::tan(heel)));
  CHECK(heel / kDegree == Approx(1.20).margin(0.01));
  // 1 %: the boom goes down a little more as the vessel heels (0.01 deg), and the lines' pull is left out.
  CHECK(lift.at("slew_out", "vessel.roll") == Approx(-heel).epsilon(0.01));
  CHECK(lift.metric("heel_static_max") == Approx(heel / kDegree).epsilon(0.01));
  // Trim: what was aft of the pedestal comes abreast of it. GM of 145 m lengthwise: 90^2 / (12 4.5) and what is above.
  const double GM_l = -2.25 + 90.0 * 90.0 / (12.0 * 4.5) - heights / displacement;
  const double trim = (120.0 * radius + 80.0 * boom_x - 250.0 * 2.0) / (displacement * GM_l);
  CHECK(lift.at("slew_out", "vessel.pitch") ==
        Approx(trim).epsilon(0.02));  // two angles at once, 0.02 rad: second order

  // The skid hangs under the tip: out by the radius, and by the tip's height times the heel; forward by the trim.
  const double out = radius * std::cos(heel) + tip_z * std::sin(heel);
  CHECK(lift.at("slew_out", "skid.y") == Approx(out).margin(0.03));  // of the 1 % of 1.04 m, and the boom's 0.01 deg
  CHECK(lift.at("slew_out", "skid.x") == Approx(10.0 + tip_z * trim).margin(0.02));
  CHECK(lift.at("slew_out", "skid.yaw") == Approx(0.0).margin(1e-6));  // nothing turns a load on one wire

  // Slewing begins and ends with half a sine of acceleration across the boom, pi/16 of 0.5 deg/s over 8 s at the
  // radius: side-lead, whatever way the vessel heads. A pendulum of 12 s answers with at most
  //   sin(2 pi b / (1 + b)) / (1 - b) of the static angle,   b = T / (2 * 8 s)
  // within the pulse (Chopra, Dynamics of Structures, response to a half-cycle sine). The period is that of the skid on
  // the wire, 3 m above its centre of gravity. 5 %: the wire's angle is not quite the pendulum's, and the vessel
  // yields.
  const double length = lift.at("hoist_up", "fall.length") + 3.0, T = 2.0 * kPi * std::sqrt(length / kG);
  const double pulse = 0.5 * kDegree * radius * kPi / (2.0 * 8.0) / kG, b = T / 16.0;
  const double side_lead = pulse * std::sin(2.0 * kPi * b / (1.0 + b)) / (1.0 - b);
  CHECK(side_lead / kDegree == Approx(0.41).margin(0.01));
  CHECK(lift.metric("sidelead_max") == Approx(side_lead / kDegree).epsilon(0.05));

  // Set down, the wire unloads: the vessel heels back, the tip goes inward over the skid that stays. Of the hanging
  // weight a tenth is the least that counts for a lead. The heel then, and the tip's way to it by heel and the boom's
  // rise:
  const double left = 12.0, afloat = displacement - 120.0 + left;
  const double then = (left * radius + 80.0 * boom_x - 250.0 * 2.0 - 80.0 * 20.0) /
                      (afloat * (-0.5 * afloat / (90.0 * 26.0 * kRho) + BM * displacement / afloat -
                                 (heights - 108.0 * tip_z) / afloat + 4.5 - afloat / (90.0 * 26.0 * kRho)));
  const double way = tip_z * (heel - then) + 42.0 * std::sin(angle) * (60.0 * kDegree - angle) * (120.0 - left) / 120.0;
  const double off_lead = std::asin(way / lift.at("lower", "fall.length"));
  CHECK(off_lead / kDegree == Approx(2.37).margin(0.05));
  // 4 %: angles of 0.03 rad, samples of 0.2 s while the tension falls through the tenth.
  CHECK(lift.metric("offlead_max") == Approx(off_lead / kDegree).epsilon(0.04));

  // It lands where it hung, but for its swing after the slewing: the residual of the last pulse, 36 m long.
  const double swing = pulse * 2.0 * b / (1.0 - b * b) * std::abs(std::cos(0.5 * kPi / b)) * length;
  CHECK(swing == Approx(0.25).margin(0.02));
  CHECK(std::abs(lift.last("skid.y") - out) < swing);
  CHECK(std::abs(lift.last("skid.x") - (10.0 + tip_z * trim)) < swing);
  CHECK(lift.last("skid.z") == Approx(6.0).margin(0.013));  // 1,117 kN on 1e5 kN/m
  CHECK(lift.metric("rehits") == 0.0);
}

TEST_CASE("a hook block with four slings: sling tensions by geometry, lift-off, landing and place") {
  const HandLift lift("four_slings");

  // Unstretched slings meet 6 m over the lugs, above the centre of gravity: 3.4 m from the fore lugs, 4.6 m from the
  // aft ones. Each pair takes the weight by the other's lever, each sling half of it over the cosine. Stretch of 0.4 %
  // in all four moves the apex by 3 cm and turns nothing: 1 % of the cosines' change.
  const double fore = 60.0 * 4.6 / 8.0 / 2.0, aft = 60.0 * 3.4 / 8.0 / 2.0;  // t
  const double L_fore = std::sqrt(3.4 * 3.4 + 1.5 * 1.5 + 36.0), L_aft = std::sqrt(4.6 * 4.6 + 1.5 * 1.5 + 36.0);
  for (const char* phase : {"hoist_up", "turn"})
    for (const char* side : {"_port", "_starboard"}) {
      CAPTURE(phase, side);
      const auto tension = [&](const std::string& s) { return lift.at(phase, s + side + ".tension"); };
      CHECK(tension("fore") == Approx(fore * L_fore / 6.0 * kTonne).epsilon(5e-3));
      CHECK(tension("aft") == Approx(aft * L_aft / 6.0 * kTonne).epsilon(5e-3));
    }
  CHECK(lift.at("hoist_up", "fall.tension") == Approx(64.0 * kTonne).epsilon(1e-6));
  CHECK(lift.at("start", "fall.tension") == Approx(4.0 * kTonne).epsilon(1e-6));  // the block alone
  CHECK(lift.at("start", "fore_port.tension") == 0.0);

  // Lift-off at v = 0.05 m/s: the weight passes into the springs of wire and slings, k in series, and the machine is
  // thrown by v sqrt(k m) on top. The block, 4 t between the springs, is left out: 10 % of the excess.
  const double k_fall = 1.0e8 / lift.at("lift_off", "fall.length");
  const double k_slings = 2.0 * 5.0e7 * (36.0 / std::pow(L_fore, 3) + 36.0 / std::pow(L_aft, 3));
  const double k = 1.0 / (1.0 / k_fall + 1.0 / k_slings);
  const double excess = 0.05 * std::sqrt(k * 60e3) / (64.0 * kTonne);
  CHECK(excess == Approx(0.039).margin(0.001));
  CHECK(lift.metric("daf_total") - 1.0 == Approx(excess).epsilon(0.1));
  CHECK(lift.metric("rehits") == 0.0);

  // Turned by 60 deg the centre of gravity is where the tip is, and the heading that of the start.
  const double x = 25.0 * std::cos(60.0 * kDegree) - 0.6, y = 25.0 * std::sin(60.0 * kDegree);
  CHECK(lift.at("turn", "machine.x") == Approx(x).margin(2e-3));  // the slings are to the centimetre
  CHECK(lift.at("turn", "machine.y") == Approx(y).margin(2e-3));
  // The shaper of the turn takes the period of the machine as it hangs: 14.9 m of wire, block, slings and 1.7 m to the
  // centre of gravity, 24.2 m. A point on the wire alone would swing with 7.7 s. 1 %: the load turns as it swings.
  const double T = 2.0 * kPi * std::sqrt((lift.at("turn", "fall.length") + 1.6 + 6.0 + 1.7) / kG);
  CHECK(T == Approx(9.86).margin(0.02));
  const double turning = 60.0 / 0.8 + 10.0;  // s, with a ramp of 10 s; ZVD takes a period more
  CHECK(lift.operation.phases[lift.pose("turn") - 1].duration == Approx(turning + T).epsilon(1e-3));
  // Shaped, the turn leaves hardly a swing: 3 % of what an unshaped ramp may leave, its speed over the pendulum's w.
  // Two causes: the period is 1 % off, which ZVD squares, and the turn's accelerations turn with the crane.
  const double landing = lift.start("lower");
  CHECK(lift.amplitude("machine.x", landing, landing + 2.0 * T) < 0.03 * 0.8 * kDegree * 25.0 * T / (2.0 * kPi));

  // The winch slows down over 10 s from 0.05 m/s, as sin^2; it stops when the wire holds 60 kN, so the machine touches
  // when what is left to pay out is the stretch of 628 - 60 kN. By distance and speed of the ramp at the share u of it
  // left:
  //   v 10 s (u / 2 - sin(pi u) / (2 pi)) = stretch,   speed v sin^2(pi u / 2)
  const double stretch = (64.0 * kTonne - 60e3) / k;
  double u = 1.0;
  for (int i = 0; i < 50; ++i)
    u -= (0.5 * u - std::sin(kPi * u) / (2.0 * kPi) - stretch / (0.05 * 10.0)) / std::pow(std::sin(0.5 * kPi * u), 2);
  // 10 %: the machine still moves on its springs from lift-off and hoisting, by millimetres a second.
  CHECK(lift.metric("setdown_speed") == Approx(0.05 * std::pow(std::sin(0.5 * kPi * u), 2)).epsilon(0.1));
  CHECK(lift.last("machine.x") == Approx(x).margin(0.02));  // what is left of the swing
  CHECK(lift.last("machine.y") == Approx(y).margin(0.02));
  CHECK(lift.last("machine.z") == Approx(4.0).margin(0.003));  // 568 kN on 2e5 kN/m
  CHECK(lift.last("machine.yaw") == Approx(0.0).margin(1.0 * kDegree));
}

TEST_CASE("hand lifts: block and slings said as rigging are the same lift", "[validation]") {
  const HandLift by_hand("four_slings"), rigged("../../docs/examples/rigged_lift");
  for (const char* phase : {"hoist_up", "turn"})
    for (const char* sling : {"fore_port", "fore_starboard", "aft_port", "aft_starboard"})
      CHECK(rigged.at(phase, std::string(sling) + ".tension") ==
            Approx(by_hand.at(phase, std::string(sling) + ".tension")).epsilon(1e-4));
  CHECK(rigged.at("start", "fall.tension") == Approx(4.0 * kTonne).epsilon(0.02));  // slings just straight
  // The load is lifted off from where the slings are straight: the block of the lift by hand began a centimetre off
  // that.
  CHECK(rigged.metric("daf_total") == Approx(by_hand.metric("daf_total")).epsilon(2e-3));
  CHECK(rigged.metric("rehits") == 0.0);
  CHECK(rigged.last("machine.z") == Approx(by_hand.last("machine.z")).margin(1e-3));
}

TEST_CASE("a module lowered 800 m on one wire: weights, stretch, periods, times, landing") {
  const HandLift lift("deep_lowering");

  // 100 t in air, less 4 x 4 x 2.5 m of water below the surface.
  const double wet = 100.0 - 4.0 * 4.0 * 2.5 * kRho;
  CHECK(lift.at("in_air", "wire.tension") == Approx(100.0 * kTonne).epsilon(1e-6));
  for (const char* phase : {"splash_zone", "descent", "hold"})
    CHECK(lift.at(phase, "wire.tension") == Approx(wet * kTonne).epsilon(1e-6));
  CHECK(lift.at("hold", "wire.length") ==
        Approx(lift.at("hold", "wire.unstretched") * (1.0 + wet * kTonne / 2.5e8)).epsilon(1e-9));
  CHECK(lift.at("hold", "module.z") == Approx(-790.0).margin(1e-6));

  // 41 t less in the wire raise the stern: draft by the water plane of 100 x 20 m, trim by 41 t at 56 m against the GM
  // of the box lengthwise, at its draft then, with the wet weight at the sheave 20 m up. First order: 1 %.
  const double afloat = 7380.0 - 41.0, draft = afloat / (100.0 * 20.0 * kRho);
  CHECK(lift.at("hold", "vessel.z") == Approx(3.6 - draft).margin(1e-4));
  const double heights = (7280.0 * 1.0 + wet * 20.0) / afloat;  // above the origin, which is 3.6 m above the keel
  const double GM_l = 0.5 * draft + 100.0 * 100.0 / (12.0 * draft) - (3.6 + heights);
  CHECK(lift.at("hold", "vessel.pitch") == Approx(41.0 * 56.0 / (afloat * GM_l)).epsilon(0.01));

  // On 804 m of wire the module bounces with EA / L and its mass with that of the water, 180 t: 4.8 s on a fixed
  // sheave, which is close to the vessel's pitch. So three equations: heave and pitch of the vessel about its origin,
  // the module.
  const std::vector<Mode> modes = natural_modes(lift.model, lift.operation.equilibria[lift.pose("hold")]);
  const double k = 2.5e8 / lift.at("hold", "wire.unstretched");
  const double bounce = bounce_of(k, 1e3 * afloat * kG * GM_l);
  CHECK(bounce > 2.0 * kPi * std::sqrt(180e3 / k));
  // It swings with 140 t sideways on its weight in water alone, 2 m above the middle of both: 88 s.
  const double swing = 2.0 * kPi * std::sqrt(140.0 / wet * (lift.at("hold", "wire.length") + 2.0) / kG);
  CHECK(swing == Approx(88.0).margin(0.5));
  const int module = lift.model.body_index("module");
  CHECK(period_of(modes, module, 2) == Approx(bounce).epsilon(0.005));  // hulls of a box and small angles: exact but
                                                                        // for draft and trim of the pose
  CHECK(period_of(modes, module, 0) ==
        Approx(swing).epsilon(0.02));  // the vessel goes along on its lines: 1 % of its mass
  CHECK(period_of(modes, module, 1) == Approx(swing).epsilon(0.02));

  // 786.5 m of descent and the stretch that they add, at 1 m/s with ramps of 30 s.
  const double paid_out = lift.at("descent", "wire.unstretched") - lift.at("splash_zone", "wire.unstretched");
  CHECK(paid_out == Approx(786.75 / (1.0 + wet * kTonne / 2.5e8)).margin(1e-3));
  CHECK(lift.operation.phases[lift.pose("descent") - 1].duration == Approx(paid_out + 30.0).epsilon(1e-9));

  // Landing: at the winch's 6 m/min, within 2 % (what the bouncing leaves), on 10 MN/m with all but 20 kN of the
  // weight.
  CHECK(lift.metric("setdown_speed") == Approx(0.1).epsilon(0.02));
  CHECK(lift.last("module.z") == Approx(-800.0 - (wet * kTonne - 20e3) / 1.0e7).margin(1e-3));
  CHECK(lift.last("wire.tension") == Approx(20e3).epsilon(0.02));
  // Under the sheave, which the trim has moved forward by 20 m of it; no force goes sideways in calm water.
  CHECK(lift.last("module.x") == Approx(-56.0 + 20.0 * lift.at("hold", "vessel.pitch")).margin(0.02));
  CHECK(lift.last("module.y") == Approx(0.0).margin(1e-6));
  // Nothing jerks in calm water. Going down at 1 m/s the water carries 10 + 20 kN by drag, the largest relief that
  // there is but for starting: 180 t at pi / 2 of 1 m/s over 30 s, while there is half the drag at most.
  CHECK(lift.metric("slack_ratio_min") == Approx(1.0 - 30e3 / (wet * kTonne)).margin(0.01));
  CHECK(lift.metric("daf_total") < 1.03);
}

TEST_CASE("a module on 800 m of wire in a swell: the wire amplifies what the sheave does") {
  const HandLift lift("deep_lowering", {{"sea.active", "swell"}});
  // The last 200 s of the hold: what the descent left has died away, the swell of 9 s goes on.
  const double end = lift.start("land"), from = end - 200.0;
  std::vector<double> sheave;
  double low = 1e30, high = -1e30;
  const std::vector<double>&z = lift.series("module.z"), &length = lift.series("wire.length");
  for (std::size_t i = 0; i < z.size(); ++i)
    if (lift.run.time[i] >= from && lift.run.time[i] <= end) {
      low = std::min(low, z[i] + length[i]);  // plumb: the swing's cosine is 1 - 1e-7
      high = std::max(high, z[i] + length[i]);
    }
  const double excursion = 0.5 * (high - low);
  CHECK(excursion > 0.2);  // m: otherwise there is nothing to amplify
  // One mass on a spring and a damper, driven at its upper end: (k + iwc) / (k + iwc - w^2 m + iwb), with the drag's
  // b = 10 kN s/m + 8 / (3 pi) 20 kN s2/m2 of the speed. A square law made linear, and the recorded samples: 0.5 %.
  const double k = 2.5e8 / lift.at("hold", "wire.unstretched"), m = 180e3, w = 0.7;
  double amplitude = excursion, force = 0.0;
  for (int i = 0; i < 20; ++i) {
    const double b = 10e3 + 8.0 / (3.0 * kPi) * 20e3 * w * amplitude;
    const std::complex<double> spring(k, w * 10e3), inertia(-w * w * m, w * b);
    amplitude = std::abs(spring / (spring + inertia)) * excursion;
    force = std::abs(inertia) * amplitude;
  }
  CHECK(amplitude / excursion == Approx(1.39).margin(0.01));  // 1 / (1 - w^2 m / k) without damping: 1.396
  CHECK(lift.amplitude("module.z", from, end) == Approx(amplitude).epsilon(0.005));
  // The wire carries what moves the module. 3 %: the third harmonic of the square law, a fifth of 13 kN of 103.
  CHECK(lift.amplitude("wire.tension", from, end) == Approx(force).epsilon(0.03));
}

TEST_CASE("two vessels lift one topside: share of load, draft, trim with ballast, leads, place") {
  const HandLift lift("two_vessels");

  // 1,500 t, 14 m from the west falls and 10 m from the east ones.
  const double west = 1500.0 * 10.0 / 24.0, east = 1500.0 * 14.0 / 24.0;
  for (const char* phase : {"lift_off", "hoist_up", "come_to_rest", "lower"}) {
    CAPTURE(phase);
    // Level to the millimetre over 24 m and plumb to the centimetre: 1e-4.
    for (const char* side : {"port", "starboard"}) {
      CHECK(lift.at(phase, std::string("west_") + side + ".tension") == Approx(0.5 * west * kTonne).epsilon(1e-3));
      CHECK(lift.at(phase, std::string("east_") + side + ".tension") == Approx(0.5 * east * kTonne).epsilon(1e-3));
    }
    // Each sinks by its share over the water plane of 70 x 30 m, and the ballast keeps it level: 700 and 980 t aft by
    // 49.107 m against the share at 55 m, to a tonne metre.
    CHECK(lift.at(phase, "west.z") == Approx(-west / (70.0 * 30.0 * kRho)).epsilon(1e-3));
    CHECK(lift.at(phase, "east.z") == Approx(-east / (70.0 * 30.0 * kRho)).epsilon(1e-3));
    for (const char* vessel : {"west", "east"}) {
      CHECK(std::abs(lift.at(phase, std::string(vessel) + ".pitch")) < 0.01 * kDegree);
      CHECK(std::abs(lift.at(phase, std::string(vessel) + "_port.off_lead")) < 0.02 * kDegree);
    }
  }
  // Hook loads as they are judged, each and together: over ten minutes nothing goes faster than 4 m/min, and what
  // swings adds less than 1 % (0.3 m/s2 would be 3 %; the ramps are of a hundredth of that).
  CHECK(lift.metric("hook_load_max.west") == Approx(west * 9.80665).epsilon(0.01));
  CHECK(lift.metric("hook_load_max.east") == Approx(east * 9.80665).epsilon(0.01));
  CHECK(lift.metric("hook_load_max") == Approx(1500.0 * 9.80665).epsilon(0.005));
  CHECK(lift.metric("hook_load_max") >= 1500.0 * 9.80665);
  // All is symmetric about the line of the vessels but for the tow across it, at 0.1 m/s: side-lead of the tow's pulse,
  // pi / (2 60 s) of its speed, over g.
  CHECK(lift.metric("sidelead_max") < 3.0 * 4.0 / 60.0 * kPi / 120.0 / kG / kDegree);

  // On the foundation, 20 m north: wires at 300 and 400 kN by the goal, two a vessel, and the ballast back where it
  // was. Then the hook alone trims: its tip goes forward over the fall's lower end, which stays.
  CHECK(lift.at("land", "topside.y") == Approx(20.0).margin(1e-3));
  for (const auto& [vessel, tension, side] : {std::tuple{"west", 300e3, -1.0}, std::tuple{"east", 400e3, 1.0}}) {
    CAPTURE(vessel);
    const std::string name = vessel;
    const double hook = 2.0 * tension / kTonne, afloat = 7533.75 + hook, draft = afloat / (70.0 * 30.0 * kRho);
    const double heights = (7133.75 * 1.0 + 400.0 * 25.0 + hook * 60.0) / afloat + 3.5;  // over the keel
    const double GM_l = 0.5 * draft + 70.0 * 70.0 / (12.0 * draft) - heights, trim = hook * 55.0 / (afloat * GM_l);
    CHECK(lift.at("land", name + "_port.tension") == Approx(tension).epsilon(1e-3));
    CHECK(lift.at("land", name + ".pitch") == Approx(trim).epsilon(0.02));
    // The tip is 60 m up; outwards of the boom is positive, so the lead is against it. The moorings give way by some
    // centimetres of the 0.25 m, and the topside has come down within a centimetre or three of its place.
    const double lead = -60.0 * trim / lift.at("land", name + "_port.length");
    CHECK(lift.at("land", name + "_port.off_lead") == Approx(lead).margin(0.1 * kDegree));
    CHECK(lift.at("land", name + "_port.side_lead") == Approx(0.0).margin(0.01 * kDegree));
  }
  CHECK(lift.last("topside.x") == Approx(0.0).margin(0.05));
  CHECK(lift.last("topside.y") == Approx(20.0).margin(0.05));
  CHECK(lift.last("topside.z") == Approx(9.0 - (1500.0 * kTonne - 1.4e6) / 2.0e8).margin(5e-3));
  CHECK(lift.metric("rehits") == 0.0);
}
