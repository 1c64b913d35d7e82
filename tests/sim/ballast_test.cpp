#include "sim/lifting/ballast.h"

#include <catch2/catch.hpp>

#include "sim/specification.h"
#include "tests/sim/force_element_suite.h"

using namespace stillhook;

namespace {

BallastOptions shift_aft() {
  BallastOptions o;
  o.name = "shift";
  o.from = {0, {40.0, 2.0, -1.0}};
  o.to = {0, {-34.0, 2.0, -1.0}};
  o.mass = 1e6;
  o.drive = 0;
  return o;
}

VectorX force_at(double share, const Matrix3& R_WB = Matrix3::Identity()) {
  suite::Scene s;
  s.body.resize(1);
  s.body[0].R_WB = R_WB;
  s.drive = {{share, 0.0}};
  return suite::forces(Ballast(shift_aft()), s, 0.0, {});
}

}  // namespace

TEST_CASE("ballast moved aft lifts the bow and weighs nothing more") {
  const VectorX Q = force_at(0.6);
  CHECK(Q.head<3>().norm() == 0.0);
  // 600 t over 74 m; pitch is positive bow down, so the moment about y is negative.
  CHECK(Q[4] == Approx(-0.6e6 * 9.80665 * 74.0).epsilon(1e-13));
  CHECK(std::abs(Q[3]) < 1e-9 * std::abs(Q[4]));
  CHECK(force_at(0.0).norm() == 0.0);
}

TEST_CASE("the lever of ballast is horizontal in the world") {
  const Matrix3 bow_down = rotation_from({0.0, 0.3, 1.1});
  CHECK(force_at(1.0, bow_down)[4] == Approx(-1e6 * 9.80665 * 74.0 * std::cos(0.3)).epsilon(1e-13));
}

TEST_CASE("a ballast transfer that cannot be is refused") {
  BallastOptions o = shift_aft();
  o.drive = -1;
  CHECK_THROWS_AS(Ballast(o), SpecificationError);
  o = shift_aft();
  o.mass = -1.0;
  CHECK_THROWS_AS(Ballast(o), SpecificationError);
  o = shift_aft();
  o.to.body = 1;
  CHECK_THROWS_AS(Ballast(o), SpecificationError);
}
