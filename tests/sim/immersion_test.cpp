#include "sim/hull/immersion.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

namespace stillhook {
namespace {

using Real = long double;
using Vector3L = Eigen::Matrix<Real, 3, 1>;

// Volume and first moment of solids given by their corners, in long double, without the divergence theorem.
struct Solid {
  Real volume = 0;
  Vector3L moment = Vector3L::Zero();
  void add_tetrahedron(const Vector3L& a, const Vector3L& b, const Vector3L& c, const Vector3L& d, Real sign = 1) {
    const Real v = sign * std::abs((b - a).dot((c - a).cross(d - a))) / 6;
    volume += v;
    moment += v * (a + b + c + d) / 4;
  }
  // The wedge between triangles abc and def, with edges a-d, b-e, c-f.
  void add_wedge(const Vector3L& a, const Vector3L& b, const Vector3L& c, const Vector3L& d, const Vector3L& e,
                 const Vector3L& f) {
    add_tetrahedron(a, b, c, d);
    add_tetrahedron(b, c, d, e);
    add_tetrahedron(c, d, e, f);
  }
};

Vector3L at_surface(const Vector3L& a, const Vector3L& b) { return a + (b - a) * (a.z() / (a.z() - b.z())); }

// The part of a tetrahedron below z = 0 is a tetrahedron, the rest of one, or a wedge.
Solid below_surface(std::array<Vector3L, 4> p) {
  std::ranges::sort(p, {}, [](const Vector3L& v) { return v.z(); });
  const auto wet = std::ranges::count_if(p, [](const Vector3L& v) { return v.z() < 0; });
  Solid s;
  if (wet == 1) s.add_tetrahedron(p[0], at_surface(p[0], p[1]), at_surface(p[0], p[2]), at_surface(p[0], p[3]));
  if (wet == 2)
    s.add_wedge(p[0], at_surface(p[0], p[2]), at_surface(p[0], p[3]), p[1], at_surface(p[1], p[2]),
                at_surface(p[1], p[3]));
  if (wet >= 3) s.add_tetrahedron(p[0], p[1], p[2], p[3]);
  if (wet == 3)
    s.add_tetrahedron(p[3], at_surface(p[3], p[0]), at_surface(p[3], p[1]), at_surface(p[3], p[2]), Real(-1));
  return s;
}

TEST_CASE("tetrahedra at general attitudes are clipped exactly") {
  const Mesh mesh{{{-1.0, -2.0, -0.5}, {3.0, -0.4, 0.2}, {0.3, 2.5, -0.8}, {0.4, 0.1, 2.9}},
                  {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  check_mesh(mesh, "tetrahedron");
  const double size = 5.0;
  int cut[5] = {};
  for (int i = 0; i < 300; ++i) {
    const Pose X{rotation_from({0.7 * i, 1.1 * std::sin(2.3 * i), 1.9 * i}),
                 Vector3(40.0 * std::sin(i), -30.0 * std::cos(3.0 * i), 2.5 * std::sin(1.3 * i))};
    std::array<Vector3L, 4> p;
    for (int v = 0; v < 4; ++v) p[v] = X.R.cast<Real>() * mesh.vertices[v].cast<Real>() + X.p.cast<Real>();
    ++cut[std::ranges::count_if(p, [](const Vector3L& v) { return v.z() < 0; })];
    const Solid truth = below_surface(p);
    const HydrostaticSummary got = immersion_of(mesh, X);
    // 1e-12 of the size, as an error of volume and of volume times centroid: the centroid of a sliver is worth no more.
    CHECK(std::abs(got.volume - double(truth.volume)) < 1e-12 * std::pow(size, 3));
    if (truth.volume == 0) continue;
    const Vector3 centroid = (truth.moment / truth.volume).cast<double>();
    CHECK((got.centre_of_buoyancy - centroid).norm() * double(truth.volume) < 1e-12 * std::pow(size, 3) * 50.0);
    CHECK(got.lowest ==
          Approx(double(std::ranges::min(p, {}, [](const Vector3L& v) { return v.z(); }).z())).margin(1e-13));
  }
  for (const int n : cut) CHECK(n > 10);  // every way of cutting has been met
}

TEST_CASE("a heeled and trimmed box has its closed-form immersion while the edges stay put") {
  const double L = 110.0, B = 46.0, D = 7.5;
  const Vector3 centre(2.0, -1.0, 0.7);
  const Mesh mesh = box_mesh({L, B, D}, centre, 13.0);
  const Matrix3 R = rotation_from({0.05, -0.02, 2.2});
  const Pose X{R, {500.0, -300.0, -1.1}};
  const HydrostaticSummary got = immersion_of(mesh, X);

  // In the box's axes, from the middle of its bottom, the surface is z = h + sx x + sy y.
  const Vector3 up = R.row(2);
  const double h = -(X * Vector3(centre.x(), centre.y(), centre.z() - D / 2)).z() / up.z();
  const double sx = -up.x() / up.z(), sy = -up.y() / up.z();
  REQUIRE(std::abs(sx) * L / 2 + std::abs(sy) * B / 2 < std::min(h, D - h));
  const double volume = L * B * h;
  const Vector3 buoyancy(L * L * sx / 12 / h, B * B * sy / 12 / h,
                         h / 2 + (sx * sx * L * L + sy * sy * B * B) / 24 / h);
  // A hundred metres in double: 1e-12 of the size in length, of its cube in volume.
  CHECK(std::abs(got.volume - volume) < 1e-12 * L * L * L);
  CHECK((got.centre_of_buoyancy - X * (centre + buoyancy - Vector3(0, 0, D / 2))).norm() < 1e-12 * L);
  CHECK(got.waterplane_area == Approx(L * B / up.z()).epsilon(1e-12));
  const Vector3 flotation = X * (centre + Vector3(0, 0, h - D / 2));
  CHECK((got.centre_of_flotation - flotation.head<2>()).norm() < 1e-12 * L);
  // Second moments: those of the rectangle, mapped to the horizontal along the heading.
  const Matrix3 R_HB = heading_rotation(R).transpose() * R;
  const Vector3 along = R_HB * Vector3(1.0, 0.0, sx), across = R_HB * Vector3(0.0, 1.0, sy);
  const double ixx = L * L / 12 * along.x() * along.x() + B * B / 12 * across.x() * across.x();
  const double iyy = L * L / 12 * along.y() * along.y() + B * B / 12 * across.y() * across.y();
  CHECK(got.longitudinal_inertia == Approx(ixx * L * B / up.z()).epsilon(1e-12));
  CHECK(got.transverse_inertia == Approx(iyy * L * B / up.z()).epsilon(1e-12));
}

TEST_CASE("the reference hull: displacement, GM and wall-sided GZ up to deck-edge immersion") {
  const double L = 110.0, B = 46.0, D = 7.5, T = 4.0, density = 1025.0;
  const Mesh mesh = box_mesh({L, B, D}, {0.0, 0.0, D / 2 - T}, 6.0);
  const HydrostaticSummary upright = immersion_of(mesh, {});
  const double mass = density * upright.volume;
  CHECK(mass == Approx(20.746e6).epsilon(1e-12));  // 110 x 46 x 4 x 1.025 t exactly
  CHECK(upright.freeboard == Approx(3.5).epsilon(1e-13));
  CHECK(upright.lowest == Approx(-4.0).epsilon(1e-13));
  const Vector3 G(0.0, 0.0, 4.541);
  const MetacentricHeights gm = metacentric_heights(upright, mass, G, density);
  // I/V + KB - KG with I = L B^3/12, V = L B T: 46^2/48 - 2 - 4.541 and 110^2/48 - 2 - 4.541.
  CHECK(gm.transverse == Approx(46.0 * 46.0 / 48.0 - 6.541).epsilon(1e-12));
  CHECK(gm.longitudinal == Approx(110.0 * 110.0 / 48.0 - 6.541).epsilon(1e-12));
  // Reference data set of the lift: 37.54 and 245.54 m, to the digits given.
  CHECK(std::abs(gm.transverse - 37.54) < 0.005);
  CHECK(std::abs(gm.longitudinal - 245.54) < 0.005);

  const double BM = B * B / (12.0 * T);
  for (const double heel : {0.01, 0.05, 0.1, 0.149}) {  // the deck goes under at atan(3.5/23) = 0.151
    const HydrostaticSummary heeled = immersion_of(mesh, {rotation_from({heel, 0.0, 0.0}), Vector3::Zero()});
    // The box turns about the middle of its waterplane: the volume stays.
    CHECK(heeled.volume == Approx(upright.volume).epsilon(1e-12));
    const Vector3 G_W = rotation_from({heel, 0.0, 0.0}) * G;
    // Roll+ is port side up: starboard goes down and the buoyancy moves to negative y.
    const double GZ = -(heeled.centre_of_buoyancy.y() - G_W.y());
    const double t = std::tan(heel);
    CHECK(GZ == Approx(std::sin(heel) * (gm.transverse + 0.5 * BM * t * t)).epsilon(1e-11));
  }
  const HydrostaticSummary over = immersion_of(mesh, {rotation_from({0.2, 0.0, 0.0}), Vector3::Zero()});
  const double t = std::tan(0.2), GZ = (rotation_from({0.2, 0.0, 0.0}) * G).y() - over.centre_of_buoyancy.y();
  CHECK(GZ < 0.97 * std::sin(0.2) * (gm.transverse + 0.5 * BM * t * t));  // past the deck edge it falls short
}

TEST_CASE("a hull in the air and a hull under water") {
  const Mesh mesh = box_mesh({6.0, 4.0, 2.0}, {0.0, 0.0, 0.0}, 2.0);
  const Matrix3 R = rotation_from({0.3, 0.2, 0.1});
  const HydrostaticSummary dry = immersion_of(mesh, {R, {5.0, 6.0, 4.0}});
  CHECK(dry.volume == 0.0);
  CHECK(dry.waterplane_area == 0.0);
  CHECK(dry.lowest > 0.0);
  const HydrostaticSummary sunk = immersion_of(mesh, {R, {5.0, 6.0, -40.0}});
  CHECK(sunk.volume == Approx(48.0).epsilon(1e-12));
  CHECK((sunk.centre_of_buoyancy - Vector3(5.0, 6.0, -40.0)).norm() < 1e-11);
  CHECK(sunk.waterplane_area == 0.0);
  CHECK(sunk.transverse_inertia == 0.0);
}

}  // namespace
}  // namespace stillhook

namespace stillhook {

TEST_CASE("where a hull floats for a displaced volume", "[immersion]") {
  // 20 x 10 x 6 m, bottom 1 m below Bo: 400 m3 is a draft of 2 m.
  const Mesh box = box_mesh(Vector3(20.0, 10.0, 6.0), Vector3(3.0, -2.0, 2.0), 2.0);
  CHECK(floating_height(box, 400.0) == Approx(-1.0 + 2.0).epsilon(1e-12));
  CHECK(floating_height(box, 1e6) == Approx(5.0).epsilon(1e-12));  // cannot: its top
}

}  // namespace stillhook
