// Every shipped lift over its whole length: what the winches and the water put in is what the bodies and the gear hold
// and what became heat, and the joints hold without ringing.
#include "tests/validation/energy_account.h"

#include <catch2/catch.hpp>

using namespace stillhook;

namespace {

// The trapezoidal rule leaves (w h)^2 / 12 of what oscillates, and the integrator's damping takes the fastest swings:
// of the largest store a hundredth at most over the whole of a lift, which a spring, a winch or a joint with a wrong
// sign or a missing term exceeds many times.
constexpr double kShare = 0.01;

EnergyAccount check_account(const std::string& problem) {
  const Case c = read_case(STILLHOOK_SOURCE_DIR "/problems/" + problem + ".toml");
  const EnergyAccount account = AccountedRun(c).go();
  CAPTURE(problem, account.end, account.stored, account.largest_kinetic);
  CHECK(account.stored > 1e7);  // J: hundreds of tonnes are raised and lowered by metres
  CHECK(account.bodies < kShare * account.stored);
  CHECK(account.gear.size() > 8);
  for (const auto& [name, missing] : account.gear) {
    CAPTURE(name);
    CHECK(missing < kShare * account.stored);
  }
  // The joints are closed in every step to Newton's tolerance, 1e-7 g over h^2, and rounding of coordinates of 100 m.
  CHECK(account.gap < 1e-7);
  // Their rates follow to second order in the step: h^2/12 of the third derivative of motions of some metres in
  // seconds.
  CHECK(account.gap_rate < 1e-2);
  return account;
}

// A tenth of a per cent of a load of 1,000 t: the multipliers of an integrator without damping ring by a hundred times
// that, and those of a Newton iteration that looks at accelerations alone by forty times that.
constexpr double kTooth = 1e4;  // N, N m

}  // namespace

TEST_CASE("energy and joints of the box installation, from the barge to the support", "[slow]") {
  CHECK(check_account("box_installation").tooth < kTooth);
}

TEST_CASE("energy and joints of the manifold installation, through the splash zone", "[slow]") {
  CHECK(check_account("manifold_installation").tooth < kTooth);
}

TEST_CASE("energy and joints of the jacket installation, to the feet on the sea bed", "[slow]") {
  CHECK(check_account("jacket_installation").tooth < kTooth);
}
