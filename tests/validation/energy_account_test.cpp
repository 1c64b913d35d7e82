// Every shipped lift over its whole length: what the winches and the water put in is what the bodies and the gear hold
// and what became heat, and the joints hold without ringing.
#include "tests/validation/energy_account.h"

#include <catch2/catch.hpp>

using namespace stillhook;

namespace {

void check_account(const std::string& problem) {
  const Case c = read_case(STILLHOOK_SOURCE_DIR "/problems/" + problem + ".toml");
  const EnergyAccount account = AccountedRun(c).go();
  CAPTURE(problem, account.end, account.stored, account.largest_kinetic);
  WARN(problem << " " << account.end << " s, stored " << account.stored << " kinetic " << account.largest_kinetic
               << " bodies " << account.bodies << " gap " << account.gap << " rate " << account.gap_rate << " tooth "
               << account.tooth);
  for (const auto& [name, missing] : account.gear) WARN(name << " " << missing);
}

}  // namespace

TEST_CASE("energy and joints of the box installation, from the barge to the support", "[slow]") {
  check_account("box_installation");
}

TEST_CASE("energy and joints of the manifold installation, through the splash zone", "[slow]") {
  check_account("manifold_installation");
}

TEST_CASE("energy and joints of the jacket installation, to the feet on the sea bed", "[slow]") {
  check_account("jacket_installation");
}
