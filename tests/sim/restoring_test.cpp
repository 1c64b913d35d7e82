// Linear springs from a body to the world.
#include "sim/lifting/restoring.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "sim/modes.h"
#include "sim/spatial/constants.h"
#include "tests/sim/force_element_suite.h"
#include "tests/sim/lift_parts.h"

using namespace stillhook;

namespace {

constexpr double kG = 9.80665;

/// A box in the air on a spring to the world in all six motions.
LiftParts sprung(double mass, const Vector6& diagonal) {
  LiftParts lift;
  BodySpec& b = lift.body("box", mass, Vector3(3.0, -2.0, 5.0), 2.0);
  b.attitude = {0.0, 0.0, 0.6};
  RestoringSpec r;
  r.name = "spring";
  r.body = "box";
  r.stiffness = diagonal.asDiagonal();
  r.force_at_rest = Vector3(0.0, 0.0, mass * kG);
  lift.spec.restoring.push_back(r);
  return lift;
}

std::string refused(const Matrix6& K, const Matrix6& D) {
  RestoringOptions o;
  o.name = "spring";
  o.point = {0, Vector3::Zero()};
  o.stiffness = K;
  o.damping = D;
  try {
    Restoring made(o);
  } catch (const SpecificationError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a body on a spring to the world rests where the case says and swings with 2 pi sqrt(m/k)", "[restoring]") {
  const double m = 5e5;
  Vector6 k;
  k << 2e5, 4e5, 9e5, 3e6, 5e6, 8e6;
  const Model model = build_model(sprung(m, k).spec);
  const Pose rest = pose_of(model.initial_state().body[0], model.system().bodies[0]);
  CHECK((rest.p - Vector3(3.0, -2.0, 5.0)).norm() < 1e-6);  // 1e-9 of the weight on 2e5 N/m: 2.5e-8 m
  CHECK(roll_pitch_yaw(rest.R).yaw == Approx(0.6).margin(1e-8));
  std::vector<double> periods;
  for (const Mode& mode : natural_modes(model, model.initial_state())) periods.push_back(mode.period);
  std::sort(periods.begin(), periods.end());
  std::vector<double> wanted;
  for (int i = 0; i < 6; ++i) wanted.push_back(kTwoPi * std::sqrt((i < 3 ? m : 4.0 * m) / k[i]));
  std::sort(wanted.begin(), wanted.end());
  REQUIRE(periods.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) CHECK(periods[i] == Approx(wanted[i]).epsilon(1e-6));
}

TEST_CASE("a spring to the world is along its own axes and gives way by force over stiffness", "[restoring]") {
  const double m = 5e5;
  Vector6 k;
  k << 2e5, 4e5, 9e5, 3e6, 5e6, 8e6;
  LiftParts lift = sprung(m, k);
  lift.spec.restoring[0].force_at_rest = Vector3(4e4, 0.0, m * kG);  // in the world; the axes stand at 0.6 rad
  const Model model = build_model(lift.spec);
  const Pose rest = pose_of(model.initial_state().body[0], model.system().bodies[0]);
  const Vector3 along(4e4 * std::cos(0.6) / 2e5, -4e4 * std::sin(0.6) / 4e5, 0.0);  // in the axes
  CHECK((rest.p - Vector3(3.0, -2.0, 5.0) - rotation_from({0.0, 0.0, 0.6}) * along).norm() < 1e-6);
  lift.spec.restoring[0].axes_heading = 0.0;
  const Model level = build_model(lift.spec);
  const Pose there = pose_of(level.initial_state().body[0], level.system().bodies[0]);
  CHECK((there.p - Vector3(3.2, -2.0, 5.0)).norm() < 1e-6);
  // Somewhere else at rest.
  lift.spec.restoring[0].force_at_rest.x() = 0.0;
  lift.spec.restoring[0].rest_point = Vector3(1.0, 1.0, 8.0);
  lift.spec.restoring[0].rest_attitude = RollPitchYaw{0.0, 0.0, -0.3};
  const Model moved = build_model(lift.spec);
  const Pose other = pose_of(moved.initial_state().body[0], moved.system().bodies[0]);
  CHECK((other.p - Vector3(1.0, 1.0, 8.0)).norm() < 1e-6);
  CHECK(roll_pitch_yaw(other.R).yaw == Approx(-0.3).margin(1e-7));
}

TEST_CASE("about one axis the moment is the stiffness times the angle, far beyond small angles", "[restoring]") {
  RestoringOptions o;
  o.name = "spring";
  o.point = {0, Vector3::Zero()};
  o.stiffness(3, 3) = 7e5;
  const Restoring spring(o);
  for (const double angle : {0.01, 0.5, 1.5, -3.0}) {
    suite::Scene s;
    s.body.resize(1);
    s.body[0].R_WB = rotation_from({angle, 0.0, 0.0});
    suite::Store store(spring);
    const VectorX Q = suite::forces(spring, s, 0.0, store.memory());
    CHECK(Q[3] == Approx(-7e5 * angle).epsilon(1e-10));
    CHECK(Q.norm() == Approx(7e5 * std::abs(angle)).epsilon(1e-10));
  }
}

TEST_CASE("matrices that no spring or damper has are refused", "[restoring]") {
  Matrix6 good = Matrix6::Identity(), skew = good, negative = good;
  skew(0, 4) = 0.3;
  negative(2, 2) = -1.0;
  CHECK(refused(good, good).empty());
  CHECK(refused(negative, good).empty());  // an unstable hull has such a stiffness; statics say so
  CHECK_THAT(refused(skew, good), Catch::Contains("stiffness_matrix_kN_m") && Catch::Contains("symmetric"));
  CHECK_THAT(refused(good, skew), Catch::Contains("damping_matrix_kN_s_m"));
  CHECK_THAT(refused(good, negative), Catch::Contains("positive semidefinite"));
}
