// The polar plot of the sea: its cells hold the energy of the sea, where the waves go.
#include "results/sea_polar.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>

#include "sim/sea/sea_statistics.h"

namespace stillhook {
namespace {

using Catch::Matchers::Contains;
using Type = SeaStateSpec::Type;

constexpr double kDegree = std::numbers::pi / 180.0, kTurn = 2.0 * std::numbers::pi;

SeaStateSpec jonswap(const char* name, double height, double period, double heading) {
  SeaStateSpec s;
  s.name = name;
  s.type = Type::jonswap;
  s.significant_height = height;
  s.peak_period = period;
  s.heading = heading;
  return s;
}

struct Told {
  double height = 0.0, heading = 0.0;  // m, rad, mean
  std::size_t ring = 0, sector = 0;    // of the largest density
};
Told told(const SeaStateSpec& state) {
  const SeaCells cells = sea_cells(state);
  double energy = 0.0, most = 0.0, x = 0.0, y = 0.0;
  Told t;
  for (std::size_t r = 0; r < cells.density.size(); ++r)
    for (std::size_t s = 0; s < cells.density[r].size(); ++s) {
      const double density = cells.density[r][s], b = kTurn / SeaCells::kSectors * static_cast<double>(s);
      energy += density * cells.ring * kTurn / SeaCells::kSectors;
      x += density * std::cos(b);
      y += density * std::sin(b);
      if (density > most) most = density, t.ring = r, t.sector = s;
    }
  t.height = 4.0 * std::sqrt(energy);
  t.heading = std::atan2(y, x);
  return t;
}

}  // namespace

TEST_CASE("the cells of the polar plot hold the energy of the sea about its heading", "[sea_polar]") {
  // The plot ends where two hundredths of the energy are left: a per cent of the height. Means over cells at four places
  // and the coarse sectors cost up to as much again.
  SECTION("spread, by either law, and long-crested") {
    SeaStateSpec s = jonswap("sea", 2.0, 8.0, 130.0 * kDegree);
    s.gamma = 3.3;
    s.directions = 7;
    for (const auto& [n, two_s] : {std::pair(4.0, 0.0), std::pair(0.0, 12.0), std::pair(0.0, 0.0)}) {
      s.spreading = n;
      s.spreading_2s = two_s;
      const Told t = told(s);
      CHECK(t.height == Approx(2.0).epsilon(0.02));
      CHECK(t.heading == Approx(130.0 * kDegree).margin(1e-3));
      CHECK(t.sector == 13);
    }
  }
  SECTION("systems add") {
    SeaStateSpec sum;
    sum.name = "sum";
    sum.type = Type::sum;
    sum.parts = {jonswap("swell", 2.0, 14.0, 30.0 * kDegree), jonswap("wind", 1.5, 6.0, 120.0 * kDegree)};
    const Told t = told(sum);
    CHECK(t.height == Approx(2.5).epsilon(0.02));
    CHECK(t.sector == 3);
    // The swell's energy is 4 to 2.25, at right angles.
    CHECK(t.heading == Approx(30.0 * kDegree + std::atan2(2.25, 4.0)).margin(0.02));
  }
  SECTION("a 2-D spectrum") {
    auto d = std::make_shared<DirectionalSpectrum>();
    for (int i = 0; i < 40; ++i) d->frequency.push_back(0.3 + 0.05 * i);
    for (int j = 0; j < 24; ++j) d->heading.push_back(kTurn / 24.0 * j);
    for (int i = 0; i < 40; ++i)
      for (int j = 0; j < 24; ++j) {
        const double off = std::remainder(d->heading[j] - 1.2, kTurn);
        d->density.push_back(std::exp(-std::pow((d->frequency[i] - 0.9) / 0.15, 2)) * std::exp(2.0 * std::cos(off)));
      }
    SeaStateSpec s;
    s.name = "file";
    s.type = Type::spectrum;
    s.spectrum = d;
    const SeaStatistics truth = sea_statistics(s).back();
    const Told t = told(s);
    CHECK(t.height == Approx(truth.significant_height).epsilon(0.02));
    CHECK(t.heading == Approx(truth.heading).margin(0.01));
  }
}

TEST_CASE("the polar plot names the systems of a sea, and a calm or regular sea has none", "[sea_polar]") {
  Specification spec;
  spec.name = "lift";
  SeaStateSpec sum;
  sum.name = "crossed";
  sum.type = Type::sum;
  sum.parts = {jonswap("swell", 2.0, 14.0, 0.0), jonswap("wind <sea>", 1.5, 6.0, 1.0)};
  SeaStateSpec wave;
  wave.name = "wave";
  wave.type = Type::regular;
  wave.amplitude = 0.4;
  wave.frequency = 0.7;
  sum.parts.push_back(wave);
  spec.sea.states = {sum, wave};
  CHECK(draw_sea_polar(spec).empty());
  spec.sea.active = "wave";
  CHECK(draw_sea_polar(spec).empty());
  spec.sea.active = "crossed";
  const std::string svg = draw_sea_polar(spec, 0.5);
  CHECK_THAT(svg, Contains("swell") && Contains("wind &lt;sea&gt;") && Contains("Hs 2.00 m, Tp 14.0 s"));
  CHECK_THAT(svg, Contains("H 0.80 m, T 9.0 s") && Contains(">N</text>"));
  CHECK(svg.find("nan") == std::string::npos);
}

}  // namespace stillhook
