#include "results/clearance.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/results/synthetic_lift.h"

using namespace stillhook;
using Shape = ClearanceSpec::Shape;

namespace {

// FCL's distance is iterative and now and then stops early: 7e-5 m is the worst of these draws. A fifth of a millimetre
// is far below what any clearance is judged by.
constexpr double kSolver = 2e-4;

/// Distance of a point from a box in the box's own axes, in closed form.
double point_to_box(const Vector3& p, const Vector3& low, const Vector3& high) {
  return (p - p.cwiseMax(low).cwiseMin(high)).norm();
}

/// Distance of a segment from a box: the point-to-box distance is convex along the segment, so a ternary search finds
/// it.
double segment_to_box(const Vector3& a, const Vector3& b, const Vector3& low, const Vector3& high) {
  double s0 = 0.0, s1 = 1.0;
  const auto at = [&](double s) { return point_to_box(a + s * (b - a), low, high); };
  for (int i = 0; i < 200; ++i) {
    const double m0 = s0 + (s1 - s0) / 3.0, m1 = s1 - (s1 - s0) / 3.0;
    (at(m0) < at(m1) ? s1 : s0) = at(m0) < at(m1) ? m1 : m0;
  }
  return at(0.5 * (s0 + s1));
}

}  // namespace

TEST_CASE("capsule to box agrees with the closed form at general poses") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto vector = [&](double size) {
    return Vector3(size * unit(random), size * unit(random), size * unit(random));
  };
  int apart = 0;
  for (int i = 0; i < 200; ++i) {
    const Pose X_WA{exp_rotation(vector(1.5)), vector(10.0)}, X_WB{exp_rotation(vector(1.5)), vector(10.0)};
    const Shape boom{"a", vector(20.0), vector(20.0), 0.5};
    const Shape load{"b", Vector3(5.0, -3.0, 4.0), Vector3(-2.0, 6.0, -1.0), 0.0};  // corners in any order
    const Pose X_BA = X_WB.inverse() * X_WA;
    const double truth =
        segment_to_box(X_BA * boom.from, X_BA * boom.to, load.from.cwiseMin(load.to), load.from.cwiseMax(load.to)) -
        0.5;
    apart += truth > 0.0;
    INFO(i);
    CHECK(shape_distance(boom, X_WA, load, X_WB) == Approx(std::max(0.0, truth)).margin(kSolver));
    CHECK(shape_distance(load, X_WB, boom, X_WA) == Approx(std::max(0.0, truth)).margin(kSolver));
  }
  CHECK(apart > 50);  // the draw holds enough pairs that do not touch
}

TEST_CASE("two boxes turned against each other: edge to edge and face to corner") {
  const Shape cube{"a", Vector3(-1, -1, -1), Vector3(1, 1, 1), 0.0};
  const Pose turned{exp_rotation(Vector3(0, 0, M_PI / 4)), Vector3(5, 0, 0.3)};
  CHECK(shape_distance(cube, Pose{}, cube, turned) == Approx(4.0 - std::sqrt(2.0)).margin(kSolver));
  const Pose lifted{Matrix3::Identity(), Vector3(4, 5, 6)};
  CHECK(shape_distance(cube, Pose{}, cube, lifted) == Approx(Vector3(2, 3, 4).norm()).margin(kSolver));
  CHECK(shape_distance(cube, Pose{}, cube, Pose{Matrix3::Identity(), Vector3(1, 1, 1)}) == 0.0);
}

TEST_CASE("the minimum along a run is that of every sample, wherever it hides between the coarse ones") {
  const truth::SyntheticLift lift;
  const ClearanceSeries coarse = compute_clearances(lift.specification, lift.trajectory)[0];
  const ClearanceSeries all = compute_clearances(lift.specification, lift.trajectory, 0.1)[0];
  CHECK(all.time.size() == lift.trajectory.time.size());
  CHECK(coarse.time.size() < all.time.size() / 2);
  CHECK(coarse.minimum == Approx(all.minimum).margin(1e-12));
  CHECK(coarse.minimum_time == all.minimum_time);
  CHECK(std::is_sorted(coarse.time.begin(), coarse.time.end()));
}
