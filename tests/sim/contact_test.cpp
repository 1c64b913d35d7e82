#include "sim/lifting/contact.h"

#include <catch2/catch.hpp>

#include <cmath>

#include "sim/specification.h"
#include "tests/sim/force_element_suite.h"

using namespace stillhook;
using suite::Scene;

namespace {

constexpr double kWeight = 9.80665e6;  // N, of 1,000 t

// The foot of a box 10 m x 40 m x 10 m on a deck whose top is 2.88 m above the barge's centre of gravity.
ContactOptions deck() {
  ContactOptions o;
  o.name = "deck";
  o.body = 0;
  o.points = {{5.0, 20.0, -5.0}, {5.0, -20.0, -5.0}, {-5.0, 20.0, -5.0}, {-5.0, -20.0, -5.0}};
  o.surface = {1, {0.0, 0.0, 2.88}};
  o.length = 24.0;
  o.breadth = 82.0;
  o.stiffness = 2e8;
  o.damping = 2.8e6;
  o.friction = 0.3;
  return o;
}

// The box pressed in by `depth` on a barge with this attitude; the box stands square on it.
Scene on_deck(double depth, const RollPitchYaw& attitude = {}) {
  Scene s;
  s.body.resize(2);
  s.body[1].R_WB = rotation_from(attitude);
  s.body[1].p_WC = Vector3(74.0, 3.0, -0.1);
  s.body[0].R_WB = s.body[1].R_WB;
  s.body[0].p_WC = s.body[1].p_WC + s.body[1].R_WB * Vector3(0.0, 0.0, 2.88 + 5.0 - depth);
  return s;
}

struct Started {
  Started(const ContactOptions& o, const Scene& s) : contact(o), store(contact) {
    contact.start(s.instant(), memory());
  }
  Memory memory() { return store.memory(); }
  Vector3 force_on_box(const Scene& s) {
    const VectorX Q = suite::forces(contact, s, 0.05, memory());
    return {Q[0], Q[1], Q[2]};
  }
  std::vector<double> channels(const Scene& s) {
    std::vector<double> out(7);
    contact.measure(s.instant(), memory(), out);
    return out;
  }
  Contact contact;
  suite::Store store;
};

}  // namespace

TEST_CASE("a load at rest stands as deep as its weight presses it") {
  const double depth = kWeight / 2e8;
  const Scene s = on_deck(depth);
  Started c(deck(), s);
  const Vector3 F = c.force_on_box(s);
  // Depth is the difference of heights of metres: 1e-16 / 0.05.
  CHECK(F.z() == Approx(kWeight).epsilon(1e-12));
  CHECK(F.head<2>().norm() == 0.0);
  const std::vector<double> out = c.channels(s);
  CHECK(out[0] == Approx(kWeight).epsilon(1e-12));
  CHECK(out[1] == Approx(depth).epsilon(1e-12));
  CHECK(out[2] == Approx(-depth).epsilon(1e-12));
  CHECK(out[4] == Approx(74.0));
  CHECK(out[5] == Approx(3.0));
  CHECK(out[6] == Approx(-0.1 + 2.88 - depth));
}

TEST_CASE("contact pushes along the surface, never pulls, and starts without a jump") {
  const RollPitchYaw tilted{0.1, -0.07, 0.6};
  const Vector3 normal = rotation_from(tilted).col(2);
  ContactOptions smooth = deck();
  smooth.friction = 0.0;
  for (double rate = -3.0; rate <= 3.0; rate += 0.25) {
    for (const double depth : {-1.0, -1e-9, 1e-12, 1e-4, 0.003, 0.05}) {
      Scene s = on_deck(depth, tilted);
      s.body[0].v_WC = -rate * normal;  // positive rate: approaching
      Started c(smooth, s);
      const Vector3 F = c.force_on_box(s);
      CHECK(F.dot(normal) >= 0.0);
      CHECK(F.cross(normal).norm() <= 1e-10 * (1.0 + F.norm()));
      if (depth < 0.0) CHECK(F.norm() == 0.0);
      // 1e-12 m is 2e-10 of the depth over which the damping grows.
      if (depth == 1e-12) CHECK(F.norm() <= 1e-8 * 2.8e6 * std::abs(rate) + 1e-2);
      CHECK(c.channels(s)[3] == Approx(std::max(0.0, rate)).margin(1e-12));
    }
  }
}

TEST_CASE("friction holds a load up to the cone and then lets it slip against the motion") {
  const double depth = kWeight / 2e8;
  Scene s = on_deck(depth, {0.0, 0.0, 0.4});
  Started c(deck(), s);
  const Vector3 along = s.body[1].R_WB * Vector3(0.6, 0.8, 0.0);

  Scene pushed = s;
  pushed.body[0].p_WC += 0.001 * along;  // 1 mm against k_t = k
  const Vector3 held = c.force_on_box(pushed);
  CHECK(held.dot(along) == Approx(-0.001 * 2e8).epsilon(1e-9));
  CHECK(held.z() == Approx(kWeight).epsilon(1e-9));

  Scene sliding = s;
  sliding.body[0].p_WC += 0.1 * along;
  sliding.body[0].v_WC = 0.5 * along;
  CHECK(c.force_on_box(sliding).dot(along) == Approx(-0.3 * kWeight).epsilon(1e-9));
  // It stays where it slid to: the spring is left with what the cone allows, and pushing back first unloads it.
  c.contact.end_step(sliding.instant(), 0.05, c.memory());
  CHECK(c.contact.dissipated_power(sliding.instant(), c.memory()) > 0.0);
  sliding.body[0].v_WC.setZero();
  CHECK(c.force_on_box(sliding).dot(along) == Approx(-0.3 * kWeight).epsilon(1e-9));
  sliding.body[0].p_WC -= 0.3 * depth * along;
  CHECK(std::abs(c.force_on_box(sliding).dot(along)) < 1e-6 * kWeight);
}

TEST_CASE("work done against friction is heat and what the springs hold") {
  const double depth = kWeight / 2e8, h = 1e-4;
  Scene s = on_deck(depth, {0.02, 0.03, 0.4});
  const Matrix3 R = s.body[1].R_WB;
  const Vector3 origin = s.body[0].p_WC;
  Started c(deck(), s);
  const double before = c.contact.potential_energy(s.instant(), c.memory());
  double work = 0.0, heat = 0.0, power_before = 0.0, heat_before = 0.0;
  for (int i = 1; i <= 40000; ++i) {  // a circle of 0.3 m in four seconds, there and back on another radius
    const double t = i * h, w = 2.0 * M_PI / 4.0;
    s.body[0].p_WC = origin + R * Vector3(0.3 * std::sin(w * t), 0.2 * (1.0 - std::cos(w * t)), 0.0);
    s.body[0].v_WC = R * Vector3(0.3 * w * std::cos(w * t), 0.2 * w * std::sin(w * t), 0.0);
    const double power = -c.force_on_box(s).dot(s.body[0].v_WC);
    c.contact.end_step(s.instant(), h, c.memory());
    const double heating = c.contact.dissipated_power(s.instant(), c.memory());
    REQUIRE(heating >= 0.0);
    if (i > 1) {
      work += 0.5 * h * (power + power_before);
      heat += 0.5 * h * (heating + heat_before);
    }
    power_before = power;
    heat_before = heating;
  }
  const double stored = c.contact.potential_energy(s.instant(), c.memory()) - before;
  CHECK(work > 0.3 * kWeight * 0.9 * 1.5);  // about cone times way
  // First order in h: slip of a step against velocity at its end, and the first step from rest at full speed.
  CHECK(heat + stored == Approx(work).epsilon(1e-3));
}

TEST_CASE("beside the rectangle nothing touches, and the gap is the distance to its edge") {
  Scene s = on_deck(0.02);
  s.body[0].p_WC += Vector3(12.0 + 5.0 + 3.0, 0.0, 0.02 - 4.0);  // 3 m off the side, 4 m below the deck
  Started c(deck(), s);
  CHECK(c.force_on_box(s).norm() == 0.0);
  CHECK(c.channels(s)[0] == 0.0);
  CHECK(c.channels(s)[1] == 0.0);
  CHECK(c.channels(s)[2] == Approx(5.0).epsilon(1e-12));

  Scene half = on_deck(0.02);
  half.body[0].p_WC.x() += 10.0;  // two of four points over the edge
  CHECK(c.force_on_box(half).z() == Approx(0.5 * 0.02 * 2e8).epsilon(1e-9));
}

TEST_CASE("a contact begins to act with its phase") {
  ContactOptions o = deck();
  o.active_from_phase = 2;
  const Scene s = on_deck(0.02);
  Started c(o, s);
  Instant now = s.instant();
  for (const int phase : {0, 1, 2, 3}) {
    now.phase = phase;
    ForceSum sum(2);
    c.contact.add_forces(now, 0.05, c.memory(), sum);
    CHECK((sum.value().norm() > 0.0) == (phase >= 2));
  }
}

TEST_CASE("a contact that cannot be is refused") {
  const auto refused = [](auto change) {
    ContactOptions o = deck();
    change(o);
    CHECK_THROWS_AS(Contact(o), SpecificationError);
  };
  refused([](auto& o) { o.points.clear(); });
  refused([](auto& o) { o.surface.body = o.body; });
  refused([](auto& o) { o.length = 0.0; });
  refused([](auto& o) { o.stiffness = -1.0; });
  refused([](auto& o) { o.damping = -1.0; });
  refused([](auto& o) { o.damping_depth = 0.0; });
  refused([](auto& o) { o.friction = std::nan(""); });
}
