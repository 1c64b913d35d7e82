// The integrator: order, amplification, damping, conservation, failure, steps that change.
#include "sim/multibody/hht.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "sim/multibody/joint_drive.h"
#include "tests/sim/mechanism.h"
#include "tests/truth/oscillator.h"
#include "tests/truth/pendulums.h"

using namespace stillhook;
using truth::GeneralMotion;
using Type = JointSpec::Type;

namespace {

constexpr double kArm = 1.3, kAcross = 0.7, kMass = 2.5;
const Vector3 kJoint(-1.0, 0.5, 2.0);

// Started in motion, with large accelerations that change fast: the hardest start for the multipliers.
Mechanism spherical_pendulum(truth::SphericalPendulum::Vec& start) {
  Mechanism m;
  const Vector3 n = Vector3(0.6, -0.3, -0.9).normalized(), n_dot = n.cross(Vector3(0.4, 1.8, 0.9));
  BodyKinematics at;
  at.R_WB = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitX(), n).toRotationMatrix();
  at.p_WC = kJoint + kArm * n;
  m.add_body("bob", kMass, Vector3(0.2, kAcross, kAcross).asDiagonal(), at);
  m.add_joint("ball", Type::spherical, kWorld, 0, kJoint);
  m.spin(0, kJoint, n.cross(n_dot));
  m.finish();
  start.head<3>() = n;
  start.tail<3>() = n_dot;
  return m;
}

// Largest errors in position (m), velocity (m/s) and joint force (N) at twenty instants after `from`.
Vector3 pendulum_errors(const HhtOptions& options, double h, double from, double change = 1.0) {
  truth::SphericalPendulum::Vec y;
  Mechanism m = spherical_pendulum(y);
  const truth::SphericalPendulum exact{kMass, kArm, kAcross + kMass * kArm * kArm, m.system.gravity};
  HhtStepper stepper(m.system, options);
  Vector3 worst = Vector3::Zero();
  for (int i = 1; i <= 20; ++i) {
    const double step = i % 4 < 2 ? h : h * change;  // changes every 0.2 s
    if (!run_to(stepper, m.state, 0.1 * i, static_cast<int>(std::round(0.1 / step)))) return Vector3::Constant(1e9);
    if (m.state.t < from) continue;
    const auto e = exact.at(m.state.t, y);
    worst[0] = std::max(worst[0], (m.state.body[0].p_WC - kJoint - kArm * e.head<3>()).norm());
    worst[1] = std::max(worst[1], (m.state.body[0].v_WC - kArm * e.tail<3>()).norm());
    worst[2] = std::max(worst[2], (m.reaction(0) - exact.joint_force(e)).norm());
  }
  return worst;
}

// A spring and damper that acts on one body along z alone, linear at any deflection.
class UprightSpring : public ForceElement {
 public:
  UprightSpring(double k, double c) : ForceElement(std::string("spring")), k_(k), c_(c) {}
  void add_forces(const Instant& now, double, Memory, ForceSum& out) const override {
    out.add(0, Vector3(0, 0, -k_ * now.body[0].p_WC.z() - c_ * now.body[0].v_WC.z()), Vector3::Zero());
  }
  void add_jacobian(const Instant&, double, Memory, JacobianSum& out) const override {
    Matrix6 m = Matrix6::Zero();
    m(2, 2) = -k_;
    out.add_stiffness(0, 0, m);
    m(2, 2) = -c_;
    out.add_damping(0, 0, m);
  }

 private:
  double k_, c_;
};

// One mass released at rest 1 mm above where its spring holds it.
Mechanism oscillator(double omega, double zeta) {
  Mechanism m;
  const double mass = 3.0;
  BodyKinematics at;
  at.R_WB = GeneralMotion(3).rotation();
  at.p_WC = Vector3(0.0, 0.0, 1e-3);
  m.add_body("mass", mass, mass * Matrix3::Identity(), at);
  m.system.elements.push_back(std::make_unique<UprightSpring>(mass * omega * omega, 2.0 * zeta * omega * mass));
  m.system.gravity = 0.0;
  m.finish();
  return m;
}

std::vector<double> record(HhtStepper& stepper, SystemState& state, double h, int steps) {
  std::vector<double> z;
  for (int k = 0; k < steps; ++k) {
    if (!stepper.step(state, h, state.drive)) return {};
    z.push_back(state.body[0].p_WC.z());
  }
  return z;
}

}  // namespace

TEST_CASE("hht: second order in positions, velocities and multipliers from a start in motion") {
  // Not at alpha = 0: with constraints its multipliers are weakly unstable, see hht.h.
  for (const double alpha : {-0.05, -0.1, -0.3}) {
    const HhtOptions options{alpha, 1e-9, 12};
    // The transient of the start, k (1 + alpha)^k / (1 - alpha)^k after k steps, has died out after ten steps at -0.1
    // and after a hundred at -0.05.
    const double from = alpha > -0.1 ? 0.95 : 0.0;
    const Vector3 coarse = pendulum_errors(options, 0.01, from), fine = pendulum_errors(options, 0.005, from);
    for (int k = 0; k < 3; ++k) {
      CAPTURE(alpha, k, coarse[k], fine[k]);
      // Halving the step divides the error by 4 (order 2.0); 3.5 is order 1.8. First order would give 2.
      CHECK(coarse[k] / fine[k] > 3.5);
      CHECK(fine[k] > 1e-7);  // far above what Newton leaves
    }
  }
}

TEST_CASE("hht: the first step of a start in motion, and the first after a change of step, err by the third order") {
  // x'' = -omega^2 x from x = 1 mm at 1 m/s: the acceleration changes at once. Were it taken at t0 (or left where the
  // last step had it) instead of at t0 + alpha h, the speed would err by alpha h^2 / 2 times its rate: second order.
  const double omega = 2.0 * M_PI, alpha = -0.3;
  const auto error_of_speed = [&](double h, bool changed) {
    Mechanism m = oscillator(omega, 0.0);
    m.state.body[0].v_WC.z() = 1.0;
    HhtStepper stepper(m.system, {alpha, 1e-12, 12});
    // After a change, against the exact motion from where the last of the shorter steps ended.
    if (changed) {
      Mechanism same = oscillator(omega, 0.0);
      same.state.body[0].v_WC.z() = 1.0;
      HhtStepper steady(same.system, {alpha, 1e-12, 12});
      for (int k = 0; k < 8; ++k) steady.step(same.state, h / 4, {});
      const double v0 = same.state.body[0].v_WC.z(), x0 = same.state.body[0].p_WC.z();
      steady.step(same.state, h, {});
      const double exact = v0 * std::cos(omega * h) - omega * x0 * std::sin(omega * h);
      return std::abs(same.state.body[0].v_WC.z() - exact);
    }
    stepper.step(m.state, h, {});
    const double exact = std::cos(omega * h) - omega * 1e-3 * std::sin(omega * h);
    return std::abs(m.state.body[0].v_WC.z() - exact);
  };
  for (const bool changed : {false, true}) {
    CAPTURE(changed);
    CHECK(error_of_speed(0.01, changed) / error_of_speed(0.005, changed) > 7.0);  // third order: 8; second: 4
  }
}

TEST_CASE("hht: steps that change keep the second order") {
  const HhtOptions options{-0.2, 1e-9, 12};
  const Vector3 coarse = pendulum_errors(options, 0.01, 0.0, 0.5), fine = pendulum_errors(options, 0.005, 0.0, 0.5);
  for (int k = 0; k < 3; ++k) {
    CAPTURE(k, coarse[k], fine[k]);
    CHECK(coarse[k] / fine[k] > 3.3);
  }
}

TEST_CASE("hht: amplification of an oscillator is that of the analytical matrix") {
  const double h = 0.01;
  for (const double alpha : {0.0, -0.1, -0.3})
    for (const double omega_h : {0.05, 0.5, 2.0, 20.0, 1000.0}) {
      CAPTURE(alpha, omega_h);
      Mechanism m = oscillator(omega_h / h, 0.0);
      HhtStepper stepper(m.system, {alpha, 1e-10, 12});
      const Eigen::Matrix3d A = truth::amplification(alpha, 0.0, omega_h);
      const double radius = A.eigenvalues().cwiseAbs().maxCoeff();
      // At rest, in mm.
      Vector3 expected(1.0, 0.0, -omega_h * omega_h);
      const std::vector<double> z = record(stepper, m.state, h, 60);
      REQUIRE(z.size() == 60);
      for (double value : z) {
        expected = A * expected;
        // What Newton leaves, 1e-9 m/s2 of up to 1e7, and what rounding leaves of the rate of the first acceleration.
        CHECK(1e3 * value == Approx(expected[0]).margin(1e-6));
      }
      // The recorded motion decays as the largest root says: fit its own recurrence to the first twelve samples.
      if (omega_h <= 2.0 && alpha < 0.0) {
        const std::vector<double> early(z.begin(), z.begin() + 12);
        CHECK(truth::roots_of(early, 3).cwiseAbs().maxCoeff() == Approx(radius).epsilon(1e-6));
      }
    }
  // Theory: unconditionally stable, no damping at alpha = 0, (1 + alpha)/(1 - alpha) for very stiff ones at -0.1 and
  // -0.3
  CHECK(truth::amplification(0.0, 0.0, 7.0).eigenvalues().cwiseAbs().maxCoeff() == Approx(1.0));
  for (const double alpha : {-0.1, -0.3})
    CHECK(truth::amplification(alpha, 0.0, 1e6).eigenvalues().cwiseAbs().maxCoeff() ==
          Approx((1.0 + alpha) / (1.0 - alpha)).epsilon(1e-5));
}

TEST_CASE("hht: a damping ratio of 0.1 is a damping ratio of 0.1") {
  // Period 1 s. What the method adds is of order alpha (omega h)^3 and zeta (omega h)^2: at h = 0.01 s omega h is
  // 0.063, which is 1e-4 at alpha = -0.3. So 0.001 holds for every setting offered.
  const double omega = 2.0 * M_PI, zeta = 0.1;
  for (const double h : {0.01, 0.001})
    for (const double alpha : {0.0, -0.05, -0.1, -0.3}) {
      CAPTURE(h, alpha);
      const int steps = static_cast<int>(5.0 / h), skipped = static_cast<int>(0.5 / h);
      {
        Mechanism m = oscillator(omega, zeta);
        HhtStepper stepper(m.system, {alpha, 1e-8, 12});
        const std::vector<double> z = record(stepper, m.state, h, steps);
        REQUIRE(z.size() == static_cast<std::size_t>(steps));
        CHECK(truth::damping_ratio({z.begin() + skipped, z.end()}) == Approx(zeta).margin(0.001));
      }
      {  // a body on a sprung slide
        Mechanism m;
        BodyKinematics at;
        at.R_WB = GeneralMotion(4).rotation();
        m.add_body("slider", 3.0, 2.0 * Matrix3::Identity(), at);
        m.add_joint("slide", Type::prismatic, kWorld, 0, Vector3(1, 2, 3), Vector3::UnitZ());
        m.system.elements.push_back(std::make_unique<JointDrive>(std::string("spring"), m.system.joints[0],
                                                                 3.0 * omega * omega, 6.0 * zeta * omega, 0.0, -1));
        m.state.body[0].p_WC += 0.7 * Vector3::UnitZ();
        m.system.gravity = 0.0;
        m.finish();
        HhtStepper stepper(m.system, {alpha, 1e-8, 12});
        const std::vector<double> z = record(stepper, m.state, h, steps);
        REQUIRE(z.size() == static_cast<std::size_t>(steps));
        CHECK(truth::damping_ratio({z.begin() + skipped, z.end()}) == Approx(zeta).margin(0.001));
      }
      {  // a wheel on a sprung hinge
        Mechanism m;
        BodyKinematics at;
        m.add_body("wheel", 3.0, 2.0 * Matrix3::Identity(), at);
        m.add_joint("hinge", Type::revolute, kWorld, 0, Vector3::Zero(), Vector3(1, 2, 3));
        m.system.elements.push_back(std::make_unique<JointDrive>(std::string("spring"), m.system.joints[0],
                                                                 2.0 * omega * omega, 4.0 * zeta * omega, 0.0, -1));
        m.state.body[0].R_WB = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
        m.system.gravity = 0.0;
        m.finish();
        HhtStepper stepper(m.system, {alpha, 1e-8, 12});
        std::vector<double> angle;
        for (int k = 0; k < steps; ++k) {
          REQUIRE(stepper.step(m.state, h, {}));
          if (k >= skipped) angle.push_back(m.system.joints[0].coordinate(m.state.instant()));
        }
        CHECK(truth::damping_ratio(angle) == Approx(zeta).margin(0.001));
      }
    }
}

TEST_CASE("hht: constraints hold, energy neither grows nor fades beyond the method's own damping") {
  for (const double alpha : {-0.05, -0.1}) {
    truth::SphericalPendulum::Vec y;
    Mechanism m = spherical_pendulum(y);
    HhtStepper stepper(m.system, {alpha, 1e-8, 12});
    const double E0 = m.system.kinetic_energy(m.state) + m.system.potential_energy(m.state, stepper.workspace());
    const double swing = m.system.kinetic_energy(m.state);
    double rows = 0.0, rates = 0.0, drift = 0.0;
    for (int k = 0; k < 4000; ++k) {  // 20 s, some ten swings
      REQUIRE(stepper.step(m.state, 0.005, {}));
      rows = std::max(rows, m.rows().cwiseAbs().maxCoeff());
      rates = std::max(rates, m.row_rates().cwiseAbs().maxCoeff());
      const double E = m.system.kinetic_energy(m.state) + m.system.potential_energy(m.state, stepper.workspace());
      drift = std::max(drift, std::abs(E - E0) / swing);
    }
    CAPTURE(alpha, 1e12 * rows, rates, drift);
    // Positions are solved for: beta h^2 g tolerance = 6e-13 m. What an iteration leaves is judged by the last ratio of
    // two corrections; with a kept matrix some directions shrink more slowly, here by up to seven times that (4e-12 m).
    CHECK(rows < 6e-12);
    // Velocities follow at second order: h^2 times a third rate of about 50 m/s3.
    CHECK(rates < 1e-3);
    // h^2 omega^2 / 12 about 1e-4 for the exchange of the two energies.
    CHECK(drift < 2e-3);
  }
}

namespace {

// Two free bodies tumbling on a spring for 5 s: largest change of energy (share), momentum (N s) and angular momentum
// (share).
Vector3 drifts_of_free_pair(double alpha, double h) {
  GeneralMotion draw(8);
  Mechanism m;
  const double masses[] = {2.0, 3.5};
  for (double mass : masses) m.add_body(std::string(1, 'a'), mass, general_inertia(draw, 1.0), draw.body(2.0, 1.0));
  const BodyPoint a{0, draw.vector(0.5)}, b{1, draw.vector(0.5)};
  m.system.elements.push_back(std::make_unique<LineSpring>(std::string("spring"), a, b, 20.0, 0.0, 1.0));
  m.system.gravity = 0.0;
  m.finish();
  HhtStepper stepper(m.system, {alpha, 1e-9, 12});
  const auto energy = [&] {
    return m.system.kinetic_energy(m.state) + m.system.potential_energy(m.state, stepper.workspace());
  };
  const auto momentum = [&](bool angular) {
    Vector3 P = Vector3::Zero();
    for (int i = 0; i < 2; ++i) {
      const BodyKinematics& k = m.state.body[i];
      const Vector3 p = masses[i] * k.v_WC;
      P += angular ? Vector3(k.p_WC.cross(p) + k.R_WB * (m.system.bodies[i].inertia * k.w_B)) : p;
    }
    return P;
  };
  const double E0 = energy();
  const Vector3 P0 = momentum(false), L0 = momentum(true);
  Vector3 worst = Vector3::Zero();
  for (int k = 0; k < static_cast<int>(5.0 / h); ++k) {
    if (!stepper.step(m.state, h, {})) return Vector3::Constant(1e9);
    const Vector3 now(std::abs(energy() / E0 - 1.0), (momentum(false) - P0).norm(),
                      (momentum(true) - L0).norm() / L0.norm());
    worst = worst.cwiseMax(now);
  }
  return worst;
}

}  // namespace

TEST_CASE("hht: free bodies keep their momenta, and at alpha 0 their energy") {
  for (const double alpha : {0.0, -0.3}) {
    const Vector3 coarse = drifts_of_free_pair(alpha, 0.005), fine = drifts_of_free_pair(alpha, 0.0025);
    CAPTURE(alpha, coarse.transpose(), fine.transpose());
    CHECK(coarse[1] < 1e-6);  // action equals reaction in every residual; what is left is Newton's, 1e-8 m/s2 for 5 s
    // Angular momentum and energy are not kept exactly: second order, so a quarter of a small error at half the step.
    CHECK(coarse[2] < 1e-3);
    CHECK(coarse[2] / fine[2] > 3.5);
    CHECK(coarse[0] < 1e-3);
    if (alpha == 0.0) CHECK(coarse[0] / fine[0] > 3.5);
  }
}

TEST_CASE("hht: kept and renewed factorisations reach the same answer") {
  truth::SphericalPendulum::Vec y;
  Mechanism a = spherical_pendulum(y), b = spherical_pendulum(y);
  HhtStepper kept(a.system, {-0.1, 1e-9, 12});
  for (int k = 0; k < 200; ++k) REQUIRE(kept.step(a.state, 0.01, {}));
  CHECK(kept.factorisations() < 60);  // or nothing was kept
  HhtStepper tight(b.system, {-0.1, 1e-12, 30});
  for (int k = 0; k < 200; ++k) REQUIRE(tight.step(b.state, 0.01, {}));
  // 2 s at an error of at most 1e-8 m/s2
  CHECK((a.state.body[0].p_WC - b.state.body[0].p_WC).norm() < 2e-8);
  CHECK((a.state.lambda - b.state.lambda).norm() < 1e-6);
}

namespace {

// A force that is not a number from t = 0.1 s on, and an internal state that must survive a failed step.
class Breaking : public ForceElement {
 public:
  explicit Breaking(int body) : ForceElement(std::string("breaking")), body_(body) {}
  int state_size() const override { return 1; }
  void start(const Instant&, Memory m) const override { m.state[0] = 0.0; }
  void begin_step(const Instant&, double, Memory m) const override { m.state[0] += 0.25; }
  void add_forces(const Instant& now, double, Memory, ForceSum& out) const override {
    const double F = now.t > 0.1005 ? std::numeric_limits<double>::quiet_NaN() : 0.0;
    out.add(body_, Vector3(F, 0, 0), Vector3::Zero());
  }
  void add_jacobian(const Instant&, double, Memory, JacobianSum&) const override {}

 private:
  int body_;
};

}  // namespace

TEST_CASE("hht: a force that is not finite fails the step, names the body and leaves the state alone") {
  GeneralMotion draw(9);
  Mechanism m;
  for (int i = 0; i < 3; ++i) m.add_body(std::string(1, 'b'), 2.0, general_inertia(draw, 1.0), draw.body());
  m.system.elements.push_back(std::make_unique<Breaking>(1));
  m.finish();
  HhtStepper stepper(m.system, {});
  SystemState& s = m.state;
  for (int k = 0; k < 10; ++k) REQUIRE(stepper.step(s, 0.01, {}));
  const SystemState before = s;
  CHECK_FALSE(stepper.step(s, 0.01, {}));
  CHECK(stepper.failed_body() == 1);
  CHECK(s.t == before.t);
  CHECK(s.element_state == before.element_state);
  CHECK(s.acceleration == before.acceleration);
  CHECK(s.lambda == before.lambda);
  for (int i = 0; i < 3; ++i) {
    CHECK(s.body[i].p_WC == before.body[i].p_WC);
    CHECK(s.body[i].R_WB == before.body[i].R_WB);
    CHECK(s.body[i].v_WC == before.body[i].v_WC);
    CHECK(s.body[i].w_B == before.body[i].w_B);
  }
  CHECK_FALSE(stepper.step(s, 0.005, {}));  // and again
  CHECK(stepper.step(s, 0.0004, {}));       // up to t = 0.1004 s all is well
  CHECK(s.t == Approx(0.1004));
}
