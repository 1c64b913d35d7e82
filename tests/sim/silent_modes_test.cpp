// Modes without radiation, of which codes leave rounding noise in their files.
#include "sim/hull/silent_modes.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "sim/hull/radiation/state_space_fit.h"
#include "tests/sim/coefficient_sets.h"

namespace stillhook {
namespace {

constexpr int kYaw = 5;

/// The crane hull with a yaw that a code has left as noise of `share` of the inertia of the displaced water.
HydrodynamicCoefficients with_noise(double share) {
  HydrodynamicCoefficients c = crane_set();
  const double m = displaced_inertia(c, kYaw);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::erase_if(c.retardation.kernels, [](const RetardationKernel& k) { return k.i == kYaw || k.j == kYaw; });
  const auto noisy = [&](MatrixX& M, double size) {
    for (int j = 0; j < 6; ++j) {
      M(kYaw, j) = 1e-3 * size * normal(random);
      M(j, kYaw) = 1e-3 * size * normal(random);
    }
    M(kYaw, kYaw) = size * normal(random);
  };
  noisy(c.A_inf, share * m);
  for (FrequencyCoefficients& f : c.frequency) {
    noisy(f.A, share * m);
    noisy(f.B, share * m * f.frequency);
  }
  for (std::size_t n = kYaw; n < c.excitation.value.size(); n += 6)
    c.excitation.value[n] = share * 1e6 * Complex(normal(random), normal(random));
  return c;
}

}  // namespace

TEST_CASE("a mode whose A and B are rounding noise has no radiation", "[silent_modes]") {
  const HydrodynamicCoefficients noisy = with_noise(1e-9);
  // As it comes: no sign, no symmetry.
  bool fails = false;
  for (const SelfCheck& check : self_checks(noisy)) fails |= !check.passed();
  CHECK(fails);
  const HydrodynamicCoefficients c = without_noise(noisy);
  for (const SelfCheck& check : self_checks(c)) {
    INFO(check.key << " " << check.value << " " << check.detail);
    CHECK(check.passed());
  }
  CHECK(c.A_inf.row(kYaw).isZero(0.0));
  const StateSpaceModel model = fit_state_space(c, {.tolerance = 0.03});
  for (const StateSpaceBlock& block : model.fit.blocks)
    CHECK(std::find(block.modes.begin(), block.modes.end(), kYaw) == block.modes.end());
  // The other modes are what they were.
  CHECK(c.A_inf.topLeftCorner<5, 5>() == noisy.A_inf.topLeftCorner<5, 5>());
  CHECK(c.frequency.back().B.topLeftCorner<5, 5>() == noisy.frequency.back().B.topLeftCorner<5, 5>());
}

TEST_CASE("weak radiation is no noise", "[silent_modes]") {
  // The crane hull's own yaw and roll, and noise a hundred times above the limit, stay.
  const std::vector<bool> own = silent_modes(crane_set());
  CHECK(std::none_of(own.begin(), own.end(), [](bool silent) { return silent; }));
  CHECK_FALSE(silent_modes(with_noise(1e-3))[kYaw]);
  CHECK(silent_modes(with_noise(1e-7))[kYaw]);
}

}  // namespace stillhook
