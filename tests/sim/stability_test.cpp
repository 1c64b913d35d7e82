// Stability of equilibria, dynamic relaxation and moves against closed forms of small mechanisms.
#include "sim/multibody/stability.h"

#include <catch2/catch.hpp>

#include "sim/multibody/relaxation.h"
#include "tests/sim/mechanism.h"

using namespace stillhook;
using Type = JointSpec::Type;

namespace {

// A bar of length 2 m on a hinge at the origin, upwards or downwards.
Mechanism bar_on_hinge(double direction) {
  Mechanism m;
  m.add_bar("bar", 6.0, Vector3::Zero(), Vector3(0, 0, 2.0 * direction));
  m.add_joint("hinge", Type::revolute, kWorld, 0, Vector3::Zero());
  m.finish();
  return m;
}

}  // namespace

TEST_CASE("stability: a bar that stands on its hinge falls with 3 g / (2 L), one that hangs does not") {
  Mechanism up = bar_on_hinge(1.0);
  REQUIRE(solve_equilibrium(up.system, up.state).converged);
  const WeakestMotion falls = weakest_motion(up.system, up.state);
  CHECK_FALSE(falls.stable());
  CHECK(falls.stiffness == Approx(-1.5 * up.system.gravity / 2.0).epsilon(1e-9));
  CHECK(describe_motion(up.system, falls.motion).find("'bar' in ") == 0);

  Mechanism down = bar_on_hinge(-1.0);
  REQUIRE(solve_equilibrium(down.system, down.state).converged);
  CHECK(weakest_motion(down.system, down.state).stable());
}

TEST_CASE("stability: a bar that stands on its hinge is settled hanging") {
  Mechanism m = bar_on_hinge(1.0);
  REQUIRE(settle_stably(m.system, m.state).converged);
  CHECK((m.state.body[0].p_WC - Vector3(0, 0, -1)).norm() < 1e-7);  // 1e-9 of the weight over 1 m
}

TEST_CASE("relaxation: a ball that is let go falls 1,000 m and hangs on its line") {
  Mechanism m;
  BodyKinematics at;
  at.p_WC = Vector3(3, -2, 0);
  m.add_body("ball", 50.0, Matrix3::Identity(), at);
  struct Line : ForceElement {
    Line() : ForceElement("line") {}
    // 1e6 N/m, slack up to 1,000 m under (0, 0, 0), at the centre of gravity.
    void add_forces(const Instant& now, double, Memory, ForceSum& out) const override {
      const Vector3 r = now.body[0].p_WC;
      if (r.norm() > 1000.0) out.add(0, -1e6 * (r.norm() - 1000.0) * r.normalized(), Vector3::Zero());
    }
    void add_jacobian(const Instant& now, double, Memory, JacobianSum& out) const override {
      const Vector3 r = now.body[0].p_WC, e = r.normalized();
      if (r.norm() <= 1000.0) return;
      Matrix6 K = Matrix6::Zero();
      K.topLeftCorner<3, 3>() =
          -1e6 * (e * e.transpose() + (r.norm() - 1000.0) / r.norm() * (Matrix3::Identity() - e * e.transpose()));
      out.add_stiffness(0, 0, K);
    }
  };
  m.system.elements.push_back(std::make_unique<const Line>());
  m.finish();
  REQUIRE(relax(m.system, m.state).converged);
  CHECK((m.state.body[0].p_WC - Vector3(0, 0, -1000.0 - 50.0 * m.system.gravity / 1e6)).norm() < 1e-5);
}
