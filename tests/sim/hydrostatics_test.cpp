#include "sim/body_spec.h"

#include "sim/hull/hydrostatics.h"
#include "sim/hull/mesh/hull_mesh.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "sim/hull/immersion.h"

namespace stillhook {
namespace {

using FroudeKrylov = HullSpec::FroudeKrylov;
using Catch::Matchers::Contains;

constexpr double kDensity = 1025.0, kGravity = 9.80665, kWeight = kDensity * kGravity;
constexpr double kLength = 110.0, kBreadth = 46.0, kDepth = 7.5, kDraft = 4.0;

SeaSpec sea_water() {
  SeaSpec sea;
  sea.density = kDensity;
  sea.gravity = kGravity;
  return sea;
}

BodySpec barge(FroudeKrylov model, const Vector3& cog) {
  BodySpec body;
  body.name = "barge";
  body.cog = cog;
  body.hull.shape = HullSpec::Shape::box;
  body.hull.size = {kLength, kBreadth, kDepth};
  body.hull.centre = {0.0, 0.0, kDepth / 2 - kDraft};  // Bo on the waterline amidships
  body.hull.froude_krylov = model;
  return body;
}

std::shared_ptr<const WaveField> regular(double amplitude, double frequency, double heading, double lag) {
  SeaStateSpec s;
  s.name = "swell";
  s.type = SeaStateSpec::Type::regular;
  s.amplitude = amplitude;
  s.frequency = frequency;
  s.heading = heading;
  s.phase = lag;
  return std::make_shared<WaveField>(build_wave_field(s, kGravity, 0.0));
}

const auto kCalm = std::make_shared<const WaveField>();

// One hull, asked at poses of its body frame.
struct Hull {
  Hull(const BodySpec& spec, std::shared_ptr<const WaveField> waves)
      : body(spec),
        element(build_hydrostatics(spec, 0, std::move(waves), sea_water())),
        scratch(element->scratch_size()) {}

  Memory memory() const { return {{}, scratch}; }
  BodyKinematics at(const Pose& X_WB) const {
    BodyKinematics k;
    k.R_WB = X_WB.R;
    k.p_WC = X_WB * body.cog;
    return k;
  }
  Vector6 force(const BodyKinematics& k, double t = 0.0) const {
    ForceSum sum(1);
    element->add_forces({t, {&k, 1}, {}}, 0.05, memory(), sum);
    return sum.value();
  }
  Vector6 force(const Pose& X_WB, double t = 0.0) const { return force(at(X_WB), t); }
  JacobianSum jacobian(const Pose& X_WB, double t) const {
    const BodyKinematics k = at(X_WB);
    JacobianSum sum(1);
    element->add_jacobian({t, {&k, 1}, {}}, 0.05, memory(), sum);
    return sum;
  }
  double energy(const BodyKinematics& k, double t = 0.0) const {
    return element->potential_energy({t, {&k, 1}, {}}, memory());
  }
  std::array<double, 2> measured(const Pose& X_WB, double t) const {
    const BodyKinematics k = at(X_WB);
    std::array<double, 2> out{};
    element->measure({t, {&k, 1}, {}}, memory(), out);
    return out;
  }

  BodySpec body;
  std::unique_ptr<ForceElement> element;
  mutable std::vector<double> scratch;
};

BodyKinematics displaced(BodyKinematics k, const Vector6& xi) {
  k.p_WC += xi.head<3>();
  k.R_WB = k.R_WB * exp_rotation(xi.tail<3>());
  return k;
}

double largest(const MatrixX& m) {
  double most = 0.0;
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j) most = std::max(most, std::abs(m(i, j)));
  return most;
}

const Vector3 kCog(-3.0, 0.7, 1.4);
const Pose kTilted{rotation_from({0.13, -0.03, 2.1}),
                   {71.0, -33.0, 0.3}};  // deck edge and bilge partly across the water

TEST_CASE("calm water lifts with the weight of the displaced volume at its centroid, whatever the model") {
  for (const auto model : {FroudeKrylov::pressure, FroudeKrylov::volume})
    for (const Pose& X : {kTilted, Pose{rotation_from({-0.4, 0.2, 0.5}), {1.0, 2.0, -1.0}},
                          Pose{rotation_from({2.9, 0.1, -1.0}), {1.0, 2.0, -30.0}}}) {
      const Hull hull(barge(model, kCog), kCalm);
      const HydrostaticSummary truth = immersion_of(build_hull_mesh(hull.body.hull), X);
      const Vector6 Q = hull.force(X);
      const Vector3 F(0.0, 0.0, kWeight * truth.volume);
      const Vector3 M = X.R.transpose() * (truth.centre_of_buoyancy - X * kCog).cross(F);
      // Both integrate the same polyhedron exactly: rounding of a sum over 864 panels whose parts cancel.
      CHECK((Q.head<3>() - F).norm() < 1e-11 * F.norm());
      CHECK((Q.tail<3>() - M).norm() < 1e-11 * F.norm() * kLength);
      const auto [buoyancy, volume] = hull.measured(X, 0.0);
      CHECK(buoyancy == Approx(F.z()).epsilon(1e-12));
      CHECK(volume == Approx(truth.volume).epsilon(1e-12));
    }
}

TEST_CASE("the reference hull floats at 4 m, rights itself by the wall-sided formula and has its GM") {
  const Vector3 G(0.0, 0.0, 4.541);
  const Hull hull(barge(FroudeKrylov::pressure, G), kCalm);
  const double displacement = 20.746e6 * kGravity;
  CHECK(hull.force(Pose{}).z() == Approx(displacement).epsilon(1e-12));
  const double GM = kBreadth * kBreadth / (12 * kDraft) - kDraft / 2 - 4.541;
  const double BM = kBreadth * kBreadth / (12 * kDraft);
  for (const double heel : {-0.14, 0.03, 0.149}) {
    const Vector6 Q = hull.force(Pose{rotation_from({heel, 0.0, 0.0}), Vector3::Zero()});
    const double t = std::tan(heel);
    // Roll+ is answered by a negative moment.
    CHECK(Q[3] == Approx(-displacement * std::sin(heel) * (GM + 0.5 * BM * t * t)).epsilon(1e-10));
  }
  const Matrix6 K = hull.jacobian(Pose{}, 0.0).stiffness();
  CHECK(K(2, 2) == Approx(-kWeight * kLength * kBreadth).epsilon(1e-12));
  CHECK(K(3, 3) == Approx(-displacement * GM).epsilon(1e-11));
  CHECK(K(4, 4) == Approx(-displacement * (kLength * kLength / 48 - 2 - 4.541)).epsilon(1e-11));
}

TEST_CASE("in calm water the energy is that of the water displaced and the forces are its slope") {
  for (const auto model : {FroudeKrylov::pressure, FroudeKrylov::volume}) {
    const Hull hull(barge(model, kCog), kCalm);
    // Upright box: rho g L B T^2/2.
    CHECK(hull.energy(hull.at(Pose{})) == Approx(kWeight * kLength * kBreadth * kDraft * kDraft / 2).epsilon(1e-12));
    CHECK(hull.energy(hull.at(Pose{Matrix3::Identity(), {0.0, 0.0, 50.0}})) == 0.0);
    const BodyKinematics k = hull.at(kTilted);
    const Vector6 Q = hull.force(k);
    for (int i = 0; i < 6; ++i) {
      const double h = i < 3 ? 1e-2 : 1e-3;
      const auto central = [&](double d) {
        return (hull.energy(displaced(k, d * Vector6::Unit(i))) - hull.energy(displaced(k, -d * Vector6::Unit(i)))) /
               (2 * d);
      };
      // Extrapolated: fourth order; energy 4e8 J with 1e-15 relative rounding over h leaves about 1e-4 N.
      const double slope = (4 * central(h / 2) - central(h)) / 3;
      CHECK(Q[i] == Approx(-slope).epsilon(1e-7).margin(1e-7 * Q.norm()));
    }
  }
}

TEST_CASE("the Jacobian is the derivative of the force, partly submerged, in waves, at general attitudes") {
  SeaStateSpec storm;
  storm.name = "storm";
  storm.type = SeaStateSpec::Type::jonswap;
  storm.significant_height = 3.0;
  storm.peak_period = 9.0;
  storm.components = 20;
  storm.directions = 3;
  storm.spreading = 4.0;
  const auto seas = {kCalm, regular(1.5, 0.628, 0.8, 0.3),
                     std::make_shared<const WaveField>(build_wave_field(storm, kGravity, 0.0))};
  for (const auto model : {FroudeKrylov::pressure, FroudeKrylov::volume})
    for (const auto& waves : seas)
      for (const Pose& X : {kTilted, Pose{rotation_from({-0.35, 0.21, -0.9}), {-15.0, 8.0, -2.3}},
                            Pose{rotation_from({0.05, 0.12, 0.4}), {3.0, 5.0, -9.0}}}) {
        const Hull hull(barge(model, kCog), waves);
        const double t = 13.7;
        const JacobianSum J = hull.jacobian(X, t);
        CHECK(J.damping().isZero(0.0));
        const BodyKinematics k = hull.at(X);
        Matrix6 numeric;
        for (int i = 0; i < 6; ++i) {
          // Steps so small that no corner changes sides: 2e-5 m at the ends of the hull.
          const double h = i < 3 ? 2e-5 : 4e-7;
          const auto central = [&](double d) -> Vector6 {
            return (hull.force(displaced(k, d * Vector6::Unit(i)), t) -
                    hull.force(displaced(k, -d * Vector6::Unit(i)), t)) /
                   (2 * d);
          };
          numeric.col(i) = (4 * central(h / 2) - central(h)) / 3;
        }
        // Rounding of the sums: 1e-14 of the force over the step, against K ~ force / draft for translations and
        // force * length for rotations. Compared in units of the hull's length.
        Vector6 unit;
        unit << 1, 1, 1, 1 / kLength, 1 / kLength, 1 / kLength;
        const Matrix6 got = unit.asDiagonal() * J.stiffness() * unit.asDiagonal();
        const Matrix6 want = unit.asDiagonal() * numeric * unit.asDiagonal();
        CHECK(largest(got - want) < 1e-7 * largest(want));
      }
}

// Linear Froude-Krylov force and moment of a box about its centre on the waterline, per metre of amplitude: the
// incident pressure rho g e^(kz) cos(kx x + ky y + e) integrated over the six faces.
struct BoxFroudeKrylov {
  double k, kx, ky;
  BoxFroudeKrylov(double frequency, double heading)
      : k(frequency * frequency / kGravity), kx(k * std::cos(heading)), ky(k * std::sin(heading)) {}
  static double sinc(double u) { return std::abs(u) < 1e-12 ? 1.0 : std::sin(u) / u; }
  using Complex = std::complex<double>;  // factor of exp(i e); the force is its real part
  Complex heave() const {
    return kWeight * std::exp(-k * kDraft) * kLength * kBreadth * sinc(kx * kLength / 2) * sinc(ky * kBreadth / 2);
  }
  // -(p(L/2) - p(-L/2)) = 2 sin(kx L/2) sin e = Re(-2 i sin(kx L/2) exp(i e))
  Complex surge() const {
    return Complex(0, -2) * kWeight * std::sin(kx * kLength / 2) * ((1 - std::exp(-k * kDraft)) / k) * kBreadth *
           sinc(ky * kBreadth / 2);
  }
  Complex sway() const {
    return Complex(0, -2) * kWeight * std::sin(ky * kBreadth / 2) * ((1 - std::exp(-k * kDraft)) / k) * kLength *
           sinc(kx * kLength / 2);
  }
};

// Amplitude and phase of the force on a fixed hull from two lags a quarter period apart, calm water taken off.
Eigen::Vector3cd response(FroudeKrylov model, double frequency, double heading, double panel_length) {
  const double amplitude = 1e-3;  // small: the quadratic terms of the waterline are a/T = 2.5e-4 of the result
  Eigen::Vector3cd sum = Eigen::Vector3cd::Zero();
  BodySpec spec = barge(model, Vector3::Zero());
  spec.hull.panel_length = panel_length;
  for (const double lag : {0.0, -std::numbers::pi / 2}) {
    const Hull in_waves(spec, regular(amplitude, frequency, heading, lag)), still(spec, kCalm);
    const Vector3 F = (in_waves.force(Pose{}) - still.force(Pose{})).head<3>() / amplitude;
    // cos(e) at e = 0 gives the real part; at e = -pi/2, Re(X exp(-i pi/2)) = Im X.
    sum += F.cast<std::complex<double>>() * (lag == 0.0 ? std::complex<double>(1, 0) : std::complex<double>(0, 1));
  }
  return sum;
}

TEST_CASE("Froude-Krylov force of a box against the closed form") {
  // A linear interpolation over panels of edge d integrates exp(i k x) short by (k d)^2/12 along the wave. The
  // automatic panels are 5.5 x 5.75 m with rows 3.75 m high: at 1 rad/s (k = 0.102 per m, 60 m long) that is 2.6 % in
  // length and 1.2 % in depth, at 0.628 rad/s 0.4 % and 0.2 %. Errors are measured against the larger of the force
  // itself and a tenth of its long-wave scale, because near a zero of the sinc its own size says nothing. Measured,
  // worst of surge, sway and heave over the headings: 0.07 % at 0.4 rad/s, 0.18 % at 0.5, 0.45 % at 0.628, 1.2 % at
  // 0.8, 2.9 % at 1.0. The limit is 1.5 (k d)^2/12: errors along, across and in depth add up.
  const double heave_scale = kWeight * kLength * kBreadth;
  for (const double frequency : {0.4, 0.5, 0.628, 0.8, 1.0}) {
    double worst = 0.0;
    for (const double heading : {0.0, std::numbers::pi / 4, std::numbers::pi / 2}) {
      const BoxFroudeKrylov truth(frequency, heading);
      const Eigen::Vector3cd got = response(FroudeKrylov::pressure, frequency, heading, 0.0);
      const double side_scale = heave_scale * truth.k * kDraft;
      const auto error = [](std::complex<double> a, std::complex<double> b, double scale) {
        return std::abs(a - b) / std::max(std::abs(b), 0.1 * scale);
      };
      worst = std::max({worst, error(got.x(), truth.surge(), side_scale), error(got.y(), truth.sway(), side_scale),
                        error(got.z(), truth.heave(), heave_scale)});
    }
    CAPTURE(frequency, worst);
    const double kd = frequency * frequency / kGravity * 5.75;
    CHECK(worst < 1.5 * kd * kd / 12.0 + 2.5e-4);
  }
}

TEST_CASE("the panel error of the Froude-Krylov force is of second order") {
  const BoxFroudeKrylov truth(0.8, 0.6);
  const auto error = [&](double panel) {
    const Eigen::Vector3cd got = response(FroudeKrylov::pressure, 0.8, 0.6, panel);
    return std::abs(got.z() - truth.heave()) / std::abs(truth.heave());
  };
  // 110/(2n) and 46/(2m) whole at each level, so that halving the length halves every panel but for rounding up.
  const double coarse = error(11.5), fine = error(5.75);
  CHECK(std::log2(coarse / fine) == Approx(2.0).margin(0.15));
}

TEST_CASE("the volume model weighs the column below the wave profile") {
  const double frequency = 0.5, heading = 0.6, amplitude = 1.2;
  const double k = frequency * frequency / kGravity;
  BodySpec spec = barge(FroudeKrylov::volume, Vector3::Zero());
  spec.hull.panel_length = 2.0;
  for (const double lag : {0.0, 1.0, 2.5}) {
    const Hull hull(spec, regular(amplitude, frequency, heading, lag));
    const Vector6 Q = hull.force(Pose{});
    const double column = amplitude * BoxFroudeKrylov::sinc(k * std::cos(heading) * kLength / 2) *
                          BoxFroudeKrylov::sinc(k * std::sin(heading) * kBreadth / 2) * std::cos(lag);
    // Sides are vertical, bottom and deck stay clear of the surface: exact but for the interpolation of the profile,
    // (k d)^2/12 = 2e-4 of the wave's part.
    CHECK(Q.z() == Approx(kWeight * kLength * kBreadth * (kDraft + column)).epsilon(3e-4 * amplitude / kDraft));
    CHECK(Q[0] == 0.0);
    CHECK(Q[1] == 0.0);
    CHECK(Q[5] == 0.0);
    CHECK(hull.measured(Pose{}, 0.0)[1] * kWeight == Approx(Q.z()).epsilon(1e-12));
  }
}

TEST_CASE("signs: a crest lifts, the face of a wave pushes with it, the trough lets sink") {
  for (const auto model : {FroudeKrylov::pressure, FroudeKrylov::volume}) {
    const double still = Hull(barge(model, kCog), kCalm).force(Pose{}).z();
    CHECK(Hull(barge(model, kCog), regular(1.0, 0.4, 0.0, 0.0)).force(Pose{}).z() > 1.02 * still);
    CHECK(Hull(barge(model, kCog), regular(1.0, 0.4, 0.0, std::numbers::pi)).force(Pose{}).z() < 0.98 * still);
  }
  // The wave runs forward; its crest is still astern, so the water at the hull rises and accelerates forward, the
  // stern is lifted (bow down, pitch+). With the crest ahead both turn round.
  const Hull before(barge(FroudeKrylov::pressure, Vector3::Zero()), regular(1.0, 0.4, 0.0, std::numbers::pi / 2));
  const Hull after(barge(FroudeKrylov::pressure, Vector3::Zero()), regular(1.0, 0.4, 0.0, -std::numbers::pi / 2));
  CHECK(before.force(Pose{})[0] > 1e5);
  CHECK(before.force(Pose{})[4] > 1e6);
  CHECK(after.force(Pose{})[0] < -1e5);
  CHECK(after.force(Pose{})[4] < -1e6);
  // A head sea on a symmetric hull pushes neither sideways nor about roll or yaw: rounding of 2e8 N.
  const Vector6 Q = after.force(Pose{});
  CHECK(std::abs(Q[1]) < 1e-5);
  CHECK(std::abs(Q[3]) < 1e-3);
  CHECK(std::abs(Q[5]) < 1e-3);
}

TEST_CASE("a flying hull feels nothing, a sunken one its whole volume, and velocity does not matter") {
  for (const auto model : {FroudeKrylov::pressure, FroudeKrylov::volume}) {
    const Hull hull(barge(model, kCog), kCalm);
    const Matrix3 R = rotation_from({0.2, 0.1, 0.3});
    CHECK(hull.force(Pose{R, {0.0, 0.0, 60.0}}).isZero(0.0));
    CHECK(hull.jacobian(Pose{R, {0.0, 0.0, 60.0}}, 0.0).stiffness().isZero(0.0));
    const Pose deep{R, {0.0, 0.0, -60.0}};
    CHECK(hull.force(deep).z() == Approx(kWeight * kLength * kBreadth * kDepth).epsilon(1e-12));
    // Stiffness against translation vanishes; rounding of rho g times area vectors that cancel.
    CHECK(largest(hull.jacobian(deep, 0.0).stiffness().leftCols<3>()) < 1e-12 * kWeight * 5e5);
    BodyKinematics moving = hull.at(kTilted);
    const Vector6 Q = hull.force(moving);
    moving.v_WC = {1.0, 2.0, 3.0};
    moving.w_B = {0.1, -0.2, 0.3};
    CHECK(hull.force(moving) == Q);
  }
}

TEST_CASE("automatic panels are small enough for the sea, the case's own are taken as they are") {
  BodySpec body = barge(FroudeKrylov::pressure, kCog);
  const double automatic = properties_of(build_hull_mesh(body.hull)).longest_edge;
  CHECK(properties_of(hull_mesh_in(body, *kCalm)).longest_edge == automatic);
  // Waves of 61.6 m need nothing finer, those of 19.0 m panels of 3.8 m, whose diagonals are sqrt(2) times as long.
  CHECK(properties_of(hull_mesh_in(body, *regular(0.5, 1.0, 0.0, 0.0))).longest_edge == automatic);
  const double fine = properties_of(hull_mesh_in(body, *regular(0.5, 1.8, 0.0, 0.0))).longest_edge;
  CHECK(automatic > 3.81 * std::sqrt(2.0));
  CHECK(fine <= 3.81 * std::sqrt(2.0));
  // A ripple of 0.5 m would take hundreds of thousands.
  CHECK_THROWS_AS(hull_mesh_in(body, *regular(0.05, 11.0, 0.0, 0.0)), SpecificationError);
}

TEST_CASE("a hull that cannot be built is refused by name") {
  const auto refused = [](const BodySpec& body, std::shared_ptr<const WaveField> waves, const std::string& field) {
    try {
      build_hydrostatics(body, 0, std::move(waves), sea_water());
    } catch (const SpecificationError& e) {
      return e.entry == "bodies.barge" && e.field == field ? std::string(e.what()) : "wrong entry";
    }
    return std::string();
  };
  BodySpec body = barge(FroudeKrylov::pressure, kCog);
  CHECK(refused(body, kCalm, "hull") == "");
  // 1.8 rad/s is 19 m long: shorter than five panels. Automatic ones are made smaller.
  CHECK(refused(body, regular(0.5, 1.8, 0.0, 0.0), "hull.panel_length") == "");
  body.hull.panel_length = 5.0;
  CHECK_THAT(refused(body, regular(0.5, 1.8, 0.0, 0.0), "hull.panel_length"), Contains("do not resolve waves of 19."));
  body.hull.panel_length = 3.0;
  CHECK(refused(body, regular(0.5, 1.8, 0.0, 0.0), "hull.panel_length") == "");
  body.hull.panel_length = -1.0;
  CHECK_THAT(refused(body, kCalm, "hull"), Contains("panel length must be > 0"));
  body = barge(FroudeKrylov::pressure, kCog);
  body.hull.size.y() = 0.0;
  CHECK_THAT(refused(body, kCalm, "hull"), Contains("three sizes"));
  body.hull.shape = HullSpec::Shape::none;
  CHECK_THAT(refused(body, kCalm, "hull"), Contains("has no hull"));
  body.hull.shape = HullSpec::Shape::mesh;
  body.hull.mesh_file = "nowhere.stl";
  CHECK_THAT(refused(body, kCalm, "hull"), Contains("nowhere.stl: there is no such file"));
}

}  // namespace
}  // namespace stillhook
