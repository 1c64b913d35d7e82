// When phases begin and where drives stand in a run, against times worked out by hand: delays, moves that go on in the
// background, least durations, waits for a contact to be clear, timeouts.
#include <catch2/catch.hpp>
#include <cmath>

#include "sim/simulate.h"

using namespace stillhook;

namespace {

// Two loads side by side, each on a fall of its own from the world. "a" may stand on a deck.
Specification two_falls() {
  Specification s;
  s.name = "two_falls";
  for (const char* name : {"a", "b"}) {
    BodySpec body;
    body.name = name;
    body.mass = 1e3;
    body.inertia = 200.0 * Matrix3::Identity();
    body.position = Vector3(name[0] == 'a' ? 0.0 : 5.0, 0.0, 1.0);
    s.bodies.push_back(body);
    DriveSpec drive;
    drive.name = std::string("winch_") + name;
    s.drives.push_back(drive);
    WireSpec wire;
    wire.name = std::string("fall_") + name;
    wire.from = "world";
    wire.to = name;
    wire.point_from = Vector3(body.position.x(), 0.0, 11.0);
    wire.axial_stiffness = 2e7;
    wire.damping_ratio = 0.3;
    wire.damping_mass = 1e3;
    wire.unstretched_length = 10.0;
    wire.winch = drive.name;
    s.wires.push_back(wire);
  }
  s.operation.load = "a";
  s.solver.output_interval = 0.05;
  return s;
}

MoveSpec move_by(const std::string& drive, double travel, double speed, double ramp, double delay = 0.0) {
  MoveSpec move;
  move.drive = drive;
  move.travel = travel;
  move.speed = speed;
  move.profile.shape = ProfileSpec::Shape::trapezoid;
  move.profile.ramp = ramp;
  move.delay = delay;
  return move;
}

PhaseSpec phase(const std::string& name, double duration, std::vector<MoveSpec> moves = {}) {
  PhaseSpec p;
  p.name = name;
  p.duration = duration;
  p.moves = std::move(moves);
  return p;
}

Trajectory run_of(const Specification& s) {
  const Model model = build_model(s);
  Trajectory run = simulate(model, build_operation(model));
  REQUIRE(run.status == RunStatus::completed);
  return run;
}

/// A trapezoid of speeds from time 0 on: linear ramps, travel at full speed in between.
double travelled(double t, double travel, double speed, double ramp) {
  const double sign = travel < 0.0 ? -1.0 : 1.0, far = std::abs(travel), end = far / speed + ramp;
  if (t <= 0.0) return 0.0;
  if (t >= end) return travel;
  if (t < ramp) return sign * 0.5 * speed * t * t / ramp;
  if (t > end - ramp) return sign * (far - 0.5 * speed * (end - t) * (end - t) / ramp);
  return sign * speed * (t - 0.5 * ramp);
}

double value(const Trajectory& run, const std::string& channel, std::size_t sample) {
  const int c = run.find(channel);
  REQUIRE(c >= 0);
  return run.values[static_cast<std::size_t>(c)][sample];
}

constexpr double kToRounding = 1e-9;

}  // namespace

TEST_CASE("phases begin when the foreground moves before them are over, drives stand where their moves say") {
  Specification s = two_falls();
  MoveSpec background = move_by("winch_b", 2.0, 0.1, 2.0, 4.0);  // 22 s from 4 s on
  background.background = true;
  s.operation.phases = {phase("first", 3.0, {move_by("winch_a", 1.0, 0.1, 1.0, 0.73), background}),  // 0.73 + 11 s
                        phase("second", 5.31, {move_by("winch_a", -0.5, 0.1, 1.0)}),      // 6 s, longer than 5.31
                        phase("third", 7.25, {move_by("winch_b", -0.3, 0.1, 1.0, 0.5)}),  // 7.25 s, longer than 0.5 + 4
                        phase("last", 2.0)};
  const Trajectory run = run_of(s);
  const double starts[] = {0.0, 11.73, 17.73, 24.98, 26.98};  // none but the first is a step
  REQUIRE(run.phases.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CAPTURE(i);
    CHECK(run.phases[i].start == Approx(starts[i]).margin(kToRounding));
    CHECK(run.phases[i].end == Approx(starts[i + 1]).margin(kToRounding));
    CHECK_FALSE(run.phases[i].event_timed_out);
  }
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    const double t = run.time[i];
    CAPTURE(t);
    CHECK(value(run, "winch_a.position", i) ==
          Approx(travelled(t - 0.73, 1.0, 0.1, 1.0) + travelled(t - 11.73, -0.5, 0.1, 1.0)).margin(kToRounding));
    // The second move of b begins while the first one still runs: they add up.
    CHECK(value(run, "winch_b.position", i) ==
          Approx(travelled(t - 4.0, 2.0, 0.1, 2.0) + travelled(t - 18.23, -0.3, 0.1, 1.0)).margin(kToRounding));
  }
  // Each sample belongs to the phase that has begun by then.
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    int due = 0;
    for (int p = 1; p < 4; ++p) due += run.time[i] >= starts[p] - kToRounding;
    CHECK(value(run, "phase", i) == due);
  }
  // It ends with the operation, at the next sample, and the hauled load hangs higher by what was hauled.
  CHECK(run.time.back() == Approx(27.0));
  CHECK(value(run, "a.z", run.time.size() - 1) - value(run, "a.z", 0) == Approx(0.5).margin(2e-3));
}

namespace {

// Load a stands on a deck; its fall has 0.05 m of slack, and the winch hauls `travel` m at 0.05 m/s. Then a phase that
// waits until the deck has been clear for 2.37 s, at most 4.5 s.
Specification lift_off(double travel, double least = 0.0) {
  Specification s = two_falls();
  ContactSpec deck;
  deck.name = "deck";
  deck.role = ContactSpec::Role::pickup;
  deck.body = "a";
  deck.points = {{0.5, 0.5, -0.5}, {0.5, -0.5, -0.5}, {-0.5, -0.5, -0.5}, {-0.5, 0.5, -0.5}};
  deck.surface_body = "world";
  deck.surface_centre = Vector3(0.0, 0.0, 0.5);
  deck.surface_length = deck.surface_breadth = 4.0;
  deck.stiffness = 2e6;
  deck.damping = 3e4;
  s.contacts = {deck};
  s.wires[0].unstretched_length = 0.0;
  s.wires[0].slack = 0.05;
  PhaseSpec waiting = phase("clear", 1.0);
  waiting.wait_for.type = EventSpec::Type::clear_of_contact;
  waiting.wait_for.contact = "deck";
  waiting.wait_for.hold = 2.37;
  waiting.wait_for.timeout = 4.5;
  s.operation.phases = {phase("haul", least, {move_by("winch_a", travel, 0.05, 1.0)}), waiting};
  return s;
}

/// When the load leaves the deck if everything is slow: hauled in are the slack, the way up from the deck's give and
/// the stretch of the fall under the weight.
double parting_by_hand(double L) {
  const double weight = 1e3 * 9.80665, hauled = 0.05 + weight / 2e6 + weight / (2e7 / L);
  return 0.5 + hauled / 0.05;  // 0.5 s lost to the ramp
}

// s; the fall is caught at 0.05 m/s: v sqrt(k m) of a few kN, which the winch hauls in 0.03 s; two steps besides.
constexpr double kSwing = 0.15;

}  // namespace

TEST_CASE("a phase that waits begins when the contact has been clear for its time") {
  const Trajectory run = run_of(lift_off(0.2));
  REQUIRE(run.phases.size() == 2);
  // The move is over at 5 s; clear at about 1.7 s and for 2.37 s before that: no wait is left.
  CHECK(run.phases[1].start == Approx(5.0).margin(kToRounding));
  CHECK_FALSE(run.phases[1].event_timed_out);

  const Trajectory late = run_of(lift_off(0.1));
  REQUIRE(late.phases.size() == 2);
  REQUIRE_FALSE(late.contacts.empty());
  // The move is over at 3 s: what is left of 2.37 s after the parting is waited for.
  const double parted = parting_by_hand(10.05);
  CHECK(late.phases[1].start == Approx(parted + 2.37).margin(kSwing));
  CHECK(late.phases[1].start > 3.0);
  // To a step or two: the force is gone a little before the gap opens.
  CHECK(late.phases[1].start - 2.37 == Approx(late.contacts.back().end).margin(0.1));
  CHECK(late.phases[0].end == late.phases[1].start);
  CHECK_FALSE(late.phases[1].event_timed_out);
}

TEST_CASE("half the step moves the start of a waiting phase by less than a step") {
  Specification s = lift_off(0.1);
  const double coarse = run_of(s).phases[1].start;
  s.solver.time_step = s.solver.output_interval = 0.025;
  CHECK(run_of(s).phases[1].start == Approx(coarse).margin(0.05));
}

TEST_CASE("a contact that does not become clear is waited for until the timeout, and the run says so") {
  // 0.04 m hauled of 0.05 m slack: the load stays where it stands. Two ramps of 1 s,
  // too short for full speed, and 4.5 s more.
  const Trajectory run = run_of(lift_off(0.04));
  REQUIRE(run.phases.size() == 2);
  CHECK(run.phases[1].start == Approx(6.5).margin(kToRounding));
  CHECK(run.phases[1].event_timed_out);
  CHECK_FALSE(run.phases[0].event_timed_out);
  CHECK(run.phases[1].end == Approx(7.5).margin(kToRounding));
}

TEST_CASE("a contact that never was is not waited for") {
  Specification s = lift_off(0.1);
  s.contacts[0].surface_centre.z() = -5.0;  // far below
  s.wires[0].slack = -0.005;                // it hangs
  const Trajectory run = run_of(s);
  CHECK(run.phases[1].start == Approx(3.0).margin(kToRounding));
  CHECK(run.contacts.empty());
}
