// Static equilibrium: chains, redundant supports, springs, and what nothing holds.
#include "sim/multibody/equilibrium.h"

#include <catch2/catch.hpp>

#include "tests/sim/mechanism.h"

using namespace stillhook;
using truth::GeneralMotion;
using Type = JointSpec::Type;

namespace {

void add_spring(Mechanism& m, int body, const Vector3& at, const Vector3& anchor, double k, double length) {
  m.system.elements.push_back(std::make_unique<LineSpring>(std::string("spring"), m.point(body, at),
                                                           BodyPoint{kWorld, anchor}, k, 0.0, length));
}

}  // namespace

TEST_CASE("equilibrium: a chain let go sideways hangs straight down") {
  Mechanism m;
  const Vector3 top(1.0, 2.0, 10.0), side = Vector3(1.0, 0.3, 0.1).normalized();
  const double masses[] = {2.0, 3.0, 5.0};
  for (int i = 0; i < 3; ++i) m.add_bar(std::string(1, 'a'), masses[i], top + i * side, top + (i + 1) * side);
  for (int i = 0; i < 3; ++i)
    m.add_joint(std::string(1, 'j'), Type::spherical, i == 0 ? kWorld : i - 1, i, top + i * side);
  m.state.body[1].v_WC = Vector3(1, 2, 3);  // is brought to rest
  m.finish();
  const EquilibriumReport report = solve_equilibrium(m.system, m.state);
  REQUIRE(report.converged);
  CHECK(report.residual < 1e-9);
  CHECK(report.iterations < 200);
  for (int i = 0; i < 3; ++i) {
    // 1e-9 of the weight over a length of 1 m
    CHECK((m.state.body[i].p_WC - (top - (i + 0.5) * Vector3::UnitZ())).norm() < 1e-7);
    CHECK(m.state.body[i].v_WC.norm() == 0.0);
  }
  CHECK((m.reaction(0) - 10.0 * m.system.gravity * Vector3::UnitZ()).norm() < 1e-6);
  CHECK((m.reaction(2) - 5.0 * m.system.gravity * Vector3::UnitZ()).norm() < 1e-6);
  CHECK(m.rows().norm() < 1e-9);
}

TEST_CASE("equilibrium: a body on one spring sinks by its weight, and keeps the heading nothing holds") {
  Mechanism m;
  BodyKinematics at;
  at.R_WB = rotation_from({0.0, 0.0, 1.3});
  at.p_WC = Vector3(4.0, -1.0, -3.0);
  const double mass = 12.0, k = 700.0;
  m.add_body("load", mass, Vector3(4, 5, 6).asDiagonal(), at);
  add_spring(m, 0, at.p_WC + Vector3(0, 0, 1.5), Vector3(4.3, -0.6, 6.0), k, 5.0);
  m.finish();
  const EquilibriumReport report = solve_equilibrium(m.system, m.state);
  REQUIRE(report.converged);
  // 1e-9 of the weight on a spring that gives 0.17 m for all of it; sideways the pendulum is as stiff.
  const double z = 6.0 - 5.0 - mass * m.system.gravity / k - 1.5;
  CHECK((m.state.body[0].p_WC - Vector3(4.3, -0.6, z)).norm() < 1e-7);
  const RollPitchYaw angles = roll_pitch_yaw(m.state.body[0].R_WB);
  CHECK(std::abs(angles.roll) < 1e-7);
  CHECK(std::abs(angles.pitch) < 1e-7);
  CHECK(angles.yaw == Approx(1.3).margin(0.02));  // it swings into place without turning about the line
}

TEST_CASE("equilibrium: three springs share a load that two would carry") {
  // A level bar on three upright springs above it, stiffness k, k, k at -1, 0.5, 2 m from its centre: forces by hand.
  Mechanism m;
  m.add_bar("bar", 9.0, Vector3(-2.0, 0.0, 0.0), Vector3(2.0, 0.0, 0.0));
  const double k = 4000.0, x[] = {-1.0, 0.5, 2.0};
  for (const double xi : x) add_spring(m, 0, Vector3(xi, 0.0, 0.0), Vector3(xi, 0.0, 50.0), k, 50.0);
  m.finish();
  REQUIRE(solve_equilibrium(m.system, m.state).converged);
  // Sum k (d + x th) = W, sum k x (d + x th) = 0 for sinking d and slope th.
  Eigen::Matrix2d A;
  A << 3.0, 1.5, 1.5, 5.25;
  const Eigen::Vector2d s = A.inverse() * Eigen::Vector2d(9.0 * m.system.gravity / k, 0.0);
  // Linear theory: neglects squares of the slope (0.003) and of lean over 50 m.
  CHECK(m.state.body[0].p_WC.z() == Approx(-s[0]).margin(2e-4));
  const Vector3 along = m.state.body[0].R_WB.col(0);
  CHECK(along.z() == Approx(-s[1]).margin(2e-4));
  CHECK(std::abs(s[1]) > 2e-3);
}

TEST_CASE("equilibrium: a four-bar with redundant rows settles, and its reactions carry its weight") {
  const Vector3 A(0, 0, 0), B(0.3, 0, 0.6), D(1.4, 0, 0.9), G(1.2, 0, 0);
  Mechanism m;
  m.add_bar("crank", 1.5, A, B);
  m.add_bar("coupler", 2.0, B, D);
  m.add_bar("rocker", 1.2, G, D);
  m.add_joint("A", Type::revolute, kWorld, 0, A);
  m.add_joint("B", Type::revolute, 0, 1, B);
  m.add_joint("D", Type::revolute, 1, 2, D);
  m.add_joint("G", Type::revolute, kWorld, 2, G);
  add_spring(m, 1, (B + D) / 2.0, Vector3(0.5, 0.0, 3.0), 300.0, 2.0);
  m.finish();
  m.system.select_independent_rows(m.state);
  m.state.lambda = VectorX::Zero(m.system.constraints());
  const EquilibriumReport report = solve_equilibrium(m.system, m.state);
  REQUIRE(report.converged);
  CHECK(m.rows().norm() < 1e-9);
  const Vector3 r = Vector3(0.5, 0.0, 3.0) - m.state.body[1].p_WC;
  const Vector3 pull = 300.0 * (r.norm() - 2.0) * r.normalized();
  const Vector3 weight(0, 0, -4.7 * m.system.gravity);
  CHECK((m.reaction(0) + m.reaction(3) + pull + weight).norm() < 1e-6);
}

TEST_CASE("equilibrium: a body that nothing holds up is reported, with its name") {
  Mechanism m;
  m.add_body("stone", 3.0, Matrix3::Identity(), BodyKinematics{});
  m.finish();
  const EquilibriumReport report = solve_equilibrium(m.system, m.state);
  CHECK_FALSE(report.converged);
  CHECK(report.worst_body == "stone");
}
