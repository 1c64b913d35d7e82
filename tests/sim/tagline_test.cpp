#include "sim/lifting/tagline.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

#include "sim/specification.h"
#include "tests/sim/force_element_suite.h"

using namespace stillhook;
using suite::Scene;

namespace {

constexpr double kHeading = 2.1;
const Vector3 kAhead(std::cos(kHeading), std::sin(kHeading), 0.0), kPort(-std::sin(kHeading), std::cos(kHeading), 0.0);
constexpr double kHoist = 90.0;  // m, length of the hoist wire

// Crane (0) with a general heading; the load (1) hangs `out` (m) further from the winch than plumb, `side` to port.
Scene hanging(double out, double out_rate, double side = 0.0) {
  Scene s;
  s.body.resize(2);
  s.body[0].R_WB = rotation_from({0.0, 0.0, kHeading});
  s.body[1].R_WB = rotation_from({0.1, -0.2, 0.7});
  s.body[1].p_WC = (20.0 + out) * kAhead + side * kPort + Vector3(0.0, 0.0, 10.0);
  s.body[1].v_WC = out_rate * kAhead;
  return s;
}

TaglineOptions line_options() {
  TaglineOptions o;
  o.name = "tagline";
  o.from = {0, {0.0, 0.0, 10.0}};
  o.to = {1, Vector3::Zero()};
  o.hoist_upper = {0, {20.0, 0.0, 10.0 + kHoist}};
  o.hoist_lower = {1, Vector3::Zero()};
  o.kp = 1.2e6;
  o.kd = 6.0e6;
  o.pretension = 20e3;
  o.tension_max = 1e9;
  o.time_constant = 0.5;
  return o;
}

struct Line {
  explicit Line(const TaglineOptions& o) : tagline(o, hanging(0.0, 0.0).instant()), store(tagline) {}
  Memory memory() { return store.memory(); }
  void start(const Scene& s) { tagline.start(s.instant(), memory()); }
  // One step from a to b; returns the force on the load at its end.
  Vector3 step(const Scene& a, const Scene& b, double h) {
    tagline.begin_step(a.instant(), h, memory());
    const VectorX Q = suite::forces(tagline, b, h, memory());
    tagline.end_step(b.instant(), h, memory());
    return {Q[6], Q[7], Q[8]};
  }
  double channel(const Scene& s, int i) {
    std::vector<double> out(6);
    tagline.measure(s.instant(), memory(), out);
    return out[i];
  }
  Tagline tagline;
  suite::Store store;
};

enum { kTension, kCommand, kLineSpeed, kSaturated, kAngle, kAngleRate };

}  // namespace

namespace {

/// Eq. 12-14 of Cha, Nam & Ha (2018) as printed, for a constant set point. N
double printed_law(double theta, double theta_rate, double set_point, double kp, double kd) {
  const double e = theta - set_point;
  if (theta_rate < 0.0) return 0.0;                    // case C
  return e >= 0.0 ? kp * e + kd * theta_rate           // case A
                  : kd * theta_rate;                   // case B
}

/// The load's speed away from the winch for which the hoist wire turns at `theta_rate`, `out` from plumb. m/s
double speed_for(double out, double theta_rate) { return theta_rate * (out * out + kHoist * kHoist) / kHoist; }

}  // namespace

TEST_CASE("the commanded tension is Eq. 12-14 with the set point, at every rate above the switch") {
  for (const double set_point : {0.0, 0.03, -0.02}) {
    TaglineOptions o = line_options();
    o.set_point = set_point;
    Line line(o);
    line.start(hanging(0.0, 0.0));
    for (const double out : {-4.0, -1.0, 0.0, 2.0, 2.6, 2.8, 4.0})
      // 2e-4 rad/s is where the Kp term has set in; a swing of half a degree in 20 s has 3e-3 rad/s.
      for (const double rate : {-2e-2, -2e-4, -1e-6, 2.001e-4, 3e-3, 2e-2}) {
        CAPTURE(set_point, out, rate);
        const double theta = std::atan2(out, kHoist);
        CHECK(line.channel(hanging(out, speed_for(out, rate)), kCommand) ==
              Approx(20e3 + printed_law(theta, rate, set_point, 1.2e6, 6.0e6)).epsilon(1e-9));
      }
  }
}

TEST_CASE("the Kp term sets in between standing still and 2e-4 rad/s, the Kd term does not wait") {
  TaglineOptions o = line_options();
  o.set_point = 0.01;
  Line line(o);
  line.start(hanging(0.0, 0.0));
  const double out = 4.0, e = std::atan2(out, kHoist) - 0.01;
  const auto command = [&](double rate) { return line.channel(hanging(out, speed_for(out, rate)), kCommand); };
  // x^2 (3 - 2 x) at a quarter, a half and three quarters of the switch: 10/64, 1/2, 54/64.
  for (const auto& [share, sets_in] : std::vector<std::array<double, 2>>{
           {0.0, 0.0}, {0.25, 0.15625}, {0.5, 0.5}, {0.75, 0.84375}, {1.0, 1.0}, {2.0, 1.0}}) {
    CAPTURE(share);
    const double rate = share * 2e-4;
    // A rate of 1e-4 rad/s comes out of a speed of 1e-2 m/s with rounding of 1e-16 / 1e-4.
    CHECK(command(rate) == Approx(20e3 + sets_in * 1.2e6 * e + 6.0e6 * rate).epsilon(1e-9));
  }
  CHECK(command(-1e-4) == Approx(20e3).epsilon(1e-12));
}

TEST_CASE("at rest the tagline holds against what exceeds its set point") {
  TaglineOptions o = line_options();
  o.set_point = 0.02;
  Line line(o);
  for (const double out : {-3.0, 1.0, 4.0}) {
    CAPTURE(out);
    line.start(hanging(out, 0.0));
    const double e = std::max(0.0, std::atan2(out, kHoist) - 0.02);
    CHECK(line.channel(hanging(out, 0.0), kTension) == Approx(20e3 + 1.2e6 * e).epsilon(1e-9));
  }
}

TEST_CASE("the command follows the sign convention: away from the winch is positive") {
  Line line(line_options());
  const auto command = [&](double out, double rate) { return line.channel(hanging(out, rate), kCommand); };
  line.start(hanging(0.0, 0.0));
  const double out = 4.0, rate = 1.3, theta = std::atan2(out, kHoist);
  const double theta_rate = rate * kHoist / (out * out + kHoist * kHoist);
  CHECK(line.channel(hanging(out, rate), kAngle) == Approx(theta).epsilon(1e-12));
  CHECK(line.channel(hanging(out, rate), kAngleRate) == Approx(theta_rate).epsilon(1e-12));
  CHECK(line.channel(hanging(-out, rate), kAngle) == Approx(-theta).epsilon(1e-12));
  CHECK(command(out, rate) == Approx(20e3 + 1.2e6 * theta + 6e6 * theta_rate).epsilon(1e-12));  // A
  CHECK(command(-out, rate) == Approx(20e3 + 6e6 * theta_rate).epsilon(1e-12));                 // B
  CHECK(command(out, -rate) == Approx(20e3).epsilon(1e-12));                                    // C
  CHECK(command(-out, -rate) == Approx(20e3).epsilon(1e-12));                                   // C
}

TEST_CASE("scheduled gains are linear in the fall's length between their points and constant outside") {
  TaglineOptions o = line_options();
  o.schedule = {{80.0, 0.5, 2.0}, {100.0, 1.5, 1.0}};
  Line line(o);
  const double out = 4.0, rate = 1.3;
  // Raised by `up`, the load hangs on a fall that is so much shorter, or longer for a negative one.
  const auto at = [&](double up) {
    Scene s = hanging(out, rate);
    s.body[1].p_WC.z() += up;
    return s;
  };
  line.start(hanging(0.0, 0.0));
  for (const auto& [up, kp_factor, kd_factor] :
       std::vector<std::array<double, 3>>{{20.0, 0.5, 2.0}, {-25.0, 1.5, 1.0}}) {
    const double plumb = kHoist - up, theta = std::atan2(out, plumb);
    const double theta_rate = rate * plumb / (out * out + plumb * plumb);
    CHECK(line.channel(at(up), kCommand) ==
          Approx(20e3 + kp_factor * 1.2e6 * theta + kd_factor * 6e6 * theta_rate).epsilon(1e-12));
  }
  const double fall = std::hypot(out, kHoist), share = (fall - 80.0) / 20.0;
  const Tagline::Gains gains = line.tagline.gains(at(0.0).instant());
  CHECK(gains.kp == Approx(1.2e6 * (0.5 + share)).epsilon(1e-12));
  CHECK(gains.kd == Approx(6e6 * (2.0 - share)).epsilon(1e-12));
  CHECK(gains.kp_by_fall == Approx(1.2e6 / 20.0).epsilon(1e-12));
  o.schedule = {{100.0, 0.5, 2.0}, {80.0, 1.5, 1.0}};
  CHECK_THROWS_WITH(Line(o), Catch::Matchers::Contains("rising order"));
}

TEST_CASE("the force draws the load towards the winch") {
  Line line(line_options());
  const Scene s = hanging(4.0, 0.0);
  line.start(s);
  ForceSum sum(2);
  line.tagline.add_forces(s.instant(), 0.0, line.memory(), sum);
  const double steady = 20e3 + 1.2e6 * std::atan2(4.0, kHoist);
  CHECK((sum.value().segment<3>(6) + steady * kAhead).norm() < 1e-9 * steady);
  CHECK((sum.value().head<3>() - steady * kAhead).norm() < 1e-9 * steady);
  CHECK(line.channel(s, kTension) == Approx(steady).epsilon(1e-9));
}

TEST_CASE("the plane stays when the line stands steep, and turns with the vessel") {
  Line line(line_options());
  line.start(hanging(0.0, 0.0));
  // The load passes over the winch: the horizontal direction of the line flips, the angle does not.
  const double before = line.channel(hanging(-19.9, 0.5, 0.3), kAngle);
  const double after = line.channel(hanging(-20.1, 0.5, 0.3), kAngle);
  CHECK(before == Approx(std::atan2(-19.9, kHoist)).epsilon(1e-12));
  CHECK(after == Approx(std::atan2(-20.1, kHoist)).epsilon(1e-12));
  // Sway at right angles to the plane is not seen.
  CHECK(line.channel(hanging(4.0, 0.5, 6.0), kAngle) == Approx(std::atan2(4.0, kHoist)).epsilon(1e-12));
  // A yaw of everything changes nothing.
  Scene turned = hanging(4.0, 0.7, 2.0);
  const Matrix3 yaw = rotation_from({0.0, 0.0, -1.3});
  const double rate = line.channel(turned, kAngleRate);
  for (BodyKinematics& b : turned.body) {
    b.R_WB = yaw * b.R_WB;
    b.p_WC = yaw * b.p_WC;
    b.v_WC = yaw * b.v_WC;
  }
  CHECK(line.channel(turned, kAngle) == Approx(std::atan2(4.0, kHoist)).epsilon(1e-12));
  CHECK(line.channel(turned, kAngleRate) == Approx(rate).epsilon(1e-12));
}

TEST_CASE("within its limits the tension follows its command as a first-order lag, however the load moves") {
  TaglineOptions o = line_options();
  o.kp = o.kd = 0.0;  // a constant command
  const auto largest_error = [&](double h) {
    Line line(o);
    const auto at = [](double t) { return hanging(3.0 * std::sin(0.4 * t), 1.2 * std::cos(0.4 * t)); };
    line.start(at(0.0));
    line.memory().state[0] -= 60e3 / line.tagline.line_stiffness();  // starts 60 kN too tight
    double worst = 0.0;
    for (int i = 0; i < std::lround(2.0 / h); ++i) {
      const double T = line.step(at(i * h), at((i + 1) * h), h).norm();
      worst = std::max(worst, std::abs(T - (20e3 + 60e3 * std::exp(-(i + 1) * h / 0.5))));
      CHECK(line.channel(at((i + 1) * h), kTension) == Approx(T).epsilon(1e-9));
      CHECK(line.channel(at((i + 1) * h), kSaturated) == 0.0);
    }
    return worst;
  };
  const double coarse = largest_error(0.1), fine = largest_error(0.05);
  CHECK(fine < 60.0);                                          // 0.1 % of the step of the tension
  CHECK(std::log2(coarse / fine) == Approx(2.0).margin(0.1));  // second order
}

TEST_CASE("at its speed limit the winch is an elastic line that runs, and the brake slips at the largest tension") {
  TaglineOptions o = line_options();
  o.kp = o.kd = 0.0;
  o.speed_max = 0.333;
  o.tension_max = 196e3;
  Line line(o);
  const double k = line.tagline.line_stiffness(), h = 0.05, speed = 1.0;
  const auto at = [&](double t) { return hanging(speed * t, speed); };
  line.start(at(0.0));
  double expected = 20e3;
  bool slipped = false;
  for (int i = 0; i < 20; ++i) {
    const double T = line.step(at(i * h), at((i + 1) * h), h).norm();
    expected = std::min(expected + k * (speed - 0.333) * h, 196e3);
    CHECK(T == Approx(expected).epsilon(1e-9));
    const Scene s = at((i + 1) * h);
    CHECK(line.channel(s, kSaturated) == 1.0);
    const double line_speed = line.channel(s, kLineSpeed);
    const double heat = line.tagline.dissipated_power(s.instant(), line.memory());
    CHECK(heat == Approx(T * (line_speed - 0.333)).margin(1e-6 * T));
    if (line_speed > 0.4) {
      slipped = true;
      CHECK(T == Approx(196e3).epsilon(1e-9));
    }
  }
  CHECK(slipped);
}

TEST_CASE("a line that the winch cannot haul in fast enough goes slack and comes back") {
  TaglineOptions o = line_options();
  o.kp = o.kd = 0.0;
  o.speed_max = 0.3;
  Line line(o);
  const double h = 0.05;
  const auto at = [&](double t) { return hanging(t < 2.0 ? -t : -2.0, t < 2.0 ? -1.0 : 0.0); };
  line.start(at(0.0));
  bool slack = false;
  double T = 0.0;
  for (int i = 0; i < 400; ++i) {
    const Vector3 F = line.step(at(i * h), at((i + 1) * h), h);
    CHECK(F.dot(kAhead) <= 0.0);  // it never pushes the load away
    T = F.norm();
    slack = slack || T == 0.0;
  }
  CHECK(slack);
  CHECK(T == Approx(20e3).epsilon(1e-3));
}

TEST_CASE("a pull-only damper halves the damping of the two-sided one, and damps") {
  // Point load on a rigid hanger, derivative gain alone: the two-sided law Q = -Kd cos(theta) L thetadot would give
  // zeta = Kd/(2 m L omega); pulling in one half of each cycle gives about half of it.
  TaglineOptions o = line_options();
  o.kp = o.pretension = 0.0;
  o.kd = 6.0e6;
  o.time_constant = 0.02;
  Line line(o);
  const double mass = 5e5, omega = std::sqrt(9.80665 / kHoist), h = 0.01;
  const auto at = [](double theta, double rate) {
    Scene s = hanging(0.0, 0.0);
    s.body[1].p_WC = kAhead * (20.0 + kHoist * std::sin(theta)) + Vector3(0, 0, 10.0 + kHoist * (1 - std::cos(theta)));
    s.body[1].v_WC = rate * kHoist * (kAhead * std::cos(theta) + Vector3(0, 0, std::sin(theta)));
    return s;
  };
  double theta = 0.05, rate = 0.0;
  line.start(at(theta, rate));
  Scene before = at(theta, rate);
  std::vector<double> maxima{theta};
  while (maxima.size() < 5) {
    // Velocity Verlet: the force of the step's end is asked at the predicted state.
    const double previous = rate;
    const Scene now = at(theta + h * rate, rate);
    const Vector3 F = line.step(before, now, h);
    theta += h * rate;
    const double lever = kHoist * (F.dot(kAhead) * std::cos(theta) + F.z() * std::sin(theta));
    rate += h * (lever / (mass * kHoist * kHoist) - omega * omega * std::sin(theta));
    before = at(theta, rate);
    if (previous > 0.0 && rate <= 0.0) maxima.push_back(theta);
  }
  const double decrement = std::log(maxima[0] / maxima[4]) / 4.0;
  const double two_sided = 6.0e6 / (2.0 * mass * kHoist * omega);
  // The first half cycle goes back without a pull; finite damping and the lag are worth a few per cent.
  CHECK(decrement / (2.0 * M_PI) == Approx(0.5 * two_sided).epsilon(0.05));
}

TEST_CASE("an inactive tagline does nothing") {
  TaglineOptions o = line_options();
  o.active = false;
  Line line(o);
  const Scene a = hanging(3.0, 1.0), b = hanging(3.05, 1.0);
  line.start(a);
  CHECK(line.step(a, b, 0.05).norm() == 0.0);
  CHECK(line.channel(b, kTension) == 0.0);
  CHECK(line.channel(b, kCommand) == 0.0);
  CHECK(line.channel(b, kSaturated) == 0.0);
  CHECK(line.channel(b, kAngle) > 0.0);
}

TEST_CASE("a tagline that cannot be is refused") {
  const auto refused = [](auto change) {
    TaglineOptions o = line_options();
    change(o);
    CHECK_THROWS_AS(Tagline(o, hanging(0.0, 0.0).instant()), SpecificationError);
  };
  refused([](auto& o) { o.kp = -1.0; });
  refused([](auto& o) { o.kd = std::nan(""); });
  refused([](auto& o) { o.pretension = -1.0; });
  refused([](auto& o) { o.tension_max = 0.0; });
  refused([](auto& o) { o.pretension = 2e9; });
  refused([](auto& o) { o.speed_max = -1.0; });
  refused([](auto& o) { o.time_constant = 0.0; });
  refused([](auto& o) { o.axial_stiffness = 0.0; });
  refused([](auto& o) { o.from = {0, {20.5, 0.0, -80.0}}; });  // nearly straight below the load
}
