// Motions of whole mechanisms against exact solutions and integrations in minimal coordinates.
#include <catch2/catch.hpp>

#include "tests/sim/mechanism.h"
#include "tests/truth/four_bar.h"
#include "tests/truth/free_body.h"
#include "tests/truth/pendulums.h"

using namespace stillhook;
using truth::GeneralMotion;
using Type = JointSpec::Type;

namespace {

// The method is of second order: at h = 2e-4 s and rates of a few rad/s its error in some seconds of motion is
// (omega h)^2 / 12 * omega t, 2e-7. The bound is the 1e-6 that is asked of the core (m, rad, for sizes of about 1).
constexpr double kBound = 1e-6;
constexpr double kStep = 2e-4;
// 1e-8 g of error in an acceleration is 2e-7 m after 2 s.
const HhtOptions kTight{-0.05, 1e-8, 12};

}  // namespace

TEST_CASE("physical pendulum: period at a large amplitude by the elliptic integral") {
  GeneralMotion draw(1);
  const double mass = 3.2, amplitude = 1.9;
  const Vector3 axis = Vector3(std::cos(0.7), std::sin(0.7), 0.0), hinge(1.0, -2.0, 4.0);
  Mechanism m;
  BodyKinematics at;
  at.R_WB = draw.rotation();
  // Released at rest from `amplitude`; the centre of gravity also lies off the joint point along the axis.
  const Vector3 down = Eigen::AngleAxisd(amplitude, axis) * Vector3(0, 0, -0.8);
  at.p_WC = hinge + down + 0.5 * axis;
  const Matrix3 inertia = general_inertia(draw, 0.9);
  m.add_body("bob", mass, inertia, at);
  m.add_joint("hinge", Type::revolute, kWorld, 0, hinge, axis);
  m.finish();
  const Vector3 e = at.R_WB.transpose() * axis;
  const truth::PhysicalPendulum exact{mass, 0.8, e.dot(inertia * e) + mass * 0.64, m.system.gravity};

  HhtStepper stepper(m.system, kTight);
  std::vector<double> crossings;  // of the lowest position, either way
  double before = 0.0, rate_before = 0.0;
  while (crossings.size() < 3 && m.state.t < 20.0) {
    REQUIRE(stepper.step(m.state, kStep, {}));
    const double s = std::remainder(m.system.joints[0].coordinate(m.state.instant()) + amplitude, 2.0 * M_PI);
    const double rate = m.system.joints[0].coordinate_rate(m.state.instant());
    if (before * s < 0.0) {
      // linear between two steps at nearly constant rate: h^2 / 8 of the (zero) angular acceleration there
      crossings.push_back(m.state.t - s / (0.5 * (rate + rate_before)));
    }
    before = s;
    rate_before = rate;
  }
  REQUIRE(crossings.size() == 3);
  CHECK(std::abs((crossings[2] - crossings[0]) / exact.period(amplitude) - 1.0) < kBound);
  CHECK(exact.period(amplitude) > 1.2 * exact.small_period());  // the amplitude matters
}

TEST_CASE("spherical pendulum against its minimal coordinates") {
  const double mass = 2.5, arm = 1.3, across = 0.7;
  const Vector3 joint(-1.0, 0.5, 2.0);
  Mechanism m;
  BodyKinematics at;
  const Vector3 n = Vector3(0.6, -0.3, -0.9).normalized(), n_dot = n.cross(Vector3(0.4, 1.8, 0.9));
  // A rod about its own line: no spin about n at the start, so none later.
  at.R_WB = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitX(), n).toRotationMatrix();
  at.p_WC = joint + arm * n;
  m.add_body("bob", mass, Vector3(0.2, across, across).asDiagonal(), at);
  m.add_joint("ball", Type::spherical, kWorld, 0, joint);
  m.spin(0, joint, n.cross(n_dot));
  m.finish();
  const truth::SphericalPendulum exact{mass, arm, across + mass * arm * arm, m.system.gravity};
  truth::SphericalPendulum::Vec y;
  y.head<3>() = n;
  y.tail<3>() = n_dot;

  HhtStepper stepper(m.system, kTight);
  for (const double t : {1.0, 2.5}) {
    REQUIRE(run_to(stepper, m.state, t, static_cast<int>(std::round((t - m.state.t) / kStep))));
    const auto expected = exact.at(t, y);
    CHECK((m.state.body[0].p_WC - joint - arm * expected.head<3>()).norm() < kBound);
    CHECK((m.state.body[0].v_WC - arm * expected.tail<3>()).norm() < 4 * kBound);  // rates of 3 rad/s
    CHECK((m.reaction(0) - exact.joint_force(expected)).norm() < 30 * kBound);     // N, of forces of 50 N
    CHECK((m.state.body[0].p_WC - joint - arm * n).norm() > 0.3);                  // it has moved
  }
}

TEST_CASE("double pendulum in an inclined plane against its minimal coordinates") {
  // Axes tilted by 20 deg and turned in heading: gravity's share in the plane is g cos 20 deg.
  const double tilt = 20.0 * M_PI / 180.0;
  const Matrix3 plane =
      (Eigen::AngleAxisd(0.8, Vector3::UnitZ()) * Eigen::AngleAxisd(tilt, Vector3::UnitX())).toRotationMatrix();
  const Vector3 axis = plane.col(1), down = -plane.col(2), side = plane.col(0);
  const auto along = [&](double th) { return Vector3(std::cos(th) * down + std::sin(th) * side); };
  const double m1 = 2.0, m2 = 1.4, L1 = 1.1, L2 = 0.9;
  truth::DoublePendulum::Vec y(1.1, -0.4, 0.7, -1.6);
  const Vector3 top(2.0, 1.0, 3.0), middle = top + L1 * along(y[0]);
  Mechanism m;
  m.add_bar("upper", m1, top, middle);
  m.add_bar("lower", m2, middle, middle + L2 * along(y[1]));
  m.add_joint("top", Type::revolute, kWorld, 0, top, axis);
  m.add_joint("middle", Type::revolute, 0, 1, middle, -axis);
  // th grows from down to side: a turn about down x side.
  const Vector3 turn = down.cross(side);
  m.spin(0, top, y[2] * turn);
  m.spin(1, middle, y[3] * turn, y[2] * turn.cross(middle - top));
  m.finish();
  const truth::DoublePendulum exact{m1, L1 / 2, m1 * L1 * L1 / 12, L1,
                                    m2, L2 / 2, m2 * L2 * L2 / 12, m.system.gravity * std::cos(tilt)};
  REQUIRE(m.rows().norm() < 1e-13);
  REQUIRE(m.row_rates().norm() < 1e-13);

  HhtStepper stepper(m.system, kTight);
  REQUIRE(run_to(stepper, m.state, 2.0, 10000));
  const auto expected = exact.at(2.0, y);
  const Vector3 centre1 = top + L1 / 2 * along(expected[0]);
  const Vector3 centre2 = top + L1 * along(expected[0]) + L2 / 2 * along(expected[1]);
  CHECK((m.state.body[0].p_WC - centre1).norm() < kBound);
  CHECK((m.state.body[1].p_WC - centre2).norm() < 2 * kBound);  // both angles' errors, over two bars
  CHECK((expected - y).norm() > 1.0);
}

TEST_CASE("planar four-bar with redundant rows against its loop equations and energy") {
  const double a = 0.4, b = 1.1, c = 0.9, d = 1.2;  // a + d < b + c: the crank turns right round
  truth::FourBar exact{a, b, c, d, 1.5, 2.0, 1.2, 9.80665};
  const double th0 = 0.7, rate0 = 7.0;
  // The linkage's plane stands upright at a general heading.
  const Matrix3 R = Eigen::AngleAxisd(1.1, Vector3::UnitZ()).toRotationMatrix();
  const Vector3 A(0.5, -0.7, 0.2), x = R.col(0), axis = R.col(1);
  const auto at = [&](double px, double py) { return Vector3(A + px * x + py * Vector3::UnitZ()); };
  const auto angles = exact.angles(th0);
  const Vector3 B = at(a * std::cos(th0), a * std::sin(th0)), G = at(d, 0.0);
  const Vector3 D = G + c * (std::cos(angles.rocker) * x + std::sin(angles.rocker) * Vector3::UnitZ());
  Mechanism m;
  m.add_bar("crank", exact.crank_mass, A, B);
  m.add_bar("coupler", exact.coupler_mass, B, D);
  m.add_bar("rocker", exact.rocker_mass, G, D);
  m.add_joint("A", Type::revolute, kWorld, 0, A, axis);
  m.add_joint("B", Type::revolute, 0, 1, B, axis);
  m.add_joint("D", Type::revolute, 1, 2, D, axis);
  m.add_joint("G", Type::revolute, kWorld, 2, G, axis);
  // Angles from x to z turn about -axis.
  const Vector3 turn = -axis;
  const Eigen::Vector2d k = exact.ratios(angles);
  m.spin(0, A, rate0 * turn);
  m.spin(1, B, rate0 * k[0] * turn, rate0 * turn.cross(B - A));
  m.spin(2, G, rate0 * k[1] * turn);
  m.finish();
  REQUIRE(m.system.constraints() == 20);
  CHECK(m.row_rates().norm() < 1e-12);
  const std::vector<std::string> losers = m.system.select_independent_rows(m.state);
  CHECK(m.system.constraints() == 17);  // one degree of freedom left of 18
  REQUIRE(losers.size() == 1);
  CHECK(losers[0] == "G");  // the last joint of the loop

  HhtStepper stepper(m.system, kTight);
  const double E0 = m.system.kinetic_energy(m.state) + m.system.potential_energy(m.state, stepper.workspace());
  CHECK(m.system.kinetic_energy(m.state) == Approx(0.5 * exact.inertia(th0) * rate0 * rate0).epsilon(1e-3));
  for (const double t : {0.5, 1.5}) {
    REQUIRE(run_to(stepper, m.state, t, static_cast<int>(std::round((t - m.state.t) / 5e-5))));
    const double th = exact.crank_angle(t, th0, rate0);
    const auto now = exact.angles(th);
    // rates of 10 rad/s: h = 5e-5 s, (omega h)^2 / 12 * omega t = 3e-7
    CHECK((m.state.body[0].p_WC - at(a / 2 * std::cos(th), a / 2 * std::sin(th))).norm() < kBound);
    CHECK((m.state.body[2].p_WC - G - c / 2 * (std::cos(now.rocker) * x + std::sin(now.rocker) * Vector3::UnitZ()))
              .norm() < kBound);
    std::string where;
    CHECK(m.system.dropped_violation(m.state, where) < 1e-9);  // the dropped rows hold by themselves
  }
  CHECK(exact.crank_angle(1.5, th0, rate0) - th0 > 2 * M_PI);  // right round
  const double E1 = m.system.kinetic_energy(m.state) + m.system.potential_energy(m.state, stepper.workspace());
  CHECK(std::abs(E1 - E0) < 1e-5 * m.system.kinetic_energy(m.state));
}

TEST_CASE("torque-free asymmetric body: Euler's equations by elliptic functions, momentum and energy") {
  GeneralMotion draw(5);
  const Vector3 inertia(1.0, 1.6, 2.3);
  Mechanism m;
  BodyKinematics at = draw.body();
  // Mostly about the axis of the smallest inertia would be L^2 < 2 E I2; this is near the middle axis's separatrix.
  at.w_B = Vector3(1.9, 0.0, 1.5);
  m.add_body("body", 4.0, inertia.asDiagonal(), at);
  m.system.gravity = 0.0;
  m.finish();
  const truth::FreeBody exact{inertia, at.w_B[0], at.w_B[2]};
  const Vector3 L0 = at.R_WB * (inertia.asDiagonal() * at.w_B);
  const double E0 = m.system.kinetic_energy(m.state);

  HhtStepper stepper(m.system, kTight);
  for (const double t : {1.0, 4.0}) {
    REQUIRE(run_to(stepper, m.state, t, static_cast<int>(std::round((t - m.state.t) / kStep))));
    const BodyKinematics& b = m.state.body[0];
    CHECK((b.w_B - exact.spin(t)).norm() < kBound);
    CHECK((b.R_WB * (inertia.asDiagonal() * b.w_B) - L0).norm() < kBound * L0.norm());
    CHECK(std::abs(m.system.kinetic_energy(m.state) / E0 - 1.0) < kBound);
    CHECK((b.p_WC - at.p_WC - t * at.v_WC).norm() < 1e-11);  // linear momentum exactly, to rounding of 20,000 steps
    CHECK((b.R_WB.transpose() * b.R_WB - Matrix3::Identity()).norm() < 1e-14);
  }
  CHECK(std::abs(exact.spin(1.0)[1]) > 0.5);
}

TEST_CASE("joint reactions of a swinging pendulum: m g cos th + m v^2 / l along the line") {
  const double mass = 2.0, arm = 1.5;
  const Vector3 hinge(0.0, 0.0, 5.0), axis = Vector3::UnitY();
  Mechanism m;
  BodyKinematics at;
  at.p_WC = hinge + arm * Vector3(std::sin(0.8), 0.0, -std::cos(0.8));
  // A point mass but for a speck of inertia: tension is then the textbook's; 1e-6 of m l^2.
  m.add_body("bob", mass, 4.5e-6 * Matrix3::Identity(), at);
  m.add_joint("hinge", Type::revolute, kWorld, 0, hinge, axis);
  m.finish();
  HhtStepper stepper(m.system, kTight);
  for (int i = 0; i < 5; ++i) {
    REQUIRE(run_to(stepper, m.state, 0.3 * (i + 1), 1500));
    const Vector3 u = (hinge - m.state.body[0].p_WC).normalized();
    const double v2 = m.state.body[0].v_WC.squaredNorm();
    const double tension = mass * m.system.gravity * u.z() + mass * v2 / arm;
    Vector3 force, moment;
    m.system.joint_reaction(m.state, 0, force, moment);
    CHECK((force - tension * u).norm() < 1e-4);  // N: the speck of inertia, and h^2
    CHECK(force.dot(u) > 0.0);                   // it holds the child up
    CHECK(moment.norm() < 1e-5);                 // a hinge in its plane carries none
  }
}
