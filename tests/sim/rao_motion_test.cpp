// Vessels that move by displacement RAOs: what every convention of a file means, and what the sea then makes of it.
#include "sim/hull/rao_motion.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>
#include <sstream>

#include "sim/multibody/hht.h"
#include "sim/sea/spectrum.h"
#include "tests/sim/rao_sample.h"
#include "tests/sim/temporary_folder.h"

using namespace stillhook;
using namespace stillhook::rao_sample;

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
