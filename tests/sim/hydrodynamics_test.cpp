#include "sim/hull/hydrodynamics.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "sim/hull/coefficients/coefficient_file.h"

namespace stillhook {
namespace {

const std::string kCraneFile = STILLHOOK_SOURCE_DIR "/problems/hulls/crane_110x46x4.csv";
constexpr double kHeading = 0.7;

Mesh crane_mesh() { return box_mesh(Vector3(110.0, 46.0, 7.5), Vector3(0.0, 0.0, -0.25), 8.0); }

SeaSpec sea() { return {}; }

std::shared_ptr<const WaveField> waves(double amplitude = 1.0) {
  SeaStateSpec state;
  state.type = SeaStateSpec::Type::regular;
  state.amplitude = amplitude;
  state.frequency = 0.628;
  state.heading = kHeading + 0.785;
  state.phase = 0.4;
  return std::make_shared<const WaveField>(build_wave_field(state, 9.80665, 20.0));
}

BodySpec crane(HydrodynamicsSpec::Kind kind) {
  BodySpec spec;
  spec.name = "crane";
  spec.cog = Vector3(-4.5, 0.3, 1.2);
  spec.hydrodynamics.kind = kind;
  spec.hydrodynamics.coefficient_file = kCraneFile;
  spec.hydrodynamics.linear_damping << 1e5, 2e5, 3e5, 4e7, 5e7, 6e7;
  spec.hydrodynamics.quadratic_damping << 2e5, 3e5, 1e6, 3e9, 1e9, 2e9;
  const HydrodynamicCoefficients c = read_coefficient_file(kCraneFile);
  spec.hydrodynamics.added_mass = c.frequency[3].A;
  spec.hydrodynamics.damping = c.frequency[3].B;
  return spec;
}

std::unique_ptr<ForceElement> build_from(const BodySpec& spec, int body, const Mesh& hull, const SeaSpec& water) {
  std::vector<std::string> warnings;
  HydrodynamicsBody b{{&spec, &hull, 0.0, 0.0, 0.0, kHeading}, body, Vector6::Zero()};
  const auto set = coefficient_set({&b.afloat, 1}, water, {}, warnings);
  return build_hydrodynamics({b}, set, waves(), water, {}, warnings);
}

std::unique_ptr<ForceElement> build(const BodySpec& spec, int body = 1) {
  return build_from(spec, body, crane_mesh(), sea());
}

/// Two bodies in general poses; the second, the hull, near its mean attitude.
std::vector<BodyKinematics> bodies(double scale = 1.0) {
  std::vector<BodyKinematics> b(2);
  b[0].R_WB = rotation_from({0.4, -0.8, 2.0});
  b[0].p_WC = Vector3(50.0, 3.0, 40.0);
  b[1].R_WB = rotation_from({0.05 * scale, -0.03 * scale, kHeading + 0.04 * scale});
  b[1].p_WC = Vector3(12.0, -7.0, 0.8);
  b[1].v_WC = scale * Vector3(0.3, -0.5, 0.4);
  b[1].w_B = scale * Vector3(0.02, -0.03, 0.01);
  return b;
}

/// An element with its memory.
struct Held {
  explicit Held(const ForceElement& e) : element(e), state(e.state_size()), scratch(e.scratch_size()) {}
  Memory memory() { return {state, scratch}; }
  VectorX force(const Instant& now, double h) {
    ForceSum sum(static_cast<int>(now.body.size()));
    element.add_forces(now, h, memory(), sum);
    return sum.value();
  }
  const ForceElement& element;
  std::vector<double> state, scratch;
};

void move(BodyKinematics& b, int coordinate, double by) {
  if (coordinate < 3)
    b.p_WC(coordinate) += by;
  else
    b.R_WB = b.R_WB * exp_rotation(by * Vector3::Unit(coordinate - 3));
}

void accelerate(BodyKinematics& b, int coordinate, double by) {
  if (coordinate < 3)
    b.v_WC(coordinate) += by;
  else
    b.w_B(coordinate - 3) += by;
}

}  // namespace

TEST_CASE("hydrodynamic derivatives are exact", "[hydrodynamics]") {
  for (HydrodynamicsSpec::Kind kind : {HydrodynamicsSpec::Kind::constant, HydrodynamicsSpec::Kind::table}) {
    const auto element = build(crane(kind));
    Held held(*element);
    std::vector<BodyKinematics> b = bodies(0.0);
    double t = 31.0;
    element->start({t, b, {}}, held.memory());
    for (double h : {0.05, 0.07, 0.03, 0.22}) {
      b = bodies(0.3 + h);
      element->begin_step({t, b, {}}, h, held.memory());
      t += h;
      element->end_step({t, b, {}}, h, held.memory());
    }
    for (double h : {0.06, 0.0}) {
      if (h > 0.0) element->begin_step({t, b, {}}, h, held.memory());
      const double now = t + h;
      b = bodies();
      JacobianSum J(2);
      element->add_jacobian({now, b, {}}, h, held.memory(), J);
      CHECK(J.stiffness().block(6, 6, 6, 6).norm() * (kind == HydrodynamicsSpec::Kind::table) +
                (kind == HydrodynamicsSpec::Kind::constant) >
            0.0);
      for (int i = 0; i < 12; ++i) {
        const double step = 1e-5;
        std::vector<BodyKinematics> up = b, down = b;
        move(up[i / 6], i % 6, step);
        move(down[i / 6], i % 6, -step);
        const VectorX K = (held.force({now, up, {}}, h) - held.force({now, down, {}}, h)) / (2.0 * step);
        up = down = b;
        accelerate(up[i / 6], i % 6, step);
        accelerate(down[i / 6], i % 6, -step);
        const VectorX C = (held.force({now, up, {}}, h) - held.force({now, down, {}}, h)) / (2.0 * step);
        for (int row = 0; row < 12; ++row) {
          // Rounding of forces up to 1e8 N m over 2e-5 is 1e-3 .. 1e-2; truncation is below that.
          INFO("h " << h << " row " << row << " column " << i);
          CHECK(std::abs(J.stiffness()(row, i) - K(row)) < 0.05 + 1e-6 * J.stiffness().cwiseAbs().maxCoeff());
          CHECK(std::abs(J.damping()(row, i) - C(row)) < 0.05 + 1e-8 * J.damping().cwiseAbs().maxCoeff());
        }
      }
    }
  }
}

TEST_CASE("added mass keeps the kinetic energy of the velocity at the reference point", "[hydrodynamics]") {
  const BodySpec spec = crane(HydrodynamicsSpec::Kind::constant);
  MatrixX M = MatrixX::Zero(12, 12);
  build(spec)->add_mass(M, 0);
  CHECK(M.topRows(6).norm() == 0.0);
  CHECK((M - M.transpose()).norm() < 1e-12 * M.norm());
  // The hull in its mean attitude: velocity of Bo by rigid-body kinematics, turned into H by hand.
  const Matrix3 R = rotation_from({0.0, 0.0, kHeading});
  const Vector3 v_WC(0.3, -0.8, 0.5), w_B(0.02, 0.05, -0.03);
  const Vector3 v_WBo = v_WC + (R * w_B).cross(R * -spec.cog);
  Vector6 V, u;
  V.head<3>() = R.transpose() * v_WBo;
  V.tail<3>() = u.tail<3>() = w_B;
  u.head<3>() = v_WC;
  CHECK(u.dot(M.block(6, 6, 6, 6) * u) == Approx(V.dot(spec.hydrodynamics.added_mass * V)).epsilon(1e-12));
}

TEST_CASE("constant radiation acts at the reference point along the heading", "[hydrodynamics]") {
  BodySpec spec = crane(HydrodynamicsSpec::Kind::constant);
  spec.hydrodynamics.linear_damping.setZero();
  spec.hydrodynamics.quadratic_damping.setZero();
  spec.hydrodynamics.damping.setZero();
  spec.hydrodynamics.damping(0, 0) = 1e6;
  const auto element = build(spec);
  Held held(*element);
  std::vector<BodyKinematics> b = bodies(0.0);
  b[1].v_WC = Vector3(std::cos(kHeading), std::sin(kHeading), 0.0) * 2.0;  // surging ahead
  element->start({0.0, b, {}}, held.memory());
  element->begin_step({0.0, b, {}}, 0.1, held.memory());
  const VectorX Q = held.force({0.1, b, {}}, 0.1);
  CHECK(Q(6) == Approx(-2e6 * std::cos(kHeading)));
  CHECK(Q(7) == Approx(-2e6 * std::sin(kHeading)));
  // The force acts 1.2 m below and 4.5 m ahead, 0.3 m starboard of the centre of gravity: r x F with r = -c.
  CHECK(Q(9) == Approx(0.0).margin(1e-6));
  CHECK(Q(10) == Approx(1.2 * 2e6));
  CHECK(Q(11) == Approx(-0.3 * 2e6));
}

TEST_CASE("dissipated power is what the damping takes", "[hydrodynamics]") {
  BodySpec spec = crane(HydrodynamicsSpec::Kind::constant);
  const std::vector<BodyKinematics> b = bodies();
  for (HydrodynamicsSpec::Kind kind : {HydrodynamicsSpec::Kind::none, HydrodynamicsSpec::Kind::constant}) {
    spec.hydrodynamics.kind = kind;
    const auto element = build(spec);
    Held held(*element);
    const double t = 0.0;  // the wave's ramp begins at zero
    element->start({t, b, {}}, held.memory());
    const VectorX Q = held.force({t, b, {}}, 0.0);
    Vector6 u;
    u.head<3>() = b[1].v_WC;
    u.tail<3>() = b[1].w_B;
    const double power = element->dissipated_power({t, b, {}}, held.memory());
    CHECK(power > 0.0);
    CHECK(power == Approx(-u.dot(Q.segment<6>(6))).epsilon(1e-12));
  }
}

TEST_CASE("measured channels agree with the force of the step", "[hydrodynamics]") {
  BodySpec spec = crane(HydrodynamicsSpec::Kind::table);
  spec.hydrodynamics.linear_damping.setZero();
  spec.hydrodynamics.quadratic_damping.setZero();
  spec.cog.setZero();
  const auto element = build(spec);
  REQUIRE(element->name() == "crane.hydrodynamics");
  const std::vector<Channel> channels = element->channels();
  REQUIRE(channels.size() == 12);
  CHECK(channels[2].name == "crane.radiation_heave");
  CHECK(channels[9].name == "crane.diffraction_roll");
  CHECK(channels[9].unit == "N m");
  Held held(*element);
  double t = 40.0;
  std::vector<BodyKinematics> b = bodies(0.0);
  element->start({t, b, {}}, held.memory());
  VectorX Q;
  for (int n = 1; n <= 200; ++n) {
    const double h = n % 3 == 0 ? 0.03 : 0.05;
    element->begin_step({t, b, {}}, h, held.memory());
    t += h;
    const double speed = std::sin(0.628 * (t - 40.0));
    b[1].v_WC = Vector3(0.2, 0.1, 0.5) * speed;
    b[1].p_WC += h * b[1].v_WC;
    Q = held.force({t, b, {}}, h);
    element->end_step({t, b, {}}, h, held.memory());
  }
  std::vector<double> out(12);
  element->measure({t, b, {}}, held.memory(), out);
  Vector6 F;
  for (int i = 0; i < 6; ++i) F(i) = out[i] + out[6 + i];
  const Matrix3 R = rotation_from({0.0, 0.0, kHeading});
  // Both are second order in the step, by different sums; the diffraction differs by (k dx)^2.
  CHECK((Q.segment<3>(6) - R * F.head<3>()).norm() < 1e-3 * F.head<3>().norm());
  CHECK((Q.segment<3>(9) - F.tail<3>()).norm() < 1e-3 * F.tail<3>().norm());
  CHECK(std::abs(out[2]) > 1e5);
  CHECK(std::abs(out[8]) > 1e5);
}

TEST_CASE("two coupled hulls exchange forces", "[hydrodynamics]") {
  MatrixX A = MatrixX::Identity(12, 12) * 1e6, B = MatrixX::Identity(12, 12) * 1e5;
  A(2, 8) = A(8, 2) = 3e5;
  B(2, 8) = B(8, 2) = 2e4;
  std::vector<HydrodynamicsHull> hulls = {{"a", HeadingFrame(1, Vector3(1.0, 0.0, 2.0), 0.3), {}},
                                          {"b", HeadingFrame(0, Vector3(0.0, 2.0, 1.0), 1.2), {}}};
  const HydrodynamicsElement element("pair", hulls, A, std::make_unique<ConstantRadiation>(B), nullptr);
  CHECK(element.channels().size() == 24);
  MatrixX M = MatrixX::Zero(12, 12);
  element.add_mass(M, 0);
  CHECK(M(8, 2) == Approx(3e5));  // heave on heave, bodies 1 and 0
  CHECK((M - M.transpose()).norm() < 1e-12 * M.norm());
  Held held(element);
  std::vector<BodyKinematics> b(2);
  b[0].v_WC = Vector3(0.0, 0.0, 1.0);
  element.start({0.0, b, {}}, held.memory());
  const VectorX Q = held.force({0.0, b, {}}, 0.0);
  CHECK(Q(2) == Approx(-1e5));
  CHECK(Q(8) == Approx(-2e4));
  JacobianSum J(2);
  element.add_jacobian({0.0, b, {}}, 0.0, held.memory(), J);
  CHECK(J.damping()(8, 2) == Approx(-2e4));
  CHECK_THROWS_AS(HydrodynamicsElement("bad", hulls, MatrixX::Zero(6, 6), nullptr, nullptr), std::invalid_argument);
}

TEST_CASE("a body without hydrodynamics has no element", "[hydrodynamics]") {
  BodySpec spec;
  spec.name = "load";
  CHECK(build(spec) == nullptr);
}

TEST_CASE("added mass about the centre of gravity at a frequency", "[hydrodynamics]") {
  const Vector3 cog(0.0, 0.0, 4.541);
  const HydrodynamicCoefficients c = read_coefficient_file(kCraneFile);
  const Matrix6 A = added_mass_at(c, 0, cog, 0.628);
  CHECK(A(2, 2) == Approx(c.frequency[3].A(2, 2)).epsilon(0.01));
  // Rolling about C, port side up, moves Bo, which lies z below C, to port with z w_x: A44 + 2 z A24 + z^2 A22.
  const double z = 4.541;
  CHECK(
      A(3, 3) ==
      Approx(c.frequency[3].A(3, 3) + 2.0 * z * c.frequency[3].A(1, 3) + z * z * c.frequency[3].A(1, 1)).epsilon(0.02));
  CHECK(added_mass_at(c, 0, cog, std::numeric_limits<double>::infinity())(2, 2) == c.A_inf(2, 2));
  // Between two frequencies of the table, above it, and from the retardation functions where there is no table.
  const auto &low = c.frequency[3], &high = c.frequency[4];
  const double between = added_mass_at(c, 0, Vector3::Zero(), 0.5 * (low.frequency + high.frequency))(2, 2);
  CHECK(between == Approx(0.5 * (low.A(2, 2) + high.A(2, 2))));
  const double above = added_mass_at(c, 0, Vector3::Zero(), 2.0 * c.frequency.back().frequency)(2, 2);
  CHECK(above - c.A_inf(2, 2) == Approx(0.25 * (c.frequency.back().A(2, 2) - c.A_inf(2, 2))));
  HydrodynamicCoefficients kernels = c;
  kernels.frequency.clear();
  CHECK(added_mass_at(kernels, 0, Vector3::Zero(), 0.628)(2, 2) ==
        added_mass_from_kernels(c.A_inf, c.retardation, 0.628)(2, 2));
}

TEST_CASE("retardation functions stand in where no state space meets the tolerance", "[hydrodynamics]") {
  BodySpec spec = crane(HydrodynamicsSpec::Kind::table);
  spec.hydrodynamics.radiation = HydrodynamicsSpec::RadiationModel::reduced;
  const Mesh hull = crane_mesh();
  const HydrodynamicsBody b{{&spec, &hull, 0.0, 0.0, 0.0, kHeading}, 1, Vector6::Zero()};
  std::vector<std::string> warnings;
  const auto set = coefficient_set({&b.afloat, 1}, sea(), {}, warnings);
  const auto element = [&](HydrodynamicsSpec::RadiationModel model, double tolerance) {
    spec.hydrodynamics.radiation = model;
    PanelMethodSpec method;
    method.fit_tolerance = tolerance;
    return build_hydrodynamics({b}, set, waves(), sea(), method, warnings);
  };
  CHECK(warnings.empty());
  // One part in a million is below what the truncated kernels of the file can be fitted to.
  const auto reduced = element(HydrodynamicsSpec::RadiationModel::reduced, 1e-6);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("retardation functions are used instead") != std::string::npos);
  CHECK(warnings[0].find("panel_method.fit_tolerance") != std::string::npos);
  CHECK(reduced->same_as(*element(HydrodynamicsSpec::RadiationModel::retardation, 1e-6)));
  CHECK(warnings.size() == 1);
}

TEST_CASE("hydrodynamics that cannot be are refused by name", "[hydrodynamics]") {
  BodySpec spec = crane(HydrodynamicsSpec::Kind::table);
  SeaSpec water = sea();
  Mesh hull = crane_mesh();
  std::string field, part;
  SECTION("negative damping") {
    spec.hydrodynamics.linear_damping(3) = -1.0;
    field = "linear_damping", part = "got -1 in number 4";
  }
  SECTION("quadratic damping that is no number") {
    spec.hydrodynamics.quadratic_damping(3) = std::nan("");
    field = "quadratic_damping", part = "finite";
  }
  SECTION("added mass that is not symmetric") {
    spec.hydrodynamics.kind = HydrodynamicsSpec::Kind::constant;
    spec.hydrodynamics.added_mass(0, 4) += 1e8;
    field = "added_mass", part = "symmetric";
  }
  SECTION("added mass that is negative") {
    spec.hydrodynamics.kind = HydrodynamicsSpec::Kind::constant;
    spec.hydrodynamics.added_mass(2, 2) = -1e6;
    field = "added_mass", part = "negative number on its diagonal";
  }
  SECTION("damping that gives energy") {
    spec.hydrodynamics.kind = HydrodynamicsSpec::Kind::constant;
    spec.hydrodynamics.damping(0, 4) = spec.hydrodynamics.damping(4, 0) = 1e12;
    field = "damping", part = "negative eigenvalue";
  }
  SECTION("no file") {
    spec.hydrodynamics.coefficient_file = "/nowhere.csv";
    field = "coefficient_file", part = "/nowhere.csv: cannot be opened";
  }
  SECTION("fresh water") {
    water.density = 1000.0;
    field = "coefficient_file", part = "water of 1025 kg/m3, the case has 1000 kg/m3";
  }
  SECTION("another hull") {
    hull = box_mesh(Vector3(90.0, 46.0, 7.5), Vector3(0.0, 0.0, -0.25), 8.0);
    field = "coefficient_file", part = "displaced volume of 20240 m3, the case has 16560 m3";
  }
  SECTION("a hull in the air") {
    hull = box_mesh(Vector3(110.0, 46.0, 7.5), Vector3(0.0, 0.0, 5.0), 8.0);
    field = "coefficient_file", part = "no volume";
  }
  try {
    build_from(spec, 0, hull, water);
    FAIL_CHECK("was accepted");
  } catch (const SpecificationError& error) {
    INFO(error.what());
    CHECK(error.entry == "bodies.crane.hydrodynamics");
    CHECK(error.field == field);
    CHECK(std::string(error.what()).find(part) != std::string::npos);
  }
}

}  // namespace stillhook
