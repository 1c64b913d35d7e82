// Seas of several systems of waves, their shapes and spreads, and what is said of them in numbers.
#include "sim/body_spec.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "sim/error.h"
#include "sim/sea/sea_statistics.h"
#include "sim/sea/spectrum.h"

namespace stillhook {
namespace {

using Type = SeaStateSpec::Type;
constexpr double kG = 9.80665, kDeg = std::numbers::pi / 180.0;

SeaStateSpec part(const std::string& name, Type type, double height, double period, double heading_deg) {
  SeaStateSpec s;
  s.name = name;
  s.type = type;
  s.significant_height = height;
  s.peak_period = period;
  s.heading = heading_deg * kDeg;
  return s;
}

SeaStateSpec swell_across_wind_sea() {
  SeaStateSpec s;
  s.name = "crossed";
  s.type = Type::sum;
  s.seed = 7;
  s.parts = {part("swell", Type::jonswap, 2.0, 14.0, 30.0), part("wind_sea", Type::ochi_hubble, 1.5, 6.0, 120.0)};
  s.parts[0].gamma = 7.0;
  s.parts[1].spreading_2s = 8.0;
  s.parts[1].directions = 9;
  s.parts[1].components = 30;
  return s;
}

double height_of(const std::vector<WaveComponent>& waves) {
  double variance = 0.0;
  for (const WaveComponent& c : waves) variance += 0.5 * c.amplitude * c.amplitude;
  return 4.0 * std::sqrt(variance);
}

TEST_CASE("Ochi and Hubble's spectrum has the densities and the height of its formula") {
  // At the modal frequency, Hs = 1 m, wm = 1 rad/s, shape 1, 3, 6: six figures of the formula evaluated elsewhere.
  const double truth[][2] = {{1.0, 0.0895327}, {3.0, 0.166381}, {6.0, 0.239717}};
  for (const auto& [lambda, density] : truth) {
    SeaStateSpec s = part("swell", Type::ochi_hubble, 1.0, 2.0 * std::numbers::pi, 0.0);
    s.lambda = lambda;
    CHECK(spectral_density(s, 1.0) == Approx(density).epsilon(3e-6));  // half of the last figure
    double m0 = 0.0, m1 = 0.0;
    for (int i = 0; i < 400000; ++i) {
      const double w = (i + 0.5) * 1e-4;
      m0 += spectral_density(s, w) * 1e-4;
      m1 += w * spectral_density(s, w) * 1e-4;
    }
    CHECK(m0 == Approx(1.0 / 16.0).epsilon(1e-6));  // above 40 rad/s: 5e-7 of shape 1
    CHECK(sea_statistics(s)[0].mean_period == Approx(2.0 * std::numbers::pi * m0 / m1).epsilon(1e-4));
    CHECK(height_of(spectrum_components(s, kG)) == Approx(1.0).epsilon(1e-12));
  }
  // Shape 1 is Pierson and Moskowitz's.
  const SeaStateSpec one = part("a", Type::ochi_hubble, 2.3, 9.0, 0.0),
                     pm = part("b", Type::pierson_moskowitz, 2.3, 9.0, 0.0);
  for (const double w : {0.4, 0.698, 1.1, 2.0})
    CHECK(spectral_density(one, w) == Approx(spectral_density(pm, w)).epsilon(1e-12));
}

TEST_CASE("mean periods of JONSWAP seas are those of the untruncated spectrum") {
  // T01/Tp and Tz/Tp by quadrature elsewhere, six figures.
  const double truth[][3] = {{1.0, 0.771771, 0.710371}, {3.3, 0.834328, 0.777399}, {5.0, 0.858344, 0.805286}};
  for (const auto& [gamma, mean, crossing] : truth) {
    SeaStateSpec s = part("sea", Type::jonswap, 2.0, 10.0, 0.0);
    s.gamma = gamma;
    const SeaStatistics found = sea_statistics(s).back();
    CHECK(found.mean_period / 10.0 == Approx(mean).epsilon(1e-5));
    CHECK(found.zero_crossing_period / 10.0 == Approx(crossing).epsilon(1e-5));
    CHECK(found.significant_height == Approx(2.0).epsilon(1e-12));
    CHECK(found.peak_period == Approx(10.0).epsilon(1e-12));
    CHECK(found.spread == 0.0);
  }
}

TEST_CASE("the circular spread of both laws") {
  // First Fourier moment of cos^n within 90 deg and of cos^2s(theta/2), a1 = s/(s + 1) (Kuik et al. 1988); deg.
  const double cos_n[][2] = {
      {2.0, 31.504722661318844}, {4.0, 24.920069688830385}, {6.0, 21.24062330174898}, {10.0, 17.069472165785687}};
  for (const auto& [n, degrees] : cos_n) CHECK(circular_spread_cos_n(n) / kDeg == Approx(degrees).epsilon(1e-12));
  const double cos_2s[][2] = {{5.0, 33.0797}, {15.0, 20.2571}, {40.0, 12.6545}};
  for (const auto& [s, degrees] : cos_2s) CHECK(circular_spread_cos_2s(s) / kDeg == Approx(degrees).epsilon(2e-6));
}

TEST_CASE("waves spread over the whole circle have the mean direction and spread of their law") {
  SeaStateSpec s = part("sea", Type::jonswap, 2.0, 10.0, 40.0);
  s.spreading_2s = 3.0;
  s.directions = 31;
  s.components = 20;
  std::complex<double> sum = 0.0;
  bool behind = false;
  const auto waves = spectrum_components(s, kG);
  for (const WaveComponent& c : waves) {
    sum += std::complex<double>(c.cos_heading, c.sin_heading) / static_cast<double>(waves.size());
    behind |= c.cos_heading * std::cos(s.heading) + c.sin_heading * std::sin(s.heading) < 0.0;
  }
  CHECK(behind);  // cos^6 of half the angle holds 3 % beyond 90 deg
  CHECK(std::arg(sum) == Approx(s.heading).epsilon(1e-6));
  // Medians of 31 parts of equal energy leave out the spread within a part: 0.05 rad on the mean, more at the ends.
  CHECK(std::abs(sum) == Approx(3.0 / 4.0).epsilon(0.01));
  CHECK(sea_statistics(s)[0].spread == Approx(circular_spread_cos_2s(3.0)).epsilon(1e-12));
}

TEST_CASE("a sum has the energy of its parts and the waves of each") {
  const SeaStateSpec sum = swell_across_wind_sea();
  const WaveField field = build_wave_field(sum, kG, 20.0, 45.0);
  CHECK(height_of(field.components()) == Approx(2.5).epsilon(1e-12));  // sqrt(2.0^2 + 1.5^2)
  REQUIRE(field.components().size() == 60 + 270);
  // The first part is what it is alone with the sum's seed; the second has the next one.
  SeaStateSpec alone = sum.parts[0];
  alone.seed = 7;
  const WaveField swell = build_wave_field(alone, kG, 20.0, 45.0);
  for (std::size_t i = 0; i < 60; ++i) CHECK(field.components()[i] == swell.components()[i]);
  const std::vector<SeaStatistics> told = sea_statistics(sum);
  REQUIRE(told.size() == 3);
  CHECK(told[0].name == "swell");
  CHECK(told[1].name == "wind_sea");
  CHECK(told[2].significant_height == Approx(2.5).epsilon(1e-12));
  CHECK(told[2].peak_period == Approx(14.0).epsilon(2e-3));  // the grid of the search, and the tail of the other
  // Energies 4 and 2.25 (a1 8/9) at 30 and 120 deg.
  CHECK(told[2].heading / kDeg == Approx(30.0 + std::atan2(2.25 * 8.0 / 9.0, 4.0) / kDeg).epsilon(1e-9));
  const double a1 = std::hypot(4.0, 2.25 * 8.0 / 9.0) / 6.25;
  CHECK(told[2].spread == Approx(std::sqrt(2.0 * (1.0 - a1))).epsilon(1e-9));
  // Tz of the whole: second moments add.
  const double m2 = 4.0 / std::pow(told[0].zero_crossing_period, 2) + 2.25 / std::pow(told[1].zero_crossing_period, 2);
  CHECK(told[2].zero_crossing_period == Approx(std::sqrt(6.25 / m2)).epsilon(1e-9));
}

TEST_CASE("a seed of its own keeps one part of a sum while the others vary, and no two parts share phases") {
  SeaStateSpec sum = swell_across_wind_sea();
  sum.parts.push_back(sum.parts[0]);
  sum.parts[2].name = "other_swell";
  sum.parts[0].part_seed = sum.parts[2].part_seed = 3;  // the same number
  const WaveField a = build_wave_field(sum, kG, 20.0);
  sum.seed = 8;
  const WaveField b = build_wave_field(sum, kG, 20.0);
  int same = 0, shared = 0;
  for (std::size_t i = 0; i < 60; ++i) {
    CHECK(a.components()[i] == b.components()[i]);
    shared += a.components()[i].phase == a.components()[330 + i].phase;
  }
  for (std::size_t i = 60; i < 330; ++i) same += a.components()[i].phase == b.components()[i].phase;
  CHECK(same == 0);
  CHECK(shared == 0);
}

TEST_CASE("a regular wave may be a part") {
  SeaStateSpec sum = swell_across_wind_sea();
  SeaStateSpec wave;
  wave.name = "wave";
  wave.type = Type::regular;
  wave.amplitude = 0.5;
  wave.frequency = 0.4;
  sum.parts.push_back(wave);
  // Hs of a sine is 4 a / sqrt 2.
  CHECK(height_of(build_wave_field(sum, kG, 0.0).components()) == Approx(std::sqrt(6.25 + 2.0)).epsilon(1e-12));
  CHECK(sum.seeded());
  sum.parts = {wave};
  CHECK_FALSE(sum.seeded());
  CHECK(sea_statistics(sum).back().peak_period == Approx(2.0 * std::numbers::pi / 0.4));
}

TEST_CASE("sums that cannot be are refused by name") {
  const auto refusal = [](const SeaStateSpec& s) -> std::string {
    try {
      build_wave_field(s, kG, 10.0);
    } catch (const SpecificationError& error) {
      return error.what();
    }
    return "";
  };
  using Catch::Matchers::Contains;
  SeaStateSpec s = swell_across_wind_sea();
  CHECK(refusal(s).empty());
  s.parts[1].significant_height = -1.0;
  CHECK_THAT(refusal(s), Contains("sea.states.crossed.parts.wind_sea.significant_height: must be > 0 m"));
  s = swell_across_wind_sea();
  s.parts[1].spreading = 2.0;
  CHECK_THAT(refusal(s), Contains("parts.wind_sea.spreading_2s: cannot stand beside spreading"));
  s = swell_across_wind_sea();
  s.parts[1].lambda = 0.4;
  CHECK_THAT(refusal(s), Contains("parts.wind_sea.lambda: must lie between 0.7 and 30"));
  s = swell_across_wind_sea();
  s.parts[0].type = Type::sum;
  CHECK_THAT(refusal(s), Contains("sea.states.crossed.parts: calm water, a record and a sum cannot be parts of a sum"));
  s.parts.clear();
  CHECK_THAT(refusal(s), Contains("needs at least one part"));
  s = swell_across_wind_sea();
  s.parts[0].components = 1000;
  CHECK_THAT(refusal(s), Contains("1270 waves together, at most"));
}

}  // namespace
}  // namespace stillhook
