// A coefficient file in a case: what comes of it does not depend on where the case puts the origin of the body.
#include <catch2/catch.hpp>

#include "sim/hull/coefficients/coefficient_source.h"
#include "sim/hull/coefficients/database.h"
#include "tests/sim/coefficient_sets.h"
#include "tests/sim/temporary_folder.h"

namespace stillhook {
namespace {

const Vector3 kHull(110.0, 46.0, 8.0);
constexpr double kDraft = 4.0;  // m, of crane_set

/// The hydrostatic stiffness of a box about the middle of its water plane, without its weight. N/m, N, N m
Matrix6 box_stiffness(double weight) {
  Matrix6 C = Matrix6::Zero();
  const double L = kHull.x(), B = kHull.y(), buoyancy = L * B * kDraft * (-0.5 * kDraft);
  C(2, 2) = weight * L * B;
  C(3, 3) = weight * (L * B * B * B / 12.0 + buoyancy);
  C(4, 4) = weight * (B * L * L * L / 12.0 + buoyancy);
  return C;
}

struct Case {
  Mesh mesh;
  BodySpec body;
  HullAfloat hull;
  std::vector<std::string> warnings;
  std::shared_ptr<const HydrodynamicCoefficients> set;

  /// The box with its body frame at `origin` of the database, floating at its draft.
  Case(const std::string& file, const Vector3& origin, const SeaSpec& sea, const Vector3& xbody = Vector3::Zero()) {
    mesh = box_mesh(kHull, Vector3(0.0, 0.0, 0.5 * kHull.z() - kDraft) - origin, 6.0);
    body.name = "crane";
    body.cog = Vector3(0.0, 0.0, 3.0) - origin;
    body.hydrodynamics.kind = HydrodynamicsSpec::Kind::database;
    body.hydrodynamics.coefficient_file = file;
    body.hydrodynamics.database_origin = origin;
    body.hydrodynamics.database_xbody = xbody;
    hull = {&body, &mesh, -origin.z(), 0.0, 0.0, 0.0};
    PanelMethodSpec method;
    method.accepted_checks = "long_wave_heave";  // of a stiffness that is wrong on purpose
    set = coefficient_set({&hull, 1}, sea, method, warnings);
  }
};

/// The crane vessel's set as WAMIT files, moments about `xbody`.
SeaSpec write_files(const std::string& base, const Vector3& xbody, const Matrix6& stiffness) {
  HydrodynamicCoefficients c = crane_set();
  std::vector<double> frequencies;
  for (int n = 1; n <= 75; ++n) frequencies.push_back(0.04 * n);
  c.frequency = sampled(c, frequencies);  // dense enough for retardation functions
  WamitUnits u;
  u.density = c.density;
  u.gravity = c.gravity;
  u.reference = {xbody};
  DatabaseFrame f;
  f.length = c.length;
  f.bodies = {{Vector3(0.0, 0.0, -c.waterline), c.volume[0]}};
  write_wamit(base, c, u, f, {stiffness});
  SeaSpec sea;
  sea.density = c.density;
  sea.gravity = c.gravity;
  return sea;
}

}  // namespace

TEST_CASE("coefficients of WAMIT files do not depend on the origin of the body", "[database]") {
  const TemporaryFolder folder;
  const Vector3 xbody = GENERATE(Vector3(0.0, 0.0, 0.0), Vector3(12.0, 3.0, -1.5));
  const SeaSpec sea = write_files(folder / "crane", xbody, box_stiffness(1025.0 * 9.80665));
  const Vector3 amidships(0.0, 0.0, 0.0), aft(-40.0, 5.0, -2.0);
  const Case a(folder / "crane.1", amidships, sea, xbody), b(folder / "crane.1", aft, sea, xbody);
  // One motion of the vessel, one kinetic energy of the water: A about the same point, seen from either origin. Both
  // come of the same numbers, so that rounding alone tells them apart.
  CHECK(difference(about_point(a.set->A_inf, aft - amidships), b.set->A_inf) < 1e-9);
  for (std::size_t n = 0; n < a.set->frequency.size(); ++n)
    CHECK(difference(about_point(a.set->frequency[n].B, aft - amidships), b.set->frequency[n].B) < 1e-9);
  // The pitching moment about amidships of the forces at the stern: M_a = M_b + (aft - amidships) x F, but for the
  // phase at which each is written.
  const ExcitationTable &A = a.set->excitation, &B = b.set->excitation;
  for (int f = 0; f < static_cast<int>(A.frequencies.size()); ++f)
    for (int h = 0; h < static_cast<int>(A.headings.size()); ++h) {
      CHECK(std::abs(B.at(f, h, 2)) == Approx(std::abs(A.at(f, h, 2))).margin(1.0));  // N/m, of 1e7
      const Vector3 arm = aft - amidships;
      const Complex moment = B.at(f, h, 4) + arm.z() * B.at(f, h, 0) - arm.x() * B.at(f, h, 2);
      CHECK(std::abs(moment) == Approx(std::abs(A.at(f, h, 4))).margin(1e3));  // N m/m, of 1e9
    }
}

TEST_CASE("the stiffness of a .hst file is compared with the hull", "[database]") {
  const TemporaryFolder folder;
  const double weight = 1025.0 * 9.80665;
  const Vector3 amidships = Vector3::Zero();
  const auto warnings = [&](const Matrix6& C, const Vector3& origin = Vector3::Zero()) {
    const SeaSpec sea = write_files(folder / "crane", amidships, C);
    std::string all;
    for (const std::string& warning : Case(folder / "crane.1", origin, sea).warnings) all += warning + "\n";
    return all;
  };
  const auto says = Catch::Contains("is not that of the hull");
  const Matrix6 C = box_stiffness(weight);
  CHECK_THAT(warnings(C), !says);
  CHECK_THAT(warnings(C, Vector3(-40.0, 5.0, 0.0)), !says);  // the same hull, another origin
  // With the weight, and with that of another loading condition.
  const double mass = 110.0 * 46.0 * kDraft;
  for (const double height : {3.0, 11.0}) {
    Matrix6 heavy = C;
    heavy(3, 3) -= weight * mass * height;
    heavy(4, 4) -= weight * mass * height;
    CHECK_THAT(warnings(heavy), !says);
  }
  // Another hull: a tenth broader, so C33 by 10 % and C44 by a third; or 5 m further forward; or C44 alone.
  Matrix6 broad = C;
  broad(2, 2) *= 1.1;
  broad(3, 3) *= 1.331;
  CHECK_THAT(warnings(broad), says && Catch::Contains("C(3,3)") && Catch::Contains("C(4,4)"));
  Matrix6 forward = C;
  forward(2, 4) = forward(4, 2) = -5.0 * C(2, 2);
  CHECK_THAT(warnings(forward), says && Catch::Contains("centre of the water plane by C(3,5) is 5 m"));
  Matrix6 roll = C;
  roll(3, 3) *= 0.8;
  CHECK_THAT(warnings(roll), says && Catch::Contains("C(4,4)"));
}

TEST_CASE("XBODY is for files that do not name it", "[database]") {
  const TemporaryFolder folder;
  const HydrodynamicCoefficients c = crane_set();
  DatabaseFrame f;
  f.length = c.length;
  f.bodies = {{Vector3(0.0, 0.0, -c.waterline), c.volume[0]}};
  Matrix6 stiffness = box_stiffness(c.density * c.gravity);
  write_bemio(folder / "crane.H5", c, f, {{"crane", Vector3::Zero(), Vector3::Zero(), stiffness}});
  SeaSpec sea;
  sea.density = c.density;
  sea.gravity = c.gravity;
  CHECK_NOTHROW(Case(folder / "crane.H5", Vector3::Zero(), sea));  // in capitals too
  CHECK_THROWS_WITH(Case(folder / "crane.H5", Vector3::Zero(), sea, Vector3(1.0, 0.0, 0.0)),
                    Catch::Contains("leave database_xbody_m out"));
}

}  // namespace stillhook
