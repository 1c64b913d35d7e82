#include "tests/results/synthetic_lift.h"

#include <cmath>
#include <functional>

namespace stillhook::truth {
namespace {

using Stage = PhaseSpec::Stage;
constexpr double kInterval = 0.2;  // s

Specification build_specification() {
  Specification s;
  s.name = "synthetic";
  s.sea.active = "swell <1 m>";  // a name that would break a page if it were not escaped
  s.sea.ramp = 20.0;
  SeaStateSpec sea;
  sea.name = s.sea.active;
  sea.type = SeaStateSpec::Type::regular;
  sea.amplitude = 1.0;
  sea.frequency = SyntheticLift::kWave;
  sea.heading = 0.785;
  s.sea.states = {sea};
  for (const char* name : {"crane", "load", "barge"}) {
    BodySpec body;
    body.name = name;
    s.bodies.push_back(body);
  }
  s.bodies[0].hull.shape = HullSpec::Shape::box;
  s.bodies[0].hull.size = {110.0, 46.0, 7.5};
  s.bodies[0].hull.centre = {0.0, 0.0, -0.25};
  s.bodies[0].hydrodynamics.critical_fraction[3] = 0.04;
  for (const char* name : {"hoist", "luffing", "stay"})
    s.drives.push_back({name, DriveSpec::Kind::winch, 0.0433, 0.01});
  s.drives.push_back({"barge_tow", DriveSpec::Kind::tow, 1.0, 0.01});
  const auto wire = [&](const char* name, WireSpec::Role role, const char* winch) {
    WireSpec w;
    w.name = name;
    w.role = role;
    if (role == WireSpec::Role::hoist) w.from = "crane";
    w.winch = winch;
    w.breaking_load = 51.9e6;
    w.tension_max = 9.0e6;
    s.wires.push_back(w);
  };
  wire("hoist_port", WireSpec::Role::hoist, "hoist");
  wire("hoist_starboard", WireSpec::Role::hoist, "hoist");
  wire("luffing_port", WireSpec::Role::luffing, "luffing");
  wire("stay_port", WireSpec::Role::stay, "stay");
  for (const char* name : {"tag_port", "tag_starboard"}) {
    TaglineSpec line;
    line.name = name;
    line.kp = 1.2e6;
    line.kd = 6.0e6;
    line.tension_max = 196e3;
    line.speed_max = 0.333;
    s.taglines.push_back(line);
  }
  s.taglines[1].active = false;
  MooringSpec mooring;
  mooring.name = "bow_port";
  s.moorings = {mooring};
  ContactSpec deck;
  deck.name = "deck";
  deck.role = ContactSpec::Role::pickup;
  ContactSpec seat = deck;
  seat.name = "seat";
  seat.role = ContactSpec::Role::target;
  s.contacts = {deck, seat};
  s.operation.load = "load";
  s.operation.crane = "crane";
  s.operation.load_reference = {0.0, 0.0, -5.0};
  s.operation.target = {66.0, 0.0, 5.0};
  ClearanceSpec clearance;
  clearance.name = "load_bow";
  clearance.a = {"load", {-5.0, -20.0, -5.0}, {5.0, 20.0, 5.0}, 0.0};
  clearance.b = {"world", {55.0, -23.0, -4.0}, {-55.0, 23.0, 40.0}, 0.0};
  s.clearances = {clearance};
  return s;
}

struct Step {
  const char* name;
  Stage stage;
  double start, end;
  const char* drive;
  double travel;
};

const std::vector<Step> kSteps = {{"settle", Stage::on_barge, 0, 60, "", 0},
                                  {"load_transfer", Stage::transfer, 60, 120, "hoist", 1.92},
                                  {"hoist_up", Stage::hanging, 120, 420, "hoist", 14.0},
                                  {"turn", Stage::hanging, 420, 720, "stay", 4.3},
                                  {"lower", Stage::set_down, 720, 900, "hoist", -14.5},
                                  {"hold", Stage::landed, 900, 960, "", 0}};

/// Share of a phase's travel done, quadratic so that time and progress differ.
double share(const Step& step, double t) {
  const double u = std::min(1.0, std::max(0.0, (t - step.start) / (step.end - step.start)));
  return u * u;
}

double drive_position(const std::string& drive, double t) {
  double position = 0.0;
  for (const Step& step : kSteps)
    if (drive == step.drive) position += step.travel * share(step, t);
  return position;
}

double drive_rate(const std::string& drive, double t) {
  for (const Step& step : kSteps)
    if (drive == step.drive && t >= step.start && t < step.end)
      return step.travel * 2.0 * (t - step.start) / std::pow(step.end - step.start, 2);
  return 0.0;
}

bool waiting(double t) { return t < 90.0; }  // on the barge until lift-off at 90 s
double static_x(double t) { return 74.0 + SyntheticLift::kTurnTravel * share(kSteps[3], t); }
double static_z(double t) { return 10.0 + drive_position("hoist", t) - (t > 60.0 ? 1.92 * share(kSteps[1], t) : 0.0); }

using Signal = std::function<double(double)>;
struct Described {
  Channel channel;
  Signal at, at_rest;
};

void add_wire_signals(std::vector<Described>& d) {
  using L = SyntheticLift;
  const double dynamic[] = {L::kDynamicPort, L::kDynamicStarboard};
  int side = 0;
  for (const std::string name : {"hoist_port", "hoist_starboard"}) {
    const double amplitude = dynamic[side++];
    d.push_back({{name + ".tension", "N", "tension of " + name},
                 [=](double t) {
                   return waiting(t) || t > 880.0 ? 0.0 : L::kStatic * (1.0 + amplitude * std::sin(L::kWave * t));
                 },
                 [](double t) { return t < 100.0 || t > 890.0 ? 0.0 : L::kStatic; }});
    // The static offset moves with the turn, so a swing measured without it would be wrong.
    const auto offset = [](double t) { return 0.3 + 0.5 * share(kSteps[3], t); };
    d.push_back({{name + ".offset_x", "m", "fore-aft offset"},
                 [=](double t) { return offset(t) + (waiting(t) ? 0.0 : L::kSwayX * std::sin(L::kSwing * t)); },
                 offset});
    d.push_back({{name + ".offset_y", "m", "athwart offset"},
                 [](double t) { return waiting(t) ? 0.0 : L::kSwayY * std::cos(L::kSwing * t); },
                 [](double) { return 0.0; }});
    d.push_back({{name + ".off_lead", "rad", "off-lead"},
                 [](double t) { return waiting(t) ? 0.2 : 0.03 * std::sin(L::kSwing * t); },
                 [](double) { return 0.0; }});
    d.push_back({{name + ".side_lead", "rad", "side-lead"},
                 [](double t) { return 0.01 * std::cos(L::kSwing * t); },
                 [](double) { return 0.0; }});
    d.push_back({{name + ".length", "m", "distance of the ends"},
                 [](double t) {
                   return 93.57 - (t > 60 ? drive_position("hoist", t) : 0.0) +
                          (waiting(t) ? L::kRelative * std::sin(L::kWave * t) : 0.0);
                 },
                 [](double t) { return 93.57 - drive_position("hoist", t); }});
    d.push_back({{name + ".unstretched", "m", "unstretched length"},
                 [](double t) { return 93.5 - drive_position("hoist", t); },
                 [](double t) { return 93.5 - drive_position("hoist", t); }});
  }
  d.push_back({{"luffing_port.tension", "N", "tension"},
               [](double t) { return 5.0e6 + 2.0e5 * std::sin(L::kWave * t); },
               [](double) { return 5.0e6; }});
  d.push_back({{"stay_port.tension", "N", "tension"},
               [](double t) { return 4.0e6 + 1.0e5 * std::sin(L::kWave * t); },
               [](double) { return 4.0e6; }});
}

std::vector<Described> signals() {
  using L = SyntheticLift;
  std::vector<Described> d;
  const auto zero = [](double) { return 0.0; };
  d.push_back(
      {{"load.x", "m", "position of the origin of load"},
       [](double t) { return static_x(t) + (waiting(t) || t > 880 ? 0.0 : L::kSwayX * std::sin(L::kSwing * t)); },
       static_x});
  d.push_back({{"load.y", "m", ""},
               [](double t) { return waiting(t) || t > 880 ? 0.0 : L::kSwayY * std::cos(L::kSwing * t); },
               zero});
  d.push_back({{"load.z", "m", ""},
               [](double t) { return static_z(t) + (t > 720 && t < 880 ? 0.25 * std::sin(L::kWave * t) : 0.0); },
               static_z});
  d.push_back({{"load.roll", "rad", ""}, [](double t) { return 0.02 * std::sin(L::kSwing * t); }, zero});
  d.push_back({{"load.pitch", "rad", ""}, [](double t) { return 0.015 * std::cos(L::kSwing * t); }, zero});
  d.push_back({{"load.yaw", "rad", ""}, [](double t) { return 0.04 * std::sin(L::kSwing * t); }, zero});
  const auto trim = [](double t) { return waiting(t) ? 0.0 : L::kTrim; };
  const auto static_trim = [](double t) { return t < 100.0 || t > 890.0 ? 0.0 : L::kTrim; };
  d.push_back({{"crane.x", "m", ""}, zero, zero});
  d.push_back({{"crane.y", "m", ""}, zero, zero});
  d.push_back({{"crane.z", "m", ""},
               [](double t) { return 0.5 * std::sin(L::kWave * t); },
               [](double t) { return t < 100 ? 0.0 : -0.193; }});
  d.push_back({{"crane.roll", "rad", ""}, [](double t) { return L::kRoll * std::sin(L::kWave * t); }, zero});
  d.push_back({{"crane.pitch", "rad", ""},
               [=](double t) { return trim(t) + L::kPitch * std::sin(L::kWave * t); },
               static_trim});
  d.push_back({{"crane.yaw", "rad", ""}, zero, zero});
  add_wire_signals(d);
  for (const std::string name : {"tag_port", "tag_starboard"}) {
    d.push_back({{name + ".tension", "N", ""}, [](double t) { return 1.0e5 * (1.0 + std::sin(L::kSwing * t)); }, zero});
    d.push_back({{name + ".line_speed", "m/s", ""}, [](double t) { return -0.3 * std::sin(L::kSwing * t); }, zero});
    // Saturated during one quarter of every period.
    d.push_back({{name + ".saturated", "1", ""}, [](double t) { return std::fmod(t, 20.0) < 5.0 ? 1.0 : 0.0; }, zero});
  }
  d.push_back({{"bow_port.tension", "N", ""},
               [](double t) { return 3.0e5 + 5.0e4 * std::sin(L::kSwing * t); },
               [](double) { return 3.0e5; }});
  d.push_back({{"deck.force", "N", ""},
               [](double t) { return waiting(t) ? 9.8e6 * (1.0 - std::max(0.0, t - 60.0) / 30.0) : 0.0; },
               [](double t) { return t < 100.0 ? 9.8e6 : 0.0; }});
  d.push_back({{"seat.force", "N", ""},
               [](double t) { return t > 880.0 ? 9.8e6 : 0.0; },
               [](double t) { return t > 890.0 ? 9.8e6 : 0.0; }});
  for (const std::string name : {"hoist", "luffing", "stay", "barge_tow"}) {
    d.push_back({{name + ".position", "m", ""},
                 [=](double t) { return drive_position(name, t); },
                 [=](double t) { return drive_position(name, t); }});
    d.push_back({{name + ".rate", "m/s", ""}, [=](double t) { return drive_rate(name, t); }, zero});
  }
  return d;
}

/// Extremes over a grid ten times finer than the samples, as a run sees more steps than it records.
Extreme extreme_of(const Signal& signal, double from, double to) {
  Extreme e{signal(from), signal(from), from, from};
  const long n = std::lround(10.0 * (to - from) / kInterval);
  for (long i = 0; i <= n; ++i) {
    const double t = from + (to - from) * static_cast<double>(i) / static_cast<double>(n), v = signal(t);
    if (v < e.min) e.min = v, e.t_min = t;
    if (v > e.max) e.max = v, e.t_max = t;
  }
  return e;
}

std::vector<ContactEvent> contacts() {
  const auto event = [](const char* name, ContactSpec::Role role, double start, double end, double speed, double force,
                        double impulse, const char* phase) {
    return ContactEvent{name, role, start, end, Vector3(74.0, 0.0, 2.88), speed, force, impulse, phase};
  };
  using Role = ContactSpec::Role;
  return {event("deck", Role::pickup, 0.0, 40.0, 0.0, 9.8e6, 4.0e8, "settle"),           // rests
          event("deck", Role::pickup, 40.5, 90.0, 0.05, 9.9e6, 4.0e8, "settle"),         // one hop before the transfer
          event("deck", Role::pickup, 95.0, 95.6, 0.21, 3.0e6, 9.0e5, "load_transfer"),  // re-hits
          event("deck", Role::pickup, 104.0, 104.4, 0.34, 4.0e6, 8.0e5, "load_transfer"),
          event("deck", Role::pickup, 131.0, 131.3, 0.12, 1.0e6, 1.5e5, "hoist_up"),
          event("seat", Role::target, 874.0, 875.0, 0.17, 2.0e6, 1.1e6, "lower"),  // touches, leaves, lands
          event("seat", Role::target, 880.0, 960.0, 0.09, 9.9e6, 7.8e8, "lower")};
}

}  // namespace

SyntheticLift::SyntheticLift(bool record_samples) : specification(build_specification()) {
  const std::vector<Described> described = signals();
  Trajectory& run = trajectory;
  run.status = RunStatus::completed;
  run.steps = 19200;
  run.wall = 1.5;
  for (const Described& d : described) run.channels.push_back(d.channel);
  run.values.resize(described.size());
  for (long i = 0; record_samples && i <= 4800; ++i) {
    run.time.push_back(kInterval * static_cast<double>(i));
    for (std::size_t c = 0; c < described.size(); ++c) run.values[c].push_back(described[c].at(run.time.back()));
  }
  const auto pose = [&](const std::string& name, double t) {
    StaticPose p;
    p.name = name;
    for (const DriveSpec& drive : specification.drives) p.drives.push_back(drive_position(drive.name, t));
    for (const Described& d : described) p.values[d.channel.name] = d.at_rest(t);
    p.bodies = {Pose{rotation_from({0.0, p.values["crane.pitch"], 0.0}), {0.0, 0.0, p.values["crane.z"]}},
                Pose{Matrix3::Identity(), {static_x(t), 0.0, static_z(t)}}, Pose{}};
    return p;
  };
  run.static_poses.push_back(pose("start", 0.0));
  for (const Step& step : kSteps) {
    PhaseSpec phase;
    phase.name = step.name;
    phase.stage = step.stage;
    phase.duration = step.end - step.start;
    if (*step.drive) {
      MoveSpec move;
      move.drive = step.drive;
      move.speed = 2.0 * std::abs(step.travel) / phase.duration;
      phase.moves = {move};
    }
    if (phase.name == "turn") phase.wait_for = {EventSpec::Type::clear_of_contact, "deck", 20.0, 600.0};
    specification.operation.phases.push_back(phase);
    run.phases.push_back({step.name, step.stage, step.start, step.end, false});
    run.extremes.emplace_back();
    for (const Described& d : described) run.extremes.back().push_back(extreme_of(d.at, step.start, step.end));
    run.static_poses.push_back(pose(step.name, step.end));
  }
  run.contacts = contacts();
  limits = {{"daf_max", 1.10, {}, "0027/ND Table 5-1, inshore"},
            {"offlead_max", 3.0, {}, "assumed; the crane maker's value replaces it"},
            {"sidelead_max", 3.0, {}, "assumed"},
            {"rehits", 0.0, {}, "assumed"},
            {"heel_max", 5.0, {}, "LR lifting appliances"},
            {"setdown_offset", 1.5, {}, "0027/ND 17.2.1"},
            {"clearance_min.load_bow", {}, 3.0, "0027/ND 16.2.1"},
            {"setdown_speed", 0.30, {}, "assumed", false}};
}

}  // namespace stillhook::truth
