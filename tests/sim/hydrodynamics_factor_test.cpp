// Factors on the coefficients of a hull: each scales its own part of the force and leaves the others alone.
#include <catch2/catch.hpp>

#include "sim/hull/hydrodynamics.h"
#include "tests/sim/coefficient_sets.h"

namespace stillhook {
namespace {

constexpr double kStep = 0.1;

std::shared_ptr<const WaveField> waves() {
  SeaStateSpec state;
  state.type = SeaStateSpec::Type::regular;
  state.amplitude = 1.0;
  state.frequency = 0.628;
  state.heading = 0.9;
  return std::make_shared<const WaveField>(build_wave_field(state, 9.80665, 0.0));
}

/// Radiation and diffraction forces after ten steps of a prescribed motion, and the added mass.
struct Outcome {
  VectorX radiation = VectorX(6), diffraction = VectorX(6);
  MatrixX mass = MatrixX::Zero(6, 6);
};

Outcome outcome_of(const HydrodynamicsSpec& factors, HydrodynamicsSpec::RadiationModel radiation) {
  BodySpec spec;
  spec.name = "crane";
  spec.hydrodynamics = factors;
  spec.hydrodynamics.kind = HydrodynamicsSpec::Kind::table;
  spec.hydrodynamics.radiation = radiation;
  const Mesh hull = box_mesh(Vector3(110.0, 46.0, 7.5), Vector3(0.0, 0.0, -0.25), 8.0);
  std::vector<std::string> warnings;
  const auto set = std::make_shared<const HydrodynamicCoefficients>(crane_set());
  const HydrodynamicsBody body{{&spec, &hull, 0.0, 0.0, 0.0, 0.0}, 0, Vector6::Zero()};
  const auto element = build_hydrodynamics({body}, set, waves(), {}, {}, warnings);
  std::vector<double> state(static_cast<std::size_t>(element->state_size())),
      scratch(static_cast<std::size_t>(element->scratch_size()));
  const Memory memory{state, scratch};
  std::vector<BodyKinematics> b(1);
  element->start({0.0, b, {}}, memory);
  for (int n = 1; n <= 10; ++n) {
    element->begin_step({(n - 1) * kStep, b, {}}, kStep, memory);
    b[0].v_WC = Vector3(0.3, -0.2, 0.5) * std::sin(0.7 * n);
    b[0].w_B = Vector3(0.02, 0.01, -0.03) * std::cos(0.5 * n);
    element->end_step({n * kStep, b, {}}, kStep, memory);
  }
  Outcome out;
  std::vector<double> channels(12);
  element->measure({10 * kStep, b, {}}, memory, channels);
  out.radiation = Eigen::Map<VectorX>(channels.data(), 6);
  out.diffraction = Eigen::Map<VectorX>(channels.data() + 6, 6);
  element->add_mass(out.mass, 0);
  return out;
}

void check_scaled(const VectorX& value, double factor, const VectorX& plain) {
  REQUIRE(plain.norm() > 1.0);
  CHECK((value - factor * plain).norm() < 1e-9 * plain.norm());
}

TEST_CASE("factors on added mass, radiation and diffraction", "[hydrodynamics][factor]") {
  using Radiation = HydrodynamicsSpec::RadiationModel;
  for (const Radiation model : {Radiation::retardation, Radiation::reduced}) {
    const Outcome plain = outcome_of({}, model);
    HydrodynamicsSpec h;
    h.added_mass_factor = 1.3;
    const Outcome heavier = outcome_of(h, model);
    CHECK((heavier.mass - 1.3 * plain.mass).norm() < 1e-9 * plain.mass.norm());
    check_scaled(heavier.radiation, 1.0, plain.radiation);
    check_scaled(heavier.diffraction, 1.0, plain.diffraction);
    h = {};
    h.radiation_factor = 0.6;
    const Outcome calmer = outcome_of(h, model);
    check_scaled(calmer.radiation, 0.6, plain.radiation);
    check_scaled(calmer.diffraction, 1.0, plain.diffraction);
    CHECK((calmer.mass - plain.mass).norm() == 0.0);
    h = {};
    h.diffraction_factor = -0.5;
    const Outcome turned = outcome_of(h, model);
    check_scaled(turned.diffraction, -0.5, plain.diffraction);
    check_scaled(turned.radiation, 1.0, plain.radiation);
  }
}

TEST_CASE("factors that are not physical are refused", "[hydrodynamics][factor]") {
  HydrodynamicsSpec h;
  h.added_mass_factor = 0.0;
  CHECK_THROWS_WITH(outcome_of(h, HydrodynamicsSpec::RadiationModel::reduced), Catch::Contains("added_mass_factor"));
  h = {};
  h.radiation_factor = -0.1;
  CHECK_THROWS_WITH(outcome_of(h, HydrodynamicsSpec::RadiationModel::reduced), Catch::Contains("radiation_factor"));
}

}  // namespace
}  // namespace stillhook
