// The 95 % intervals hold the truth about 95 times of 100: 200 runs of the same decay with other noise each time.
#include <catch2/catch.hpp>

#include "tests/tuning/buoy.h"
#include "tuning/identification.h"

namespace stillhook {
namespace {

TEST_CASE("95 % intervals cover the truth in 90 to 99 % of 200 noisy runs", "[fit][slow]") {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, double>> truths = {
      {"bodies.buoy.hydrodynamics.added_mass_t.2", 600.0},
      {"bodies.buoy.hydrodynamics.linear_damping_kN_s_per_m.2", 60.0},
      {"bodies.buoy.hydrodynamics.quadratic_damping_kN_s2_per_m2.2", 150.0}};
  const Case truth = case_of(buoy_text());
  const Vector6 release = (Vector6() << 0.0, 0.0, 1.5, 0.0, 0.0, 0.0).finished();
  const int runs = 200;
  std::vector<int> covered(truths.size(), 0);
  double square_error = 0.0, square_sd = 0.0;
  for (int run = 0; run < runs; ++run) {
    const std::string file = folder.write(
        "decay.csv", measured(truth, {{"buoy.z", 0.03}}, release, 40.0, static_cast<unsigned>(1000 + run)));
    std::string fit = "[fit]\ncross_validate = false\n";
    for (const auto& [key, value] : truths) fit += parameter(key, 0.1 * value, 5.0 * value);
    fit += record("decay", file, "decay", "free_body = \"buoy\"\nfree = \"z, vz\"\n") + column("buoy.z", "m");
    const Identification r = identify(case_of(buoy_text() + fit));
    REQUIRE(r.trusted);
    for (std::size_t i = 0; i < truths.size(); ++i)
      covered[i] += r.estimates[i].low <= truths[i].second && truths[i].second <= r.estimates[i].high;
    square_error += std::pow(r.estimates[0].value - truths[0].second, 2) / runs;
    square_sd += std::pow(r.estimates[0].sd, 2) / runs;
  }
  for (std::size_t i = 0; i < truths.size(); ++i) {
    const double share = static_cast<double>(covered[i]) / runs;
    INFO(truths[i].first << ": " << 100.0 * share << " %");
    CHECK(share >= 0.90);
    CHECK(share <= 0.99);
  }
  INFO("scatter " << std::sqrt(square_error) << ", said " << std::sqrt(square_sd));
  CHECK(std::sqrt(square_sd / square_error) == Approx(1.0).margin(0.2));  // 200 runs know a scatter within 10 % at 95 %
}

}  // namespace
}  // namespace stillhook
