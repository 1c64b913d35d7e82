// The displaced start of a lift, and its derivatives against differences.
#include "tuning/start_state.h"

#include <catch2/catch.hpp>

namespace stillhook {
namespace {

/// Two bodies in general poses, jointed together, and one on its own.
MultibodySystem three_bodies() {
  MultibodySystem system;
  for (int i = 0; i < 3; ++i) {
    RigidBody b;
    b.name = "b" + std::to_string(i);
    b.mass = 10.0 + i;
    b.inertia = Vector3(3.0, 4.0, 5.0).asDiagonal();
    b.cog = {0.3 * i + 0.2, -0.5, 0.7};
    system.bodies.push_back(b);
  }
  Joint joint;
  joint.on_parent.body = 1;
  joint.on_child.body = 0;
  system.joints.push_back(joint);
  return system;
}

SystemState somewhere() {
  SystemState s;
  for (int i = 0; i < 3; ++i) {
    BodyKinematics k;
    k.R_WB = exp_rotation(Vector3(0.3, -0.2 * i, 0.5));
    k.p_WC = {4.0 * i, 1.0 - i, 2.0};
    s.body.push_back(k);
  }
  s.element_state = {1.0, 2.0};
  return s;
}

const DisplacedStart::Coordinates kQ = (DisplacedStart::Coordinates() << 0.4, -0.2, 0.1, 0.3, 0.2, -0.4, 0.5, 0.6, -0.7,
                                        0.3, -0.2, 0.25)
                                           .finished();
constexpr double kStep = 1e-5;  // central differences: error of order 1e-10, rounding 1e-11

TEST_CASE("everything jointed to a body moves with it as a rigid whole", "[start]") {
  const MultibodySystem system = three_bodies();
  const SystemState from = somewhere(), to = DisplacedStart(system, 1).state(from, kQ);
  CHECK(to.body[2].p_WC == from.body[2].p_WC);  // not jointed
  const Vector3 apart_before = from.body[1].R_WB.transpose() * (from.body[0].p_WC - from.body[1].p_WC);
  const Vector3 apart_after = to.body[1].R_WB.transpose() * (to.body[0].p_WC - to.body[1].p_WC);
  CHECK((apart_before - apart_after).norm() < 1e-14);
  // Origin by d, attitude by exp(r) about its own axes.
  const auto origin = [&](const SystemState& s) { return Vector3(s.body[1].p_WC - s.body[1].R_WB * system.bodies[1].cog); };
  CHECK((origin(to) - origin(from) - kQ.head<3>()).norm() < 1e-14);
  CHECK((from.body[1].R_WB.transpose() * to.body[1].R_WB - exp_rotation(kQ.segment<3>(3))).norm() < 1e-14);
  CHECK((to.body[1].w_B - kQ.segment<3>(9)).norm() < 1e-14);
  // Velocities of a rigid whole: v_0 - v_1 = w x (p_0 - p_1).
  const Vector3 w_W = to.body[1].R_WB * to.body[1].w_B;
  CHECK((to.body[0].v_WC - to.body[1].v_WC - w_W.cross(to.body[0].p_WC - to.body[1].p_WC)).norm() < 1e-14);
  CHECK((to.body[0].R_WB * to.body[0].w_B - w_W).norm() < 1e-14);
}

TEST_CASE("derivatives of the displaced start are those of differences", "[start]") {
  const MultibodySystem system = three_bodies();
  const DisplacedStart start(system, 1);
  const SystemState reference = somewhere(), at = start.state(reference, kQ);
  const MatrixX D = start.by_coordinates(reference, kQ);
  REQUIRE(D.rows() == 38);
  for (int j = 0; j < kStartCoordinates; ++j) {
    DisplacedStart::Coordinates up = kQ, down = kQ;
    up[j] += kStep;
    down[j] -= kStep;
    const VectorX difference_quotient =
        (difference(at, start.state(reference, up)) - difference(at, start.state(reference, down))) / (2.0 * kStep);
    INFO("coordinate " << j);
    CHECK((D.col(j) - difference_quotient).norm() < 1e-8);
  }
}

TEST_CASE("a change of the reference is carried along", "[start]") {
  const MultibodySystem system = three_bodies();
  const DisplacedStart start(system, 1);
  const SystemState reference = somewhere(), at = start.state(reference, kQ);
  MatrixX change = MatrixX::Zero(38, 38);
  change.topLeftCorner(18, 18).setIdentity();
  change.bottomRightCorner(2, 2).setIdentity();
  const MatrixX D = start.carried(reference, kQ, change);
  for (const int j : {0, 1, 2, 3, 4, 5, 6, 8, 9, 10, 11, 12, 16, 36, 37}) {
    const VectorX by = VectorX::Unit(38, j) * kStep;
    const VectorX difference_quotient = (difference(at, start.state(moved(reference, by), kQ)) -
                                         difference(at, start.state(moved(reference, -by), kQ))) /
                                        (2.0 * kStep);
    INFO("row " << j);
    CHECK((D.col(j) - difference_quotient).norm() < 1e-8);
  }
}

TEST_CASE("moved and difference are inverse to one another", "[start]") {
  const SystemState s = somewhere();
  VectorX delta(38);
  for (int i = 0; i < 38; ++i) delta[i] = 0.1 * std::sin(1.0 + i);
  CHECK((difference(s, moved(s, delta)) - delta).norm() < 1e-12);
}

}  // namespace
}  // namespace stillhook
