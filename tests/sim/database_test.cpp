#include "sim/hull/coefficients/database.h"

#include <catch2/catch.hpp>

#include "tests/sim/coefficient_sets.h"
#include "tests/sim/temporary_folder.h"

namespace stillhook {

TEST_CASE("a database is read by the ending of its name", "[database]") {
  const TemporaryFolder folder;
  const HydrodynamicCoefficients c = crane_set();
  DatabaseOptions options;
  options.frame.length = c.length;
  options.frame.bodies = {{Vector3::Zero(), c.volume[0]}};
  options.wamit.density = c.density;
  options.wamit.gravity = c.gravity;
  Matrix6 stiffness = Matrix6::Identity();
  stiffness(2, 2) = c.density * c.gravity * c.waterplane[0];
  write_coefficient_file(folder / "my.hull.csv", c);
  write_bemio(folder / "my.hull.H5", c, options.frame, {{"crane", Vector3(0, 0, 5), Vector3(0, 0, -2), stiffness}});
  write_wamit(folder / "my.hull", c, options.wamit, options.frame, {stiffness});
  for (const char* ending : {".csv", ".H5", ".1", ".3", ".hst"}) {
    INFO(ending);
    const HydrodynamicCoefficients back = read_database(folder / ("my.hull" + std::string(ending)), options);
    CHECK(difference(c.A_inf, back.A_inf) < 1e-7);  // nine digits
    CHECK(difference(c.excitation, back.excitation) < 1e-7);
    REQUIRE(back.waterplane.size() == 1);
    CHECK(back.waterplane[0] == Approx(c.waterplane[0]));
  }
  // From any to any: what came from HDF5 is written as text and read again.
  write_coefficient_file(folder / "again.csv", read_database(folder / "my.hull.H5", options));
  const HydrodynamicCoefficients again = read_database(folder / "again.csv");
  CHECK(difference(c.frequency[3].B, again.frequency[2].B) < 1e-7);
  CHECK(again.retardation.kernels.size() == c.retardation.kernels.size());
  CHECK_NOTHROW(require_self_checks(again));
}

TEST_CASE("a database of an unknown kind is refused with those that are known", "[database]") {
  for (const char* name : {"hull.out", "hull", "hull.nc", "folder.1/hull"})
    CHECK_THROWS_WITH(read_database(name), Catch::Contains(name) && Catch::Contains(".csv") &&
                                               Catch::Contains(".hst") && Catch::Contains(".h5 (BEMIO)"));
}

}  // namespace stillhook
