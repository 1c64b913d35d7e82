#include "sim/hull/parting_hydrodynamics.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "sim/hull/hydrodynamics.h"
#include "sim/multibody/hht.h"

namespace stillhook {
namespace {

constexpr int kParting = 2;

/// Two hulls of 1000 t added mass and 100 t/s damping, coupled in heave by `coupling` of both.
std::unique_ptr<const ForceElement> hulls(const std::vector<std::pair<std::string, int>>& bodies, double coupling) {
  const int modes = 6 * static_cast<int>(bodies.size());
  MatrixX A = 1e6 * MatrixX::Identity(modes, modes), B = 1e5 * MatrixX::Identity(modes, modes);
  if (modes == 12) {
    A(2, 8) = A(8, 2) = coupling * 1e6;
    B(2, 8) = B(8, 2) = coupling * 1e5;
  }
  std::vector<HydrodynamicsHull> parts;
  for (const auto& [name, body] : bodies) parts.push_back({name, HeadingFrame(body, Vector3::Zero(), 0.0), {}});
  return std::make_unique<const HydrodynamicsElement>(bodies[0].first + ".hydrodynamics", parts, A,
                                                      std::make_unique<ConstantRadiation>(B), nullptr);
}

std::unique_ptr<const ForceElement> parting(double coupling) {
  std::vector<std::unique_ptr<const ForceElement>> apart;
  apart.push_back(hulls({{"a", 0}}, 0.0));
  apart.push_back(hulls({{"b", 1}}, 0.0));
  return std::make_unique<const PartingHydrodynamics>(hulls({{"a", 0}, {"b", 1}}, coupling), std::move(apart),
                                                      kParting);
}

}  // namespace

TEST_CASE("coupled hulls push each other until they part", "[hydrodynamics]") {
  const auto element = parting(0.3);
  CHECK(element->mass_changes() == std::vector<int>{kParting});
  std::vector<double> state(element->state_size()), scratch(element->scratch_size());
  std::vector<BodyKinematics> bodies(2);
  bodies[0].v_WC = Vector3(0.0, 0.0, 1.0);
  for (const int phase : {0, kParting - 1, kParting, kParting + 3}) {
    const bool together = phase < kParting;
    const Instant now{0.0, bodies, {}, phase};
    element->start(now, {state, scratch});
    ForceSum force(2);
    element->add_forces(now, 0.0, {state, scratch}, force);
    CHECK(force.value()(2) == Approx(-1e5));
    CHECK(force.value()(8) == Approx(together ? -3e4 : 0.0));
    JacobianSum jacobian(2);
    element->add_jacobian(now, 0.0, {state, scratch}, jacobian);
    CHECK(jacobian.damping()(8, 2) == Approx(together ? -3e4 : 0.0));
    MatrixX M = MatrixX::Zero(12, 12);
    element->add_mass(M, phase);
    CHECK(M(2, 2) == Approx(1e6));
    CHECK(M(2, 8) == Approx(together ? 3e5 : 0.0));
    std::vector<double> out(24);
    element->measure(now, {state, scratch}, out);
    CHECK(out[2] == Approx(-1e5));
    CHECK(out[12 + 2] == Approx(together ? -3e4 : 0.0));
  }
}

TEST_CASE("hulls apart that are not those together are refused", "[hydrodynamics]") {
  std::vector<std::unique_ptr<const ForceElement>> apart;
  apart.push_back(hulls({{"b", 1}}, 0.0));
  CHECK_THROWS_AS(PartingHydrodynamics(hulls({{"a", 0}, {"b", 1}}, 0.3), std::move(apart), 1), std::invalid_argument);
}

TEST_CASE("the added mass of a later phase acts from its start", "[hydrodynamics][hht]") {
  // Two bodies of 1000 t; a weight on the first. Coupled, b is dragged along; apart, a falls alone with twice its mass.
  MultibodySystem system;
  system.bodies.push_back({"a", 1e6, 1e6 * Matrix3::Identity(), Vector3::Zero()});
  system.bodies.push_back({"b", 1e6, 1e6 * Matrix3::Identity(), Vector3::Zero()});
  system.gravity = 1.0;
  system.elements.push_back(parting(0.5));
  system.finish();
  CHECK(system.mass(0)(2, 8) == Approx(5e5));
  CHECK(system.mass(kParting)(2, 8) == 0.0);
  SystemState state;
  state.body.resize(2);
  state.acceleration = VectorX::Zero(12);
  state.lambda = VectorX::Zero(0);
  SystemWorkspace work = system.make_workspace();
  system.start_elements(state, work);
  HhtStepper stepper(system, {});
  stepper.start(state);
  const double h = 1e-3;
  for (int n = 0; n < 100; ++n) REQUIRE(stepper.step(state, h, {}));
  // (M + A) a = -W - B v with W = 1e6 each: both alike, 2.5e6 a = -1e6 - 1.5e5 v.
  CHECK(state.body[0].v_WC.z() == Approx(-1e6 / 1.5e5 * (1.0 - std::exp(-0.06 * 0.1))).epsilon(1e-5));
  const double v = state.body[0].v_WC.z();
  state.phase = kParting;
  for (int n = 0; n < 100; ++n) REQUIRE(stepper.step(state, h, {}));
  // 2e6 a = -1e6 - 1e5 v from there.
  const double end = -10.0 + (v + 10.0) * std::exp(-0.05 * 0.1);
  CHECK(state.body[0].v_WC.z() == Approx(end).epsilon(2e-3));
}

}  // namespace stillhook
