#include "sim/lifting/mooring.h"

#include <catch2/catch.hpp>

#include <cmath>

#include "sim/specification.h"
#include "tests/sim/force_element_suite.h"
#include "tests/truth/moorpy_catenary.h"

using namespace stillhook;

namespace {

const BodyPoint kFairlead{0, {55.0, 23.0, -2.0}};
constexpr double kAzimuth = 0.8;

suite::Scene moored_hull(const Vector3& shift = Vector3::Zero()) {
  suite::Scene s;
  s.body.resize(1);
  s.body[0].R_WB = rotation_from({0.02, -0.03, 0.4});
  s.body[0].p_WC = Vector3(3.0, -5.0, 1.0) + shift;
  s.drive.resize(1);
  return s;
}

MooringOptions catenary_options() {
  MooringOptions o;
  o.name = "bow_port";
  o.fairlead = kFairlead;
  o.azimuth = kAzimuth;
  o.pretension = 150e3;
  o.line = {.length = 250.0, .weight = 700.0, .axial_stiffness = 3e8, .seabed_friction = 0.8};
  o.depth = 30.0;
  o.tow_drive = 0;
  o.tow_direction = Vector3(std::cos(kAzimuth), std::sin(kAzimuth), 0.0);
  return o;
}

MooringOptions linear_options() {
  MooringOptions o = catenary_options();
  o.type = MooringOptions::Type::linear;
  o.stiffness = 1e5;
  o.anchor_distance = 200.0;
  return o;
}

Vector3 force_on(const Mooring& line, const suite::Scene& s) {
  suite::Store store(line);
  line.start(s.instant(), store.memory());
  const VectorX Q = suite::forces(line, s, 0.0, store.memory());
  return {Q[0], Q[1], Q[2]};
}

}  // namespace

TEST_CASE("a mooring line has its pretension at the initial pose, towards its azimuth") {
  const suite::Scene s = moored_hull();
  const Vector3 outward(std::cos(kAzimuth), std::sin(kAzimuth), 0.0);
  for (const MooringOptions& o : {catenary_options(), linear_options()}) {
    const Mooring line(o, s.instant());
    const Vector3 F = force_on(line, s);
    CHECK(F.dot(outward) == Approx(150e3).epsilon(1e-9));
    CHECK(F.cross(Vector3::UnitZ()).norm() == Approx(150e3).epsilon(1e-9));
    if (o.type == MooringOptions::Type::linear) {
      CHECK(F.z() == 0.0);
    } else {
      CHECK(F.z() < -0.1 * 150e3);  // the line hangs down
      CHECK(line.anchor().z() == -30.0);
      const Vector3 fairlead = motion_of(kFairlead, s.instant()).p;
      const CatenaryLoad load =
          solve_catenary(o.line, (line.anchor() - fairlead).head<2>().norm(), fairlead.z() + 30.0);
      CHECK(-F.z() == Approx(load.V).epsilon(1e-9));
      CHECK(load.grounded_length > 0.0);
    }
  }
}

TEST_CASE("a mooring line pulls harder when the hull moves away, and never pushes") {
  const Vector3 outward(std::cos(kAzimuth), std::sin(kAzimuth), 0.0);
  for (const MooringOptions& o : {catenary_options(), linear_options()}) {
    const suite::Scene s = moored_hull();
    const Mooring line(o, s.instant());
    CHECK(force_on(line, moored_hull(-0.5 * outward)).dot(outward) > 150e3 + 1e3);
    for (const double towards : {0.2, 0.5, 1.0, 1.5, 5.0, 50.0, 150.0})
      CHECK(force_on(line, moored_hull(towards * outward)).dot(outward) >= 0.0);
    CHECK(force_on(line, moored_hull(50.0 * outward)).head<2>().norm() == 0.0);  // slack
  }
  const suite::Scene s = moored_hull();
  const Mooring line(linear_options(), s.instant());
  CHECK(force_on(line, moored_hull(-0.5 * outward)).dot(outward) == Approx(150e3 + 0.5 * 1e5).epsilon(1e-9));
  CHECK(force_on(line, moored_hull(1.4 * outward)).dot(outward) == Approx(150e3 - 1.4e5).epsilon(1e-9));
}

TEST_CASE("beyond the anchor a mooring line pulls back") {
  const Vector3 outward(std::cos(kAzimuth), std::sin(kAzimuth), 0.0);
  const suite::Scene s = moored_hull();
  for (const MooringOptions& o : {catenary_options(), linear_options()}) {
    const Mooring line(o, s.instant());
    CHECK(force_on(line, moored_hull(500.0 * outward)).dot(outward) < -1e5);
  }
}

TEST_CASE("towing the anchor is the same as moving the hull the other way") {
  for (const MooringOptions& o : {catenary_options(), linear_options()}) {
    suite::Scene s = moored_hull();
    s.drive[0].position = 7.0;  // the line is laid with the drive anywhere
    const Mooring line(o, s.instant());
    CHECK(force_on(line, s).head<2>().norm() == Approx(150e3).epsilon(1e-9));
    suite::Scene towed = s, moved = s;
    towed.drive[0].position += 0.8;
    moved.body[0].p_WC -= 0.8 * o.tow_direction;
    CHECK(force_on(line, towed).isApprox(force_on(line, moved), 1e-9));
  }
}

TEST_CASE("the moment of the mooring force about the vertical is that of Eq. 11") {
  const suite::Scene s = moored_hull(Vector3(-0.7, 0.4, 0.0));
  const Mooring line(catenary_options(), moored_hull().instant());
  suite::Store store(line);
  line.start(s.instant(), store.memory());
  const VectorX Q = suite::forces(line, s, 0.0, store.memory());
  std::vector<double> out(2);
  line.measure(s.instant(), store.memory(), out);
  const Vector3 arm = motion_of(kFairlead, s.instant()).p - s.body[0].p_WC;
  const Vector3 to_anchor = line.anchor() - motion_of(kFairlead, s.instant()).p;
  const double psi = std::atan2(to_anchor.y(), to_anchor.x());
  CHECK(Q[0] == Approx(out[1] * std::cos(psi)).epsilon(1e-9));
  CHECK(Q[1] == Approx(out[1] * std::sin(psi)).epsilon(1e-9));
  const double moment = (s.body[0].R_WB * Q.segment<3>(3)).z();
  CHECK(moment == Approx(out[1] * (arm.x() * std::sin(psi) - arm.y() * std::cos(psi))).epsilon(1e-9));
  CHECK(out[0] == Approx(Q.head<3>().norm()).epsilon(1e-9));
}

TEST_CASE("a mooring line that cannot be is refused") {
  const suite::Scene s = moored_hull();
  const auto refused = [&](auto change) {
    MooringOptions o = catenary_options();
    change(o);
    CHECK_THROWS_AS(Mooring(o, s.instant()), SpecificationError);
  };
  refused([](auto& o) { o.pretension = 0.0; });
  refused([](auto& o) { o.depth = 0.0; });
  refused([](auto& o) { o.line.length = -3.0; });
  refused([](auto& o) { o.line.weight = 0.0; });
  refused([](auto& o) { o.line.seabed_friction = std::nan(""); });
  refused([](auto& o) { o.tow_direction = Vector3(1.0, 1.0, 0.0); });
  refused([](auto& o) { o = linear_options(), o.stiffness = 0.0; });
  refused([](auto& o) { o = linear_options(), o.anchor_distance = 0.0; });
}

TEST_CASE("an anchor by position: the line's length gives the tension") {
  const suite::Scene s = moored_hull();
  const Vector3 fairlead = motion_of(kFairlead, s.instant()).p;
  // MoorPy's hanging lines, from an anchor (a buoy, a pile) far above the bottom.
  for (const truth::CatenaryRow& row : truth::kMoorPyCatenaries) {
    if (row.on_seabed) continue;
    MooringOptions o;
    o.name = "line";
    o.fairlead = kFairlead;
    const Vector3 away(std::cos(2.0), std::sin(2.0), 0.0);
    o.anchor = fairlead + row.x * away - row.z * Vector3::UnitZ();
    o.line = {row.length, row.weight, row.axial_stiffness};
    o.depth = 1000.0;
    const Vector3 F = force_on(Mooring(o, s.instant()), s);
    // Their solver stops at 1e-6 m, which is about 1e-7 of these loads.
    CHECK(F.dot(away) == Approx(row.H).epsilon(1e-6));
    CHECK(-F.z() == Approx(row.V).epsilon(1e-6));
    // The same line upside down, buoyant, from as far above a point that lies deep enough for it.
    o.fairlead.c_B.z() -= 400.0;
    o.anchor = motion_of(o.fairlead, s.instant()).p + row.x * away + row.z * Vector3::UnitZ();
    o.line.weight = -row.weight;
    const Vector3 up = force_on(Mooring(o, s.instant()), s);
    CHECK(up.dot(away) == Approx(row.H).epsilon(1e-6));
    CHECK(up.z() == Approx(row.V).epsilon(1e-6));
  }
  // On the bottom it is the line that azimuth and pretension would have laid.
  const Mooring laid(catenary_options(), s.instant());
  MooringOptions placed = catenary_options();
  placed.anchor = laid.anchor();
  placed.azimuth = 0.0;
  placed.pretension = 0.0;
  CHECK((force_on(Mooring(placed, s.instant()), s) - force_on(laid, s)).norm() < 1e-6);
  MooringOptions spring = linear_options();
  spring.anchor = Mooring(linear_options(), s.instant()).anchor();
  spring.azimuth = spring.anchor_distance = 0.0;
  CHECK((force_on(Mooring(spring, s.instant()), s) - force_on(Mooring(linear_options(), s.instant()), s)).norm() < 1e-6);
}

TEST_CASE("anchors and lines that are not what the model says are refused with the remedy") {
  const suite::Scene s = moored_hull();
  const auto said = [&](const Vector3& from_fairlead, double length, double weight) {
    MooringOptions o;
    o.name = "line";
    o.fairlead = {0, kFairlead.c_B - Vector3(0.0, 0.0, 6.0)};  // under water
    const Vector3 at = motion_of(o.fairlead, s.instant()).p;
    o.anchor = at + from_fairlead;
    o.line = {length, weight, 1e8};
    o.depth = 60.0;
    try {
      Mooring line(o, s.instant());
    } catch (const SpecificationError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  using Catch::Contains;
  CHECK(said({80.0, 0.0, -20.0}, 84.0, 300.0).empty());
  CHECK_THAT(said({80.0, 0.0, -70.0}, 120.0, 300.0), Contains("below the sea bed"));
  CHECK_THAT(said({80.0, 0.0, -20.0}, 60.0, 300.0), Contains("too short"));
  CHECK_THAT(said({80.0, 0.0, -20.0}, 160.0, 300.0), Contains("would lie on it"));
  CHECK(said({80.0, 0.0, -40.0}, 91.0, -300.0).empty());
  CHECK_THAT(said({80.0, 0.0, -20.0}, 160.0, -300.0), Contains("float at the surface"));
  CHECK_THAT(said({80.0, 0.0, -20.0}, 84.0, 0.0), Contains("wire from"));
}
