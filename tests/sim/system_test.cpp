// The assembled equations: mass, Jacobian of the whole, dependent and contradictory constraint rows.
#include "sim/multibody/system.h"

#include <catch2/catch.hpp>

#include "sim/multibody/equilibrium.h"
#include "tests/sim/mechanism.h"

using namespace stillhook;
using truth::GeneralMotion;
using Type = JointSpec::Type;

namespace {

// A hull's share: added mass of one body and between two.
class AddedMass : public ForceElement {
 public:
  explicit AddedMass(const MatrixX& A) : ForceElement(std::string("hulls")), A_(A) {}
  void add_forces(const Instant&, double, Memory, ForceSum&) const override {}
  void add_jacobian(const Instant&, double, Memory, JacobianSum&) const override {}
  void add_mass(MatrixX& M, int) const override { M += A_; }

 private:
  MatrixX A_;
};

Mechanism general_tree() {
  GeneralMotion draw(3);
  Mechanism m;
  for (int i = 0; i < 3; ++i) m.add_body(std::string(1, 'b'), 2.0 + i, general_inertia(draw, 1.0 + i), draw.body());
  m.add_joint("hinge", Type::revolute, 0, 1, draw.vector(2), draw.unit());
  m.add_joint("slide", Type::prismatic, 1, 2, draw.vector(2), draw.unit());
  m.add_joint("ball", Type::spherical, kWorld, 0, draw.vector(2));
  m.system.elements.push_back(std::make_unique<LineSpring>(std::string("line"), BodyPoint{0, draw.vector(1)},
                                                           BodyPoint{2, draw.vector(1)}, 30.0, 4.0, 1.5));
  m.system.elements.push_back(std::make_unique<LineSpring>(std::string("stay"), BodyPoint{kWorld, draw.vector(9)},
                                                           BodyPoint{1, draw.vector(1)}, 12.0, 2.0, 3.0));
  m.finish();
  return m;
}

// A four-bar of revolute joints in an upright plane; `tilt` turns the last axis out of the common direction.
Mechanism four_bar(double tilt, double stretch = 0.0) {
  const Matrix3 R = Eigen::AngleAxisd(1.1, Vector3::UnitZ()).toRotationMatrix();
  const Vector3 A(0.5, -0.7, 0.2), B = A + R * Vector3(0.3, 0, 0.6), D = A + R * Vector3(1.4, 0, 0.9),
                                   G = A + R * Vector3(1.2, 0, 0);
  const Vector3 away = stretch * (D - B).normalized();
  Mechanism m;
  m.add_bar("crank", 1.5, A, B);
  m.add_bar("coupler", 2.0, B, D);
  m.add_bar("rocker", 1.2, G, D);
  m.add_joint("A", Type::revolute, kWorld, 0, A, R.col(1));
  m.add_joint("B", Type::revolute, 0, 1, B, R.col(1));
  m.add_joint("D", Type::revolute, 1, 2, D, R.col(1));
  m.add_joint_between("G", Type::revolute, kWorld, 2, G + away, G,
                      Eigen::AngleAxisd(tilt, R.col(0)) * Vector3(R.col(1)));
  m.finish();
  return m;
}

}  // namespace

TEST_CASE("system: mass matrix is block diagonal, symmetric, and takes added mass") {
  GeneralMotion draw(1);
  Mechanism m;
  for (int i = 0; i < 2; ++i) m.add_body(std::string(1, 'b'), 2.0 + i, general_inertia(draw, 1.0), draw.body());
  MatrixX A = MatrixX::Random(12, 12);
  A = A * A.transpose();
  m.system.elements.push_back(std::make_unique<AddedMass>(A));
  m.finish();
  MatrixX expected = A;
  for (int i = 0; i < 2; ++i) {
    expected.block<3, 3>(6 * i, 6 * i) += (2.0 + i) * Matrix3::Identity();
    expected.block<3, 3>(6 * i + 3, 6 * i + 3) += m.system.bodies[i].inertia;
  }
  CHECK((m.system.mass() - expected).norm() < 1e-13);
  CHECK((m.system.mass() - m.system.mass().transpose()).norm() == Approx(0.0).margin(1e-14));
  const VectorX u = m.velocities();
  CHECK(m.system.kinetic_energy(m.state) == Approx(0.5 * u.dot(expected * u)));
  m.system.finish();  // sums anew, does not add up
  CHECK((m.system.mass() - expected).norm() < 1e-13);
}

TEST_CASE("system: the Jacobian is the derivative of forces, gyroscopic moments and joint forces") {
  Mechanism m = general_tree();
  GeneralMotion draw(7);
  for (int k = 0; k < m.state.lambda.size(); ++k) m.state.lambda[k] = draw.number(-3, 3);
  SystemWorkspace work = m.system.make_workspace();
  const auto total = [&](const std::vector<BodyKinematics>& at) {
    SystemState s = m.state;
    s.body = at;
    VectorX Q;
    MatrixX C_q;
    m.system.forces(s, 0.01, work, Q);
    m.system.constraint_jacobian(s, C_q);
    return VectorX(Q - C_q.transpose() * s.lambda);
  };
  const MatrixX K = truth::central_differences(m.state.body, truth::moved, total);
  const MatrixX C = truth::central_differences(m.state.body, truth::hastened, total);
  m.system.jacobian(m.state, 0.01, work);
  // Forces of size 200 over a step of 1e-5: rounding 4e-9, third derivatives 2e-8.
  CHECK((work.jacobian.stiffness() - K).cwiseAbs().maxCoeff() < 1e-7);
  CHECK((work.jacobian.damping() - C).cwiseAbs().maxCoeff() < 1e-7);
}

TEST_CASE("system: acceleration constraint right-hand side is the velocity part of the rows' second rate") {
  Mechanism m = general_tree();
  const VectorX u = m.velocities();
  const auto row_rate = [&](double dt) {
    SystemState s = m.state;
    for (std::size_t i = 0; i < s.body.size(); ++i) s.body[i] = truth::moved(s.body[i], dt * u.segment<6>(6 * i));
    MatrixX C_q;
    m.system.constraint_jacobian(s, C_q);
    return VectorX(C_q * u);
  };
  VectorX gamma;
  m.system.constraint_acceleration(m.state, gamma);
  CHECK((gamma + (row_rate(1e-5) - row_rate(-1e-5)) / 2e-5).norm() < 1e-7);  // 1e-5 squared times third rates
  CHECK(gamma.norm() > 0.5);
}

TEST_CASE("system: a tree of joints loses no row") {
  Mechanism m = general_tree();
  CHECK(m.system.constraints() == 13);
  CHECK(m.system.select_independent_rows(m.state).empty());
  CHECK(m.system.constraints() == 13);
  std::string where;
  CHECK(m.system.dropped_violation(m.state, where) == 0.0);
}

TEST_CASE("system: a planar four-bar loses its three dependent rows, again and again") {
  Mechanism m = four_bar(0.0);
  CHECK(m.system.constraints() == 20);
  for (int again = 0; again < 2; ++again) {
    CHECK(m.system.select_independent_rows(m.state) == std::vector<std::string>{"G"});
    CHECK(m.system.constraints() == 17);
  }
  for (int r = 0; r < 15; ++r) CHECK(m.system.row_joint(r) != "G");
  CHECK(m.system.row_joint(16) == "G");
  std::string where;
  CHECK(m.system.dropped_violation(m.state, where) < 1e-14);
}

TEST_CASE("system: a loop whose axes are not parallel is locked, however little they differ") {
  for (const double tilt : {0.3, 1e-2, 1e-3}) {
    Mechanism m = four_bar(tilt);
    const auto losers = m.system.select_independent_rows(m.state);
    // 20 rows on 18 coordinates: two depend on the others, and nothing is free. A planar loop would keep 17.
    CAPTURE(tilt);
    CHECK(m.system.constraints() == m.system.coordinates());
    CHECK(losers == std::vector<std::string>{"G"});
  }
}

TEST_CASE("system: bars that cannot close are found, with the joint's name") {
  Mechanism m = four_bar(0.0, 3.0);  // the ground pivot is 3 m further than the bars reach
  std::string joint;
  const double gap = assemble_joints(m.system, m.state, joint);
  // A (2.1 m) chain of bars towards a pivot about 4 m away: at least half a metre stays open, shared by the joints.
  CHECK(gap > 0.1);
  CHECK((joint == "A" || joint == "B" || joint == "D" || joint == "G"));
}

TEST_CASE("system: bars that lie a little apart are assembled, redundant rows and all") {
  Mechanism m = four_bar(0.0, 0.05);
  GeneralMotion draw(5);
  for (BodyKinematics& b : m.state.body) {
    Vector6 xi;
    xi.head<3>() = draw.vector(0.02);
    xi.tail<3>() = draw.vector(0.02);
    b = truth::moved(b, xi);
  }
  std::string joint;
  const std::vector<BodyKinematics> before = m.state.body;
  CHECK(assemble_joints(m.system, m.state, joint) < 1e-11);
  for (int i = 0; i < 3; ++i) CHECK((m.state.body[i].p_WC - before[i].p_WC).norm() < 0.15);  // no further than needed
  m.system.select_independent_rows(m.state);
  CHECK(m.system.constraints() == 17);
  std::string where;
  CHECK(m.system.dropped_violation(m.state, where) < 1e-11);
}

TEST_CASE("system: a loop that contradicts itself in dropped rows is seen by dropped_violation") {
  // A body on two slides in the same direction whose second one is then set 0.2 m aside: its rows are dependent, and
  // the dropped ones do not hold.
  GeneralMotion draw(6);
  Mechanism m;
  m.add_body("carriage", 2.0, general_inertia(draw, 1.0), draw.body());
  const Vector3 axis = draw.unit();
  m.add_joint("first", Type::prismatic, kWorld, 0, draw.vector(1), axis);
  m.add_joint("second", Type::prismatic, kWorld, 0, draw.vector(1), axis);
  m.system.joints[1].on_parent.c_B += 0.2 * axis.unitOrthogonal();
  m.finish();
  CHECK(m.system.select_independent_rows(m.state) == std::vector<std::string>{"second"});
  std::string where;
  CHECK(m.system.dropped_violation(m.state, where) > 0.1);
  CHECK(where == "second");
}

TEST_CASE("system: reactions of a beam on two supports, one of them redundant sideways") {
  // Left end on a hinge, right end on a ball on a slide along x: sideways both hold, which is one row too many.
  const double L = 4.0, a = 1.2, mass = 30.0, slider_mass = 2.0;
  Mechanism m;
  BodyKinematics at;
  at.R_WB = GeneralMotion(2).rotation();
  at.p_WC = Vector3(a, 0.5, 1.0);
  m.add_body("beam", mass, general_inertia(*std::make_unique<GeneralMotion>(4), 20.0), at);
  at.p_WC = Vector3(L, 0.5, 1.0);
  m.add_body("slider", slider_mass, 0.1 * Matrix3::Identity(), at);
  const Vector3 left(0.0, 0.5, 1.0), right(L, 0.5, 1.0);
  m.add_joint("hinge", Type::revolute, kWorld, 0, left, Vector3::UnitY());
  m.add_joint("ball", Type::spherical, 1, 0, right);
  m.add_joint("slide", Type::prismatic, kWorld, 1, right, Vector3::UnitX());
  m.finish();
  CHECK(m.system.select_independent_rows(m.state).size() == 1);
  m.state.lambda = VectorX::Zero(m.system.constraints());
  const EquilibriumReport report = solve_equilibrium(m.system, m.state);
  REQUIRE(report.converged);
  const double W = mass * m.system.gravity;
  // Statics: moments about the ends. Tolerance: 1e-9 of the weight is what the equilibrium leaves.
  CHECK((m.reaction(0) - Vector3(0, 0, W * (1 - a / L))).norm() < 1e-6);
  CHECK((m.reaction(1) - Vector3(0, 0, W * a / L)).norm() < 1e-6);
  CHECK((m.reaction(2) - Vector3(0, 0, W * a / L + slider_mass * m.system.gravity)).norm() < 1e-6);
}

TEST_CASE("system: a cantilever's reaction moment about the joint point, on the child, in W") {
  for (const Type type : {Type::fixed, Type::prismatic}) {
    const Vector3 root(1.0, 2.0, 3.0), out(1.5, -0.4, 0.2);
    const double mass = 7.0;
    GeneralMotion draw(8);
    Mechanism m;
    BodyKinematics at;
    at.R_WB = draw.rotation();
    at.p_WC = root + out;
    m.add_body("arm", mass, general_inertia(draw, 3.0), at);
    m.add_joint("root", type, kWorld, 0, root, Vector3::UnitX());  // level, so that gravity does not move a slide
    m.finish();
    REQUIRE(solve_equilibrium(m.system, m.state).converged);
    Vector3 force, moment;
    m.system.joint_reaction(m.state, 0, force, moment);
    const Vector3 weight(0, 0, -mass * m.system.gravity);
    CHECK((force + weight).norm() < 1e-6);
    CHECK((moment + out.cross(weight)).norm() < 1e-6);  // holds up what the weight turns down
  }
}
