// One mass on each kind of spring-damper element, given a damping ratio of 0.100, decays at 0.100 +- 0.001. A sprung
// and damped joint is in tests/sim/hht_test.cpp. Mooring lines have no damper, and a tagline is a control law, so
// neither has a damping ratio to keep.
//
// The period is 1 s. The integrator adds damping and stiffness of its own: of order alpha (omega h)^3 and zeta (omega
// h)^2, with omega h = 0.063 at h = 0.01 s some 3e-4 in all, so what is left of 0.001 is the element's. At the 0.2 s of
// the fastest crane modes the same h would give 0.004: that is the method's, not the element's.
#include <catch2/catch.hpp>
#include <cmath>

#include "sim/lifting/contact.h"
#include "sim/lifting/wire.h"
#include "tests/sim/mechanism.h"
#include "tests/truth/oscillator.h"

using namespace stillhook;

namespace {

constexpr double kOmega = 2.0 * M_PI;  // rad/s
constexpr double kZeta = 0.1;
constexpr double kMass = 5e5;  // kg
constexpr double kG = 9.80665;

// Rests at `rest` (m); released 10 % of the static deflection above it, so that the element stays fully engaged.
double measured_ratio(Mechanism& m, double rest, double h, double alpha) {
  HhtStepper stepper(m.system, {alpha, 1e-8, 12});
  const int steps = static_cast<int>(4.0 / h), skipped = static_cast<int>(0.3 / h);
  std::vector<double> z;
  for (int k = 0; k < steps; ++k) {
    REQUIRE(stepper.step(m.state, h, m.state.drive));
    if (k >= skipped) z.push_back(m.state.body[0].p_WC.z() - rest);
  }
  return truth::damping_ratio(z);
}

const double kDeflection = kG / (kOmega * kOmega);  // m, static

}  // namespace

TEST_CASE("damping ratio of a mass on a wire under its static tension") {
  const double length = 80.0, k = kMass * kOmega * kOmega;
  for (const double h : {0.01, 0.001})
    for (const double alpha : {0.0, -0.05, -0.1}) {
      CAPTURE(h, alpha);
      truth::GeneralMotion draw(21);
      Mechanism m;
      BodyKinematics at;
      at.R_WB = draw.rotation();
      const Vector3 sheave(12.0, -7.0, 110.0), arm(0.0, 0.0, 3.0);
      const double rest = sheave.z() - length - kDeflection - arm.z();
      at.p_WC = Vector3(sheave.x(), sheave.y(), rest + 0.1 * kDeflection);
      m.add_body("load", kMass, general_inertia(draw, 1e6), at);
      WireOptions o;
      o.name = "wire";
      o.from = {kWorld, sheave};
      o.to = {0, at.R_WB.transpose() * arm};
      o.axial_stiffness = k * length;
      o.unstretched_length = length;
      o.damping = wire_damping(kZeta, kMass, o.axial_stiffness, length);
      m.system.elements.push_back(std::make_unique<Wire>(o));
      m.finish();
      CHECK(measured_ratio(m, rest, h, alpha) == Approx(kZeta).margin(0.001));
    }
}

TEST_CASE("damping ratio of a mass standing on a contact with its static penetration") {
  const double k = kMass * kOmega * kOmega;
  for (const double h : {0.01, 0.001})
    for (const double alpha : {0.0, -0.05, -0.1}) {
      CAPTURE(h, alpha);
      truth::GeneralMotion draw(22);
      Mechanism m;
      BodyKinematics at;
      at.R_WB = rotation_from({0.0, 0.0, 0.7});  // turned in the plane only: the four corners stand level
      const double deck = 4.0, height = 5.0, rest = deck + height - kDeflection;
      at.p_WC = Vector3(12.0, -7.0, rest + 0.1 * kDeflection);
      m.add_body("load", kMass, Vector3(7e7, 8e6, 7e7).asDiagonal(), at);
      ContactOptions o;
      o.name = "deck";
      o.body = 0;
      for (const double x : {-5.0, 5.0})
        for (const double y : {-20.0, 20.0}) o.points.push_back(Vector3(x, y, -height));
      o.surface = {kWorld, Vector3(10.0, -5.0, deck)};
      o.length = o.breadth = 100.0;
      o.stiffness = k;
      o.damping = 2.0 * kZeta * kMass * kOmega;
      o.friction = 0.3;
      m.system.elements.push_back(std::make_unique<Contact>(o));
      m.finish();
      SystemWorkspace work = m.system.make_workspace();
      m.system.start_elements(m.state, work);
      CHECK(measured_ratio(m, rest, h, alpha) == Approx(kZeta).margin(0.001));
    }
}
