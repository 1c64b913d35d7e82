// The lifting gear in every regime of its laws, through the generic suite.
#include "tests/sim/force_element_suite.h"

#include "sim/lifting/ballast.h"
#include "sim/lifting/contact.h"
#include "sim/lifting/mooring.h"
#include "sim/lifting/restoring.h"
#include "sim/lifting/tagline.h"
#include "sim/lifting/wire.h"

using namespace stillhook;
using suite::ElementCase;
using suite::Scene;

namespace {

const BodyPoint kOnFirst{0, {1.2, -0.7, 2.1}}, kOnSecond{1, {-0.4, 1.9, -1.1}}, kOnThird{2, {0.8, 0.3, 1.7}};
const BodyPoint kOnWorld{kWorld, {3.0, -14.0, 22.0}};

double distance(const BodyPoint& a, const BodyPoint& b, const Instant& now) {
  return (motion_of(a, now).p - motion_of(b, now).p).norm();
}

// A wire whose ends stand `strain` beyond its unstretched length.
ElementCase wire_case(const std::string& name, const BodyPoint& a, const BodyPoint& b, double strain) {
  ElementCase c;
  c.name = name;
  c.bodies = 2;
  c.drives = 1;
  c.between_bodies = b.body != kWorld;
  c.loaded = strain > 0.0;
  c.make = [=](const Instant& now) {
    WireOptions o;
    o.name = "wire";
    o.from = a;
    o.to = b;
    o.axial_stiffness = 3.0e6;
    o.unstretched_length = distance(a, b, now) / (1.0 + strain) + now.drive[0].position;
    o.damping = 2.0e3;
    o.damping_strain = 0.01;
    o.drive = 0;
    o.crane = 0;
    return std::make_unique<Wire>(o);
  };
  c.drive_power = [](const ForceElement& e, const Instant& now, Memory m) {
    const Wire& wire = static_cast<const Wire&>(e);
    return (wire.tension(now) + e.potential_energy(now, m) / wire.unstretched_length(now)) * now.drive[0].rate;
  };
  return c;
}

Scene accepted(std::mt19937& random, int bodies, int drives, const std::function<bool(const Instant&)>& wanted) {
  for (;;) {
    Scene s = suite::general_scene(random, bodies, drives);
    if (wanted(s.instant())) return s;
  }
}

// A tagline from body 0 to body 2, hoist wire from body 1 to body 2. `side` of the set point the angle lies on (rad),
// sign of its rate, and the speed limit decide the regime.
ElementCase tagline_case_of(const std::string& name, double side, double rate_sign, double h, double speed_max,
                            double tension_max = 1e7, bool scheduled = false) {
  const BodyPoint upper = kOnSecond, lower = kOnThird, from = kOnFirst, to{2, {-1.5, 0.6, -0.9}};
  const auto angle_at = [=](const Instant& now) {
    TaglineOptions o;
    o.name = "probe";
    o.from = from, o.to = to, o.hoist_upper = upper, o.hoist_lower = lower;
    o.tension_max = 1.0;
    return Tagline(o, now).angle().value(now);
  };
  ElementCase c;
  c.name = name;
  c.bodies = 3;
  c.time_step = h;
  c.report_states = 2;  // whether and how fast the brake slips
  c.scene = [=](std::mt19937& random) {
    return accepted(random, 3, 0, [&](const Instant& now) {
      const Vector3 r = motion_of(to, now).p - motion_of(from, now).p;
      if (r.head<2>().norm() < 0.3 * r.norm() || r.norm() < 2.0) return false;
      // A winch at its limit lets the line go slack where the ends approach.
      if (speed_max > 0.0 && r.dot(motion_of(to, now).v - motion_of(from, now).v) < 0.1 * r.norm()) return false;
      const PlaneAngle::Value a = angle_at(now);
      return a.rate * rate_sign > 0.03 && std::abs(a.angle) < 2.5;
    });
  };
  c.make = [=](const Instant& now) {
    TaglineOptions o;
    o.name = "tagline";
    o.from = from, o.to = to, o.hoist_upper = upper, o.hoist_lower = lower;
    o.kp = 1.2e6;
    o.kd = 6.0e6;
    o.set_point = angle_at(now).angle - side;
    o.pretension = 20e3;
    o.tension_max = tension_max;
    o.speed_max = speed_max;
    o.time_constant = 0.5;
    if (scheduled) {
      const double fall = (motion_of(upper, now).p - motion_of(lower, now).p).norm();
      o.schedule = {{0.6 * fall, 0.5, 1.6}, {0.9 * fall, 0.8, 1.2}, {1.3 * fall, 1.4, 0.7}};
    }
    return std::make_unique<Tagline>(o, now);
  };
  return c;
}

ElementCase mooring_case(const std::string& name, MooringOptions o, const Vector3& shift, bool loaded = true) {
  ElementCase c;
  c.name = name;
  c.bodies = 2;
  c.drives = 1;
  c.between_bodies = false;
  c.loaded = loaded;
  o.name = "line";
  o.fairlead = kOnFirst;
  o.tow_drive = 0;
  o.tow_direction = Vector3(0.6, 0.64, 0.48);
  c.make = [=](const Instant& now) {
    // Laid for a pose that lies `shift` from the one it is tested in.
    Scene laid{now.t, {now.body.begin(), now.body.end()}, {now.drive.begin(), now.drive.end()}};
    laid.body[0].p_WC -= shift;
    return std::make_unique<Mooring>(o, laid.instant());
  };
  c.drive_power = [o](const ForceElement& e, const Instant& now, Memory m) {
    ForceSum sum(2);
    e.add_forces(now, 0.0, m, sum);
    return sum.value().head<3>().dot(now.drive[0].rate * o.tow_direction);
  };
  return c;
}

MooringOptions catenary_options(double friction = 0.0) {
  MooringOptions o;
  o.azimuth = 0.7;
  o.pretension = 150e3;
  o.line = {.length = 220.0, .weight = 900.0, .axial_stiffness = 2.0e8, .seabed_friction = friction};
  o.depth = 40.0;
  return o;
}

MooringOptions linear_options() {
  MooringOptions o;
  o.type = MooringOptions::Type::linear;
  o.azimuth = -2.2;
  o.pretension = 150e3;
  o.stiffness = 1.0e5;
  o.anchor_distance = 60.0;
  return o;
}

// A line that is 1 % longer than the way from its anchor, 60 m under the water and far above the bottom.
ElementCase anchored_case(const std::string& name, double weight) {
  MooringOptions o;
  o.anchor = Vector3(40.0, 30.0, -60.0);
  o.line = {.length = 1.0, .weight = weight, .axial_stiffness = 2.0e6};
  o.depth = 400.0;
  ElementCase c = mooring_case(name, o, Vector3::Zero());
  c.make = [o](const Instant& now) {
    MooringOptions laid = o;
    laid.name = "line";
    laid.fairlead = kOnFirst;
    laid.tow_drive = 0;
    laid.tow_direction = Vector3(0.6, 0.64, 0.48);
    laid.line.length = 1.01 * (motion_of(kOnFirst, now).p - *o.anchor).norm();
    return std::make_unique<Mooring>(laid, now);
  };
  return c;
}

// Turned from rest by so many radians, and moved; both matrices full.
ElementCase restoring_case(const std::string& name, double turn) {
  ElementCase c;
  c.name = name;
  c.between_bodies = false;
  c.make = [=](const Instant& now) {
    RestoringOptions o;
    o.name = "restoring";
    o.point = kOnFirst;
    o.rest_point = motion_of(kOnFirst, now).p - Vector3(0.7, -1.2, 0.4);
    o.rest_R_WB = now.body[0].R_WB * exp_rotation(-turn * Vector3(0.6, -0.64, 0.48));
    o.axes = rotation_from({0.0, 0.0, 0.8});
    const auto full = [](double size) {
      Matrix6 root;
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) root(i, j) = std::sin(1.0 + 2.3 * i + 0.7 * j * j) + (i == j ? 2.0 : 0.0);
      return Matrix6(size * root * root.transpose());
    };
    o.stiffness = full(1e5);
    o.damping = full(3e4);
    o.force_at_rest = Vector3(2e4, -1e4, 3e5);
    return std::make_unique<Restoring>(o);
  };
  return c;
}

// Two points of body 0 pressed `depth` and a little more into a rectangle on `surface`, a third one beside it.
// A step of 0.05 s moves the points by decimetres from where they stuck: only a large friction holds them.
ElementCase contact_case(const std::string& name, int surface, double depth, double friction, double h) {
  ElementCase c;
  c.name = name;
  c.bodies = 2;
  c.between_bodies = surface != kWorld;
  c.time_step = h;
  c.energy_time = 1e-6;  // within it no point moves to the edge of its friction cone
  c.make = [=](const Instant& now) {
    ContactOptions o;
    o.name = "contact";
    o.body = 0;
    o.surface = {surface, {0.4, -0.3, 0.9}};
    o.length = 8.0;
    o.breadth = 5.0;
    o.stiffness = 2.0e6;
    o.damping = 3.0e2;  // small enough that no pose separates faster than the spring pushes
    o.damping_depth = 0.01;
    o.friction = friction;
    const Pose X_WS = surface == kWorld ? Pose{} : Pose{now.body[surface].R_WB, now.body[surface].p_WC};
    const Pose X_WA{now.body[0].R_WB, now.body[0].p_WC};
    const Vector3 places[] = {{2.0, 1.1, -depth}, {-1.5, 0.7, -1.3 * depth}, {4.6, 0.2, -depth}};
    for (const Vector3& place : places) o.points.push_back(X_WA.inverse() * (X_WS * (o.surface.c_B + place)));
    return std::make_unique<Contact>(o);
  };
  return c;
}

}  // namespace

TEST_CASE("wires pass the suite of force elements") {
  suite::check_force_element(wire_case("taut", kOnFirst, kOnSecond, 0.05));
  suite::check_force_element(wire_case("damper growing", kOnFirst, kOnSecond, 0.006));
  suite::check_force_element(wire_case("slack", kOnFirst, kOnSecond, -0.05));
  suite::check_force_element(wire_case("to the world", kOnSecond, kOnWorld, 0.05));
}

TEST_CASE("taglines pass the suite of force elements") {
  suite::check_force_element(tagline_case_of("statics", 0.1, 1.0, 0.0, 0.0));
  suite::check_force_element(tagline_case_of("case A", 0.1, 1.0, 0.05, 0.0));
  suite::check_force_element(tagline_case_of("case B", -0.1, 1.0, 0.05, 0.0));
  suite::check_force_element(tagline_case_of("case C", 0.1, -1.0, 0.05, 0.0));
  suite::check_force_element(tagline_case_of("statics, gains by fall", 0.1, 1.0, 0.0, 0.0, 1e7, true));
  suite::check_force_element(tagline_case_of("case A, gains by fall", 0.1, 1.0, 0.05, 0.0, 1e7, true));
  suite::check_force_element(tagline_case_of("case B, gains by fall", -0.1, 1.0, 0.05, 0.0, 1e7, true));
  ElementCase limited = tagline_case_of("tension limit", 0.1, 1.0, 0.05, 0.0, 25e3);
  limited.smooth_history = false;  // it starts at the limit
  suite::check_force_element(limited);
  suite::check_force_element(tagline_case_of("slipping brake", 0.1, 1.0, 0.05, 1e-4, 21e3));
  suite::check_force_element(tagline_case_of("speed limit", 0.1, 1.0, 0.05, 1e-4, 1e12));
}

TEST_CASE("mooring lines pass the suite of force elements") {
  suite::check_force_element(mooring_case("catenary", catenary_options(), {-1.0, 2.0, 0.5}));
  ElementCase rough = mooring_case("catenary with friction", catenary_options(1.0), {-1.0, 2.0, 0.5});
  rough.energy_account = false;  // seabed friction is not conservative
  suite::check_force_element(rough);
  MooringOptions taut = catenary_options();
  taut.pretension = 900e3;
  suite::check_force_element(mooring_case("suspended", taut, {-0.2, 0.3, 0.5}));
  suite::check_force_element(mooring_case("on the bottom", catenary_options(), {35.0, 30.0, -0.5}));
  suite::check_force_element(mooring_case("linear", linear_options(), {-1.0, 2.0, 0.5}));
  suite::check_force_element(mooring_case("linear slack", linear_options(), {-7.0, -8.0, 0.0}, false));
}

TEST_CASE("lines between an anchor above the bottom and a body pass the suite of force elements") {
  suite::check_force_element(anchored_case("hanging free", 300.0));
  suite::check_force_element(anchored_case("buoyant", -300.0));
}

TEST_CASE("springs to the world pass the suite of force elements") {
  for (const double turn : {0.0, 0.03, 0.66, 2.0})  // at rest, in the series, beyond it, far
    suite::check_force_element(restoring_case("a turn of " + std::to_string(turn), turn));
}

TEST_CASE("contacts pass the suite of force elements") {
  for (const int surface : {1, kWorld}) {
    suite::check_force_element(contact_case("sticking", surface, 0.05, 1e3, 0.05));
    suite::check_force_element(contact_case("sliding", surface, 0.05, 0.3, 0.05));
    suite::check_force_element(contact_case("statics", surface, 0.05, 0.3, 0.0));
    ElementCase damped = contact_case("damper at the cone", surface, 0.05, 3e-3, 0.0);
    // The spring reaches this small cone within 0.1 mm. Velocities keep the step of the others: over 3e-7 the rounding
    // of moments of 5e5 N m is 1e-3 N m s, as much as the tolerance of a block.
    damped.step = 3e-7;
    suite::check_force_element(damped);
    suite::check_force_element(contact_case("normal damper growing", surface, 0.004, 0.3, 0.05));
    suite::check_force_element(contact_case("without friction", surface, 0.004, 0.0, 0.05));
    ElementCase apart = contact_case("apart", surface, -0.05, 0.3, 0.05);
    apart.loaded = false;
    suite::check_force_element(apart);
  }
}

TEST_CASE("ballast passes the suite of force elements") {
  ElementCase c;
  c.name = "ballast";
  c.bodies = 2;
  c.drives = 1;
  c.between_bodies = false;
  c.make = [](const Instant&) {
    BallastOptions o;
    o.name = "shift";
    o.from = {1, {20.0, 1.0, -2.0}};
    o.to = {1, {-25.0, -2.0, 1.0}};
    o.mass = 1.3e6;
    o.drive = 0;
    return std::make_unique<Ballast>(o);
  };
  c.drive_power = [](const ForceElement& e, const Instant& now, Memory m) {
    return e.potential_energy(now, m) / now.drive[0].position * now.drive[0].rate;
  };
  suite::check_force_element(c);
}
