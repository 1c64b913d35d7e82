// A load on a crane's wire: snap out of slack, a pendulum whose wire is hauled in, a hook that heaves.
#include <catch2/catch.hpp>
#include <cmath>

#include "sim/lifting/wire.h"
#include "sim/multibody/joint_drive.h"
#include "tests/sim/mechanism.h"

using namespace stillhook;

namespace {

constexpr double kG = 9.80665;
constexpr double kMass = 5e5;     // kg, half of a 1,000 t load
constexpr double kEA = 3.31e9;    // N, 20 falls of 64 mm rope
constexpr double kLength = 80.0;  // m
constexpr double kStiffness = kEA / kLength;

std::unique_ptr<Wire> hoist_wire(const BodyPoint& from, double damping_ratio, int drive = -1) {
  WireOptions o;
  o.name = "hoist";
  o.from = from;
  o.to = {static_cast<int>(from.body == kWorld ? 0 : 1), Vector3::Zero()};
  o.axial_stiffness = kEA;
  o.unstretched_length = kLength;
  o.damping = wire_damping(damping_ratio, kMass, kEA, kLength);
  o.drive = drive;
  return std::make_unique<Wire>(o);
}

const Vector3 kSheave(30.0, 15.0, 106.0);

// The load starts `slack` metres above where the wire comes taut and falls at `speed`; largest tension of the first
// 1.5 s (the snap and the rebound) as the steps see it.
double snap_peak(double damping_ratio, double slack, double speed, double h) {
  truth::GeneralMotion draw(31);
  Mechanism m;
  BodyKinematics at;
  at.R_WB = draw.rotation();
  at.p_WC = kSheave - Vector3(0.0, 0.0, kLength - slack);
  at.v_WC = Vector3(0.0, 0.0, -speed);
  m.add_body("load", kMass, general_inertia(draw, 1e6), at);
  auto wire = hoist_wire({kWorld, kSheave}, damping_ratio);
  const Wire& hoist = *wire;
  m.system.elements.push_back(std::move(wire));
  m.finish();
  HhtStepper stepper(m.system, {-0.1, 1e-4, 12});
  double peak = 0.0;
  const int steps = static_cast<int>(std::lround(1.5 / h));
  for (int k = 0; k < steps; ++k) {
    REQUIRE(stepper.step(m.state, h, m.state.drive));
    peak = std::max(peak, hoist.tension(m.state.instant()));
  }
  return peak;
}

}  // namespace

TEST_CASE("snap without damping: T = W + sqrt(W^2 + k m v^2)") {
  const double W = kMass * kG;
  for (const double slack : {0.0, 0.004, 0.013})
    for (const double speed : {0.0, 0.23, 0.5}) {
      if (slack == 0.0 && speed == 0.0) continue;
      CAPTURE(slack, speed);
      const double v2 = speed * speed + 2.0 * kG * slack;
      // 0.002 s is 1/350 of the period: the steps miss the crest by 4e-5, the method's own damping takes 1e-4.
      CHECK(snap_peak(0.0, slack, speed, 0.002) ==
            Approx(W + std::sqrt(W * W + kStiffness * kMass * v2)).epsilon(5e-4));
    }
}

TEST_CASE("snap with 2 % damping: the peak does not depend on the step") {
  // 0.05 s is 1/14 of the period, so where the load meets the end of its slack within a step matters: ten slacks.
  for (int i = 0; i < 10; ++i) {
    const double slack = 0.013 + 0.0025 * i, speed = 0.01 * i;  // 0.5 to 0.9 m/s when the wire comes taut
    const double fine = snap_peak(0.02, slack, speed, 0.002);
    CAPTURE(slack, fine, snap_peak(0.02, slack, speed, 0.05) / fine, snap_peak(0.02, slack, speed, 0.02) / fine);
    CHECK(snap_peak(0.02, slack, speed, 0.05) == Approx(fine).epsilon(0.02));
    CHECK(snap_peak(0.02, slack, speed, 0.02) == Approx(fine).epsilon(0.02));
  }
}

TEST_CASE("a pendulum shortened slowly keeps E/omega") {
  truth::GeneralMotion draw(32);
  Mechanism m;
  BodyKinematics at;
  const double stretched = kLength * (1.0 + kMass * kG / kEA), swing = 0.07;  // rad
  at.R_WB = draw.rotation();
  at.p_WC = kSheave + stretched * Vector3(std::sin(swing), 0.0, -std::cos(swing));
  m.add_body("load", kMass, general_inertia(draw, 1e6), at);
  m.system.elements.push_back(hoist_wire({kWorld, kSheave}, 0.02, 0));
  m.state.drive.resize(1);
  m.finish();
  // From 80 m to 40 m at 0.08 m/s: 1.8 % of the length in a period, so the invariant ripples by about half of that
  // within a cycle and its mean over a cycle is kept to the square of it.
  const double h = 0.02, speed = 0.08, wait = 40.0, haul = 500.0, ramp = 20.0, end = wait + haul + ramp + 40.0;
  HhtStepper stepper(m.system, {-0.1, 1e-6, 12});
  double before = 0.0, after = 0.0;
  int n_before = 0, n_after = 0;
  double position = 0.0;
  const auto cycle = [](double l) { return 2.0 * M_PI * std::sqrt(l / kG); };
  for (int k = 1; k * h <= end; ++k) {
    const double t = k * h;
    const double share = std::clamp(std::min((t - wait) / ramp, (wait + haul + ramp - t) / ramp), 0.0, 1.0);
    position += h * speed * share;
    const DriveState d{position, speed * share};
    REQUIRE(stepper.step(m.state, h, std::vector<DriveState>{d}));
    const Vector3 r = m.state.body[0].p_WC - kSheave;
    const double l = r.norm(), across = (m.state.body[0].v_WC - r * (r.dot(m.state.body[0].v_WC) / (l * l))).norm();
    // Small swings: the term in theta^4 is 4e-4 of the energy at 4 deg.
    const double action = (0.5 * kMass * across * across + kMass * kG * (l + r.z())) * std::sqrt(l / kG);
    if (t < 2.0 * cycle(kLength)) before += action, ++n_before;
    if (t > end - 2.0 * cycle(kLength - position)) after += action, ++n_after;
  }
  CHECK(position == Approx(speed * haul).margin(1e-6));
  // The energy itself grows by sqrt(2): a law that kept E or the angle would miss by 40 %.
  CHECK((after / n_after) == Approx(before / n_before).epsilon(0.01));
}

TEST_CASE("a hook that heaves under a hung load amplifies by 1/(1 - (omega/omega_n)^2)") {
  // A heavy base on a driven slide carries the sheave. The load's motion is fitted with the forced and the free
  // frequency, so the start does not matter.
  const double omega_n = std::sqrt(kStiffness / kMass), h = 0.005, base_amplitude = 0.01;
  for (const double ratio : {0.2, 0.4, 0.6, 1.5, 2.0}) {
    CAPTURE(ratio);
    const double omega = ratio * omega_n;
    truth::GeneralMotion draw(33);
    Mechanism m;
    BodyKinematics base, load;
    base.R_WB = draw.rotation();
    base.p_WC = kSheave;
    load.R_WB = draw.rotation();
    const double rest = kSheave.z() - kLength - kMass * kG / kStiffness;
    load.p_WC = Vector3(kSheave.x(), kSheave.y(), rest);
    m.add_body("base", 1e6, general_inertia(draw, 1e6), base);
    m.add_body("load", kMass, general_inertia(draw, 1e6), load);
    m.add_joint("slide", JointSpec::Type::prismatic, kWorld, 0, kSheave, Vector3::UnitZ());
    const double stiff = 1e6 * 4e4;  // 200 rad/s: the base follows its drive, and is measured anyway
    m.system.elements.push_back(std::make_unique<JointDrive>(std::string("heave"), m.system.joints[0], stiff, 2e8,
                                                             (1e6 + kMass) * kG / stiff, 0));
    m.system.elements.push_back(hoist_wire({0, Vector3::Zero()}, 0.0));
    m.state.drive.resize(1);
    m.finish();
    HhtStepper stepper(m.system, {-0.05, 1e-8, 12});
    const int steps = static_cast<int>(30.0 / h), skipped = static_cast<int>(2.0 / h);
    MatrixX terms(steps - skipped, 5);
    MatrixX motion(steps - skipped, 2);
    for (int k = 1; k <= steps; ++k) {
      const double t = k * h, soft = std::min(1.0, t / 2.0);  // the drive grows from rest over 2 s
      const double rate =
          base_amplitude * (soft * omega * std::cos(omega * t) + (t < 2.0 ? 0.5 * std::sin(omega * t) : 0.0));
      REQUIRE(stepper.step(m.state, h, std::vector<DriveState>{{base_amplitude * soft * std::sin(omega * t), rate}}));
      if (k <= skipped) continue;
      terms.row(k - skipped - 1) << 1.0, std::sin(omega * t), std::cos(omega * t), std::sin(omega_n * t),
          std::cos(omega_n * t);
      motion.row(k - skipped - 1) << m.state.body[0].p_WC.z() - kSheave.z(), m.state.body[1].p_WC.z() - rest;
    }
    const MatrixX fit = terms.colPivHouseholderQr().solve(motion);
    // The load's forced motion in phase with the base's, signed.
    const double daf = fit(1, 1) / fit(1, 0);
    // (omega_n h)^2/12 = 2e-4 for the period, times the slope of the formula, up to 3; the free part's own damping
    // 2e-3.
    CHECK(daf == Approx(1.0 / (1.0 - ratio * ratio)).epsilon(0.005));
  }
}
