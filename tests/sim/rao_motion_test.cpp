// Vessels that move by displacement RAOs: what every convention of a file means, and what the sea then makes of it.
#include "sim/hull/rao_motion.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>
#include <sstream>

#include "sim/multibody/hht.h"
#include "sim/sea/spectrum.h"
#include "sim/simulate.h"
#include "sim/spatial/constants.h"
#include "tests/sim/lift_parts.h"
#include "tests/sim/temporary_folder.h"

using namespace stillhook;

namespace {

constexpr double kG = 9.80665;
constexpr std::array<const char*, 6> kNames = {"surge", "sway", "heave", "roll", "pitch", "yaw"};

// A vessel whose point G answers a wave with these amplitudes (m/m, rad/m) and lags (rad) behind the crest at G, in its
// own axes (x forward, y port, z up). Everything below is in the time domain; no complex numbers.
struct Truth {
  Vector3 G{1.5, 0.0, 2.0};
  std::array<double, 6> amplitude = {0.6, 0.45, 0.9, 0.031, 0.017, 0.008};
  std::array<double, 6> lag = {1.4, -1.2, 0.25, 2.0, -2.4, 0.7};

  double wave(const Vector3& at, double w, double b, double t) const {
    return std::cos(w * t - w * w / kG * (at.x() * std::cos(b) + at.y() * std::sin(b)));
  }
  /// Translation of a point and turn, in a wave of 1 m that travels towards b.
  Vector6 motion(const Vector3& point, double w, double b, double t) const {
    Vector6 q;
    for (int i = 0; i < 6; ++i) {
      const auto n = static_cast<std::size_t>(i);
      q[i] = amplitude[n] * std::cos(w * t - w * w / kG * (G.x() * std::cos(b) + G.y() * std::sin(b)) - lag[n]);
    }
    q.head<3>() += q.tail<3>().cross(point - G);
    return q;
  }
};

/// Amplitude and phase of a function of time with the frequency w: m = A cos(w t - phase).
std::pair<double, double> harmonic(const std::function<double(double)>& m, double w) {
  double c = 0.0, s = 0.0;
  constexpr int n = 24;
  for (int k = 0; k < n; ++k) {
    const double t = kTwoPi / w * k / n;
    c += 2.0 / n * m(t) * std::cos(w * t);
    s += 2.0 / n * m(t) * std::sin(w * t);
  }
  return {std::hypot(c, s), std::atan2(s, c)};
}

std::string header(const std::string& first = "period_s", const std::string& turn = "_deg_per_m") {
  std::string text = first + ",heading_deg";
  for (std::size_t i = 0; i < 6; ++i)
    text += std::string(",") + kNames[i] + (i < 3 ? "_m_per_m" : turn) + "," + kNames[i] + "_phase_deg";
  return text + "\n";
}

/// A row as its owner would have measured it, by the conventions of `spec`.
std::string row(const Truth& truth, const RaoSpec& spec, double w, double towards, bool period = true) {
  std::ostringstream text;
  text.precision(15);
  const double given = spec.direction == RaoSpec::Direction::towards ? towards : towards + std::numbers::pi;
  text << (period ? kTwoPi / w : w) << "," << (spec.turn == RaoSpec::Turn::port ? given : -given) / kDegree;
  const Vector3 origin(spec.phase_x, spec.phase_y, 0.0);
  const double crest = harmonic([&](double t) { return truth.wave(origin, w, towards, t); }, w).second;
  const double event = crest + (spec.event == RaoSpec::Event::crest    ? 0.0
                                : spec.event == RaoSpec::Event::trough ? std::numbers::pi
                                : spec.event == RaoSpec::Event::rising ? -0.5 * std::numbers::pi
                                                                       : 0.5 * std::numbers::pi);
  for (int i = 0; i < 6; ++i) {
    const double sign = spec.reversed[static_cast<std::size_t>(i)] ? -1.0 : 1.0;
    const auto [A, peak] = harmonic([&](double t) { return sign * truth.motion(spec.reference, w, towards, t)[i]; }, w);
    const double lag = peak - event, phase = spec.phase == RaoSpec::Phase::lag ? lag : -lag;
    text << "," << (i < 3 ? A : A / kDegree) << "," << std::remainder(phase, kTwoPi) / kDegree;
  }
  text << "\n";
  return text.str();
}

BodySpec vessel(const RaoSpec& rao) {
  BodySpec b;
  b.name = "vessel";
  b.mass = 2e7;
  b.cog = Vector3(4.0, 0.0, 3.0);
  b.inertia = Vector3(2e9, 3e10, 3e10).asDiagonal();
  b.position = Vector3(30.0, -12.0, 0.4);
  b.attitude = {0.0, 0.0, 0.7};
  b.hydrodynamics.kind = HydrodynamicsSpec::Kind::rao;
  b.hydrodynamics.rao = rao;
  return b;
}

std::shared_ptr<const WaveField> regular_wave(double a, double w, double towards, double ramp = 20.0) {
  SeaStateSpec s;
  s.type = SeaStateSpec::Type::regular;
  s.amplitude = a;
  s.frequency = w;
  s.heading = towards;
  return std::make_shared<const WaveField>(build_wave_field(s, kG, ramp));
}

/// A table of the truth at these frequencies, every 30 deg.
std::string table_text(const Truth& truth, const RaoSpec& spec, const std::vector<double>& frequencies) {
  std::string text = header();
  for (const double w : frequencies)
    for (int h = 0; h < 12; ++h) text += row(truth, spec, w, 30.0 * kDegree * h);
  return text;
}

const std::vector<double>& series(const Trajectory& run, const std::string& channel) {
  for (std::size_t i = 0; i < run.channels.size(); ++i)
    if (run.channels[i].name == channel) return run.values[i];
  FAIL("no channel " << channel);
  return run.values.front();
}

LiftParts vessel_alone(const RaoSpec& rao) {
  LiftParts lift;
  lift.spec.bodies.push_back(vessel(rao));
  lift.spec.solver.time_step = 0.05;
  lift.spec.solver.output_interval = 0.5;
  lift.spec.solver.max_duration = 60.0;
  return lift;
}

void regular_sea(Specification& spec, double a, double w, double towards, double ramp) {
  SeaStateSpec s;
  s.name = "swell";
  s.type = SeaStateSpec::Type::regular;
  s.amplitude = a;
  s.frequency = w;
  s.heading = towards;
  spec.sea.states = {s};
  spec.sea.active = "swell";
  spec.sea.ramp = ramp;
}

std::string refusal(const std::function<void()>& what) {
  try {
    what();
  } catch (const SpecificationError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("RAOs in any convention, of any reference point, say the same motion", "[rao]") {
  const TemporaryFolder folder;
  const Truth truth;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-40.0, 40.0), angle(0.0, kTwoPi), frequency(0.3, 1.2);
  std::bernoulli_distribution coin;
  for (int n = 0; n < 64; ++n) {
    RaoSpec spec;
    spec.phase = n & 1 ? RaoSpec::Phase::lead : RaoSpec::Phase::lag;
    spec.event = static_cast<RaoSpec::Event>((n >> 1) & 3);
    spec.direction = n & 8 ? RaoSpec::Direction::from : RaoSpec::Direction::towards;
    spec.turn = n & 16 ? RaoSpec::Turn::starboard : RaoSpec::Turn::port;
    for (bool& reversed : spec.reversed) reversed = coin(random);
    spec.reference = Vector3(place(random), 0.3 * place(random), 0.2 * place(random));
    spec.phase_x = place(random);
    spec.phase_y = place(random);
    const double w = frequency(random), b = angle(random);
    spec.file = folder.write("rao.csv", header() + row(truth, spec, w, b));
    const BodySpec body = vessel(spec);
    const RaoTable table = read_rao_table(body, kG);
    REQUIRE(table.values.size() == 1);
    const RaoFrame frame(body);
    const Raos of_reference = moved_by(table.between(w, b), frame.arm);
    for (const double t : {0.0, 1.3, 4.1}) {
      const double th = w * w / kG * (frame.q.x() * std::cos(b) + frame.q.y() * std::sin(b)) - w * t;
      const Vector6 wanted = truth.motion(spec.reference, w, b, t);
      for (int i = 0; i < 6; ++i) {
        CAPTURE(n, i, t);
        const double got = (of_reference[static_cast<std::size_t>(i)] * std::polar(1.0, th)).real();
        // The file has 15 digits of angles up to 180 deg.
        CHECK(got == Approx(wanted[i]).margin(1e-11));
      }
    }
  }
}

TEST_CASE("units of an RAO file: frequencies, angles and the slope of the wave", "[rao]") {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& first, const std::string& turn, const std::string& numbers) {
    RaoSpec spec;
    spec.file = folder.write("rao.csv", header(first, turn) + numbers);
    return read_rao_table(vessel(spec), kG);
  };
  const std::string rest = ",0,0.5,0,0,0,1,0,2,0,0,0,0,0\n";
  const double w = kTwoPi / 8.0, k = w * w / kG;
  const auto roll = [](const RaoTable& t) { return std::abs(t.values.front()[3]); };
  CHECK(read("period_s", "_deg_per_m", "8" + rest).frequencies.front() == Approx(w).epsilon(1e-14));
  CHECK(read("frequency_hz", "_deg_per_m", "0.125" + rest).frequencies.front() == Approx(w).epsilon(1e-14));
  CHECK(read("frequency_rad_per_s", "_deg_per_m", "0.5" + rest).frequencies.front() == 0.5);
  CHECK(roll(read("period_s", "_deg_per_m", "8" + rest)) == Approx(2.0 * kDegree).epsilon(1e-14));
  CHECK(roll(read("period_s", "_rad_per_m", "8,0,0.5,0,0,0,1,0,0.2,0,0,0,0,0\n")) == Approx(0.2).epsilon(1e-14));
  CHECK(roll(read("period_s", "_per_slope", "8" + rest)) == Approx(2.0 * k).epsilon(1e-14));
}

TEST_CASE("a vessel in a regular wave moves by its RAOs to the last step", "[rao]") {
  const TemporaryFolder folder;
  const Truth truth;
  RaoSpec spec;
  spec.reference = Vector3(-20.0, 3.0, 9.0);
  spec.phase_x = 10.0;
  const double w = 0.7, towards = 2.2, a = 1.2;
  const BodySpec at_rest = vessel(spec);
  const double from_bow = towards - at_rest.attitude.yaw;
  spec.file = folder.write("rao.csv", header() + row(truth, spec, w, from_bow));
  LiftParts lift = vessel_alone(spec);
  regular_sea(lift.spec, a, w, towards, 20.0);
  const Model model = build_model(lift.spec);
  const Trajectory run = simulate(model, build_operation(model), {});
  REQUIRE(run.status == RunStatus::completed);
  const Matrix3 R_WH = rotation_from(at_rest.attitude);
  const double k = w * w / kG;
  int compared = 0;
  for (std::size_t n = 0; n < run.time.size(); ++n) {
    const double t = run.time[n];
    if (t < 20.0) continue;  // the ramp is over
    ++compared;
    // The truth's clock has the crest at the vessel's own origin at 0; ours at the world's.
    const double travelled =
        k * (at_rest.position.x() * std::cos(towards) + at_rest.position.y() * std::sin(towards)) / w;
    const Vector6 q = a * truth.motion(spec.reference, w, from_bow, t - travelled);
    const RollPitchYaw angles{series(run, "vessel.roll")[n], series(run, "vessel.pitch")[n],
                              series(run, "vessel.yaw")[n]};
    CAPTURE(t);
    // Newton's method ends at 1e-7 g dt^2: 2.5e-9 m.
    CHECK(angles.roll == Approx(q[3]).margin(1e-8));
    CHECK(angles.pitch == Approx(q[4]).margin(1e-8));
    CHECK(angles.yaw == Approx(0.7 + q[5]).margin(1e-8));
    const Vector3 Bo(series(run, "vessel.x")[n], series(run, "vessel.y")[n], series(run, "vessel.z")[n]);
    const Vector3 wanted = at_rest.position + R_WH * (spec.reference + q.head<3>());
    CHECK((Bo + rotation_from(angles) * spec.reference - wanted).norm() < 1e-7);
  }
  CHECK(compared > 70);
  // At the start it lies where the case puts it.
  CHECK((pose_of(model.initial_state().body[0], model.system().bodies[0]).p - at_rest.position).norm() < 1e-10);
}

TEST_CASE("velocity and acceleration of an RAO motion are the rates of its pose", "[rao]") {
  const TemporaryFolder folder;
  const Truth truth;
  RaoSpec spec;
  spec.reference = Vector3(12.0, -4.0, 7.0);
  spec.file = folder.write("rao.csv", table_text(truth, spec, {0.4, 0.7, 1.1}));
  BodySpec body = vessel(spec);
  body.attitude = {0.08, -0.05, 2.4};  // heels and trims at rest
  std::vector<std::string> notes;
  const RaoMotion motion(body, read_rao_table(body, kG), regular_wave(2.5, 0.8, 1.1), notes);
  for (const double t : {3.0, 11.0, 19.0, 40.0}) {  // in the ramp and after it
    const double d = 1e-3;
    const FrameMotion now = motion.at(t), before = motion.at(t - d), after = motion.at(t + d);
    // d^2/6 of a third rate of about 1 m/s3.
    CHECK(((after.p - before.p) / (2.0 * d) - now.v).norm() < 1e-6);
    CHECK(((after.v - before.v) / (2.0 * d) - now.a).norm() < 1e-6);
    CHECK((log_rotation(after.R * before.R.transpose()) / (2.0 * d) - now.w).norm() < 1e-7);
    CHECK(((after.w - before.w) / (2.0 * d) - now.w_dot).norm() < 1e-7);
  }
  CHECK((motion.at(0.0).R - rotation_from(body.attitude)).norm() < 1e-14);
  CHECK((motion.at(-1.0).p - body.position).norm() < 1e-13);
}

TEST_CASE("in an irregular sea the motion has the variance of the spectrum times the RAO squared", "[rao]") {
  const TemporaryFolder folder;
  RaoSpec spec;
  std::string text = header();
  const auto heave = [](double w) { return 1.0 / (1.0 + std::pow(w / 0.7, 4)); };
  for (double w = 0.15; w < 2.6; w += 0.02) {
    std::ostringstream line;
    line << kTwoPi / w << ",0,0,0,0,0," << heave(w) << ",20,0,0,0,0,0,0\n";
    text += line.str();
  }
  spec.file = folder.write("rao.csv", text);
  BodySpec body = vessel(spec);
  body.attitude = {};
  SeaStateSpec s;
  s.type = SeaStateSpec::Type::jonswap;
  s.significant_height = 2.0;
  s.peak_period = 9.0;
  s.gamma = 2.0;
  s.components = 300;
  const auto waves = std::make_shared<const WaveField>(build_wave_field(s, kG, 10.0));
  std::vector<std::string> notes;
  const RaoMotion motion(body, read_rao_table(body, kG), waves, notes);
  double m0 = 0.0;
  for (double w = 0.2; w < 2.5; w += 0.001) m0 += 0.001 * spectral_density(s, w) * heave(w) * heave(w);
  double sum = 0.0, square = 0.0;
  constexpr int samples = 20000;
  for (int n = 0; n < samples; ++n) {
    const double z = motion.at(20.0 + 0.7 * n).p.z() - body.position.z();
    sum += z;
    square += z * z;
  }
  const double sigma = std::sqrt(square / samples - std::pow(sum / samples, 2));
  // 300 components of equal energy; nearly four hours of the sea, 1500 waves: two per cent of the deviation.
  CHECK(sigma == Approx(std::sqrt(m0)).epsilon(0.03));
  CHECK(notes.empty());
}

TEST_CASE("a load under a heaving vessel: the wire feels a base excitation, the vessel nothing", "[rao]") {
  const TemporaryFolder folder;
  RaoSpec spec;
  const double w = 0.9, a = 1.0;
  std::ostringstream line;
  line.precision(15);
  line << kTwoPi / w << ",0,0,0,0,0,0.8,0,0,0,0,0,0,0\n";
  spec.file = folder.write("rao.csv", header() + line.str());
  LiftParts lift = vessel_alone(spec);
  const double ship_mass = lift.spec.bodies.front().mass;
  {
    BodySpec& ship = lift.spec.bodies.front();
    ship.position = ship.cog = Vector3::Zero();
    ship.attitude = {};
  }
  const double m = 2e5, L = 30.0, stiffness = 4e6;  // 4.5 rad/s
  lift.winch("hoist");
  lift.body("load", m, Vector3(0, 0, 10.0));
  lift.wire("fall", "vessel", Vector3(0, 0, 40.0), "load", Vector3::Zero(), stiffness * L, "hoist").unstretched_length =
      L;
  regular_sea(lift.spec, a, w, 0.0, 60.0);
  lift.spec.solver.time_step = 0.02;
  lift.spec.solver.output_interval = 0.1;
  lift.spec.solver.max_duration = 60.0 + 3.0 * kTwoPi / w;
  const Model model = build_model(lift.spec);
  const Trajectory run = simulate(model, build_operation(model), {});
  REQUIRE(run.status == RunStatus::completed);
  const double w2 = stiffness / m;
  // m z'' = k (z_b - z): the stretch has the amplitude a w^2/(w_n^2 - w^2).
  const double amplitude = stiffness * 0.8 * a * w * w / (w2 - w * w);
  double low = 1e12, high = 0.0;
  for (std::size_t n = 0; n < run.time.size(); ++n) {
    if (run.time[n] < 60.0) continue;
    const double T = series(run, "fall.tension")[n], t = run.time[n];
    low = std::min(low, T);
    high = std::max(high, T);
    // The frame holds the weight of the vessel and its acceleration, and the wire.
    const double z_dd = -0.8 * a * w * w * std::cos(w * t);
    // The integrator's acceleration is that of al h before, 0.002 s: 1e-3 of it.
    CHECK(series(run, "vessel.rao.force_z")[n] == Approx(ship_mass * (kG + z_dd) + T).margin(2e-3 * ship_mass));
  }
  // What a ramp of nine periods leaves of the load's own bounce.
  CHECK(0.5 * (high - low) == Approx(amplitude).epsilon(5e-3));
  CHECK(0.5 * (high + low) == Approx(m * kG).epsilon(1e-3));
}

TEST_CASE("the energy of a lift under a moving vessel comes from the frame that moves it", "[rao]") {
  const TemporaryFolder folder;
  const Truth truth;
  RaoSpec spec;
  spec.reference = Vector3(12.0, -4.0, 7.0);
  spec.file = folder.write("rao.csv", table_text(truth, spec, {0.4, 0.7, 1.1}));
  LiftParts lift = vessel_alone(spec);
  lift.body("load", 2e5, Vector3(30.0, -12.0, 10.0));
  lift.wire("fall", "vessel", Vector3(0, 0, 40.0), "load", Vector3::Zero(), 4e6 * 30.0).unstretched_length = 30.0;
  regular_sea(lift.spec, 1.0, 0.8, 2.0, 10.0);
  const Model model = build_model(lift.spec);
  HhtOptions options;
  options.alpha = -0.05;
  HhtStepper stepper(model.system(), options);
  SystemWorkspace work = model.system().make_workspace();
  SystemState state = model.initial_state();
  stepper.start(state);
  const auto energy = [&] {
    return model.system().kinetic_energy(state) + model.system().potential_energy(state, work);
  };
  const double first = energy();
  double given = 0.0, largest = 0.0, missing = 0.0, power = model.system().prescribed_power(state);
  const double h = 0.01;
  for (int k = 1; k <= 3000; ++k) {
    REQUIRE(stepper.step(state, h, {}));
    const double now = model.system().prescribed_power(state);
    given += 0.5 * h * (power + now);
    power = now;
    largest = std::max(largest, std::abs(energy() - first));
    missing = std::max(missing, std::abs(energy() - first - given));
  }
  CHECK(largest > 1e7);  // J: the vessel's 20 000 t at half a metre a second
  // Second order in the step: (w h)^2 with the wire's 4.5 rad/s is 2e-3, most of the energy is the vessel's at 0.8.
  CHECK(missing < 1e-3 * largest);
}

TEST_CASE("WAMIT's .4 says what the same RAOs in columns say", "[rao]") {
  const TemporaryFolder folder;
  const double ulen = 75.0;
  const double period = 9.0, w = kTwoPi / period;
  // A second body's modes 7 to 12 come first.
  std::string wamit, csv = header("period_s", "_rad_per_m");
  const std::array<double, 6> mod = {0.5, 0.25, 0.8, 3.0, 1.5, 0.75}, lead = {80, -70, -10, 150, -95, 20};
  const auto line = [&](int mode, double size, double phase) {
    std::ostringstream out;
    out.precision(10);
    out << period << "  135  " << mode << "  " << size << "  " << phase << "  " << size * std::cos(phase * kDegree)
        << "  " << size * std::sin(phase * kDegree) << "\n";
    return out.str();
  };
  csv += "9,135";
  for (int i = 0; i < 6; ++i) {
    const auto n = static_cast<std::size_t>(i);
    wamit += line(i + 7, 0.1, 0.0);
    wamit += line(i + 1, mod[n], lead[n]);
    std::ostringstream out;
    out.precision(15);
    out << "," << mod[n] / (i < 3 ? 1.0 : ulen) << "," << lead[n];
    csv += out.str();
  }
  RaoSpec columns;
  columns.phase = RaoSpec::Phase::lead;
  columns.reference = Vector3(5.0, 0.0, -1.0);
  columns.phase_x = -30.0;
  RaoSpec file = columns;
  columns.file = folder.write("rao.csv", csv + "\n");
  file.phase = RaoSpec::Phase::lag;  // has no meaning for the format
  file.format = RaoSpec::Format::wamit;
  file.length = ulen;
  file.body = 1;
  file.file = folder.write("vessel.4", wamit);
  const RaoTable a = read_rao_table(vessel(columns), kG), b = read_rao_table(vessel(file), kG);
  REQUIRE(b.values.size() == 1);
  CHECK(b.headings.front() == Approx(a.headings.front()).epsilon(1e-12));
  CHECK(b.frequencies.front() == Approx(w).epsilon(1e-12));
  for (std::size_t i = 0; i < 6; ++i) CHECK(std::abs(a.values[0][i] - b.values[0][i]) < 1e-9);
  file.body = 0;
  CHECK_THAT(refusal([&] { read_rao_table(vessel(file), kG); }),
             Catch::Contains("2 bodies") && Catch::Contains("wamit_body"));
  file.body = 1;
  file.file = folder.write("short.4", line(1, 0.5, 80.0));
  CHECK_THAT(refusal([&] { read_rao_table(vessel(file), kG); }), Catch::Contains("not all six modes"));
}

TEST_CASE("headings of one side stand for the other", "[rao]") {
  const TemporaryFolder folder;
  RaoSpec spec;
  std::string text = header();
  for (const double heading : {0.0, 45.0, 90.0, 135.0, 180.0}) {
    const double b = heading * kDegree;
    std::ostringstream line;
    line << "10," << heading << ",0.5,90," << 0.6 * std::sin(b) + 1e-13 << ",90,1,0," << 2.0 * std::sin(b) + 1e-13
         << ",-90,1,90," << 0.5 * std::sin(2.0 * b) * std::sin(2.0 * b) << ",0\n";
    text += line.str();
  }
  spec.file = folder.write("rao.csv", text);
  spec.port_starboard = true;
  const RaoTable table = read_rao_table(vessel(spec), kG);
  CHECK(table.headings.size() == 8);
  const double w = kTwoPi / 10.0;
  for (const double b : {45.0, 90.0, 135.0}) {
    const Raos port = table.between(w, b * kDegree), starboard = table.between(w, -b * kDegree);
    for (std::size_t i = 0; i < 6; ++i) CHECK(std::abs(starboard[i] - (i % 2 == 1 ? -1.0 : 1.0) * port[i]) < 1e-12);
  }
  // Half way between two rows the complex numbers are the mean of theirs.
  const Raos middle = table.between(w, 22.5 * kDegree), a = table.between(w, 0.0), b = table.between(w, 45.0 * kDegree);
  for (std::size_t i = 0; i < 6; ++i) CHECK(std::abs(middle[i] - 0.5 * (a[i] + b[i])) < 1e-12);
}

TEST_CASE("an RAO table that does not cover the sea is refused with the remedy", "[rao]") {
  const TemporaryFolder folder;
  const Truth truth;
  RaoSpec spec;
  spec.file = folder.write("rao.csv", table_text(truth, spec, {0.4, 0.7, 1.1}));
  const auto in = [&](double w, double towards, RaoSpec::Beyond beyond = RaoSpec::Beyond::refuse) {
    BodySpec body = vessel(spec);
    body.attitude = {};
    body.hydrodynamics.rao.beyond = beyond;
    std::vector<std::string> notes;
    RaoMotion motion(body, read_rao_table(body, kG), regular_wave(1.0, w, towards), notes);
    return notes;
  };
  CHECK(in(0.5, 0.2).empty());
  CHECK_THAT(refusal([&] { in(0.3, 0.2); }), Catch::Contains("longer periods"));
  CHECK_THAT(refusal([&] { in(0.3, 0.2, RaoSpec::Beyond::cut); }), Catch::Contains("longer periods"));
  CHECK_THAT(refusal([&] { in(1.3, 0.2); }), Catch::Contains("beyond = \"cut\""));
  REQUIRE(in(1.3, 0.2, RaoSpec::Beyond::cut).size() == 1);
  CHECK_THAT(in(1.3, 0.2, RaoSpec::Beyond::cut).front(), Catch::Contains("100 %"));
  spec.file = folder.write("one.csv", header() + row(truth, spec, 0.5, 0.0) + row(truth, spec, 0.5, 90.0 * kDegree));
  CHECK(in(0.5, 0.0).empty());
  CHECK_THAT(refusal([&] { in(0.5, 45.0 * kDegree); }), Catch::Contains("45 deg") && Catch::Contains("port_starboard"));
  spec.file = folder.write("two.csv", header() + row(truth, spec, 0.5, 0.0) + row(truth, spec, 0.5, 45.0 * kDegree));
  REQUIRE(in(0.5, 20.0 * kDegree).size() == 1);
  CHECK_THAT(in(0.5, 20.0 * kDegree).front(), Catch::Contains("45 deg apart"));
  // Without a ramp the vessel would jump.
  LiftParts lift = vessel_alone(spec);
  regular_sea(lift.spec, 1.0, 0.5, 0.7, 0.0);
  CHECK_THAT(refusal([&] { build_model(lift.spec); }), Catch::Contains("ramp"));
}

TEST_CASE("an RAO file that is not right is refused by line and rule", "[rao]") {
  const TemporaryFolder folder;
  const std::string good = "8,0,0.5,0,0,0,1,0,2,0,0,0,0,0\n";
  const auto said = [&](const std::string& text) {
    RaoSpec spec;
    spec.file = folder.write("rao.csv", text);
    return refusal([&] { read_rao_table(vessel(spec), kG); });
  };
  CHECK(said(header() + good).empty());
  CHECK_THAT(said(header() + "8,0,0.5,0,0,0,1,0,2,0,0,0,0\n"),
             Catch::Contains("rao.csv:2") && Catch::Contains("cut off"));
  CHECK_THAT(said(header() + good + good), Catch::Contains("rao.csv:3") && Catch::Contains("once more"));
  CHECK_THAT(said(header() + good + "9,0,0.5,0,0,0,1,0,2,0,0,0,0,0\n9,90,0.5,0,0,0,1,0,2,0,0,0,0,0\n"),
             Catch::Contains("same periods"));
  CHECK_THAT(said(header() + "8,0,0.5,0,0,0,1,0,x,0,0,0,0,0\n"),
             Catch::Contains("roll_deg_per_m") && Catch::Contains("\"x\""));
  CHECK_THAT(said(header() + "8,0,-0.5,0,0,0,1,0,2,0,0,0,0,0\n"),
             Catch::Contains("surge_m_per_m") && Catch::Contains(">= 0"));
  CHECK_THAT(said(header() + "8,0,0.5,0,0,0,1,0,200,0,0,0,0,0\n"), Catch::Contains("unit"));
  CHECK_THAT(said(header() + "0,0,0.5,0,0,0,1,0,2,0,0,0,0,0\n"), Catch::Contains("period_s"));
  CHECK_THAT(said("period_s,heading_deg\n8,0\n"), Catch::Contains("surge_m_per_m"));
  CHECK_THAT(said("T,heading_deg\n8,0\n"), Catch::Contains("period_s"));
  CHECK_THAT(said(header().substr(0, header().size() - 1) + ",note\n" + good), Catch::Contains("\"note\""));
  CHECK_THAT(said(header()), Catch::Contains("no rows"));
}

TEST_CASE("wrong conventions show in long waves, which every ship follows", "[rao]") {
  const TemporaryFolder folder;
  // A raft on waves of 25 s: its points go with the surface. Phases are lags of the crest.
  const double w = kTwoPi / 25.0, k = w * w / kG;
  const auto odd = [&](RaoSpec spec) {
    std::string text = header("period_s", "_rad_per_m");
    for (const double heading : {0.0, 45.0, 90.0, 135.0, 180.0}) {
      const double b = heading * kDegree, c = std::cos(b), s = std::sin(b);
      std::ostringstream line;
      line.precision(12);
      // Water that the crest passes goes forward with it, a quarter of a period later it is furthest: cos(wt - 90 deg).
      line << "25," << heading << "," << std::abs(c) << "," << (c < 0 ? -90 : 90) << "," << s << ",90,1,0," << k * s
           << ",90," << k * std::abs(c) << "," << (c < 0 ? 90 : -90) << ",0,0\n";
      text += line.str();
    }
    spec.file = folder.write("rao.csv", text);
    BodySpec body = vessel(spec);
    body.cog = Vector3::Zero();
    return odd_in_long_waves(read_rao_table(body, kG), kG);
  };
  RaoSpec right;
  CHECK(odd(right).empty());
  RaoSpec lead = right;
  lead.phase = RaoSpec::Phase::lead;
  CHECK(odd(lead).size() >= 3);
  RaoSpec bow_up = right;
  bow_up.reversed[4] = true;
  REQUIRE(odd(bow_up).size() == 1);
  CHECK_THAT(odd(bow_up).front(), Catch::Contains("pitch") && Catch::Contains("25 s"));
  RaoSpec from = right;
  from.direction = RaoSpec::Direction::from;
  CHECK(odd(from).size() >= 2);
  RaoSpec trough = right;
  trough.event = RaoSpec::Event::trough;
  CHECK_THAT(odd(trough).front(), Catch::Contains("surge"));
}
