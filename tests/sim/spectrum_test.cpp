#include "sim/body_spec.h"

#include "sim/sea/spectrum.h"
#include "sim/error.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

namespace stillhook {
namespace {

constexpr double kPi = std::numbers::pi;

SeaStateSpec jonswap(double hs, double tp, double gamma) {
  SeaStateSpec s;
  s.name = "storm";
  s.type = SeaStateSpec::Type::jonswap;
  s.significant_height = hs;
  s.peak_period = tp;
  s.gamma = gamma;
  return s;
}

// Simpson's rule for int w^n S dw between multiples of the peak frequency.
double moment(const SeaStateSpec& s, int n, double from, double to) {
  const double wp = 2.0 * kPi / s.peak_period;
  const int steps = 40000;
  const double h = (to - from) * wp / steps;
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double w = from * wp + i * h;
    sum += (i == 0 || i == steps ? 1.0 : i % 2 ? 4.0 : 2.0) * std::pow(w, n) * spectral_density(s, w);
  }
  return sum * h / 3.0;
}

TEST_CASE("JONSWAP at its peak has the closed form, Pierson-Moskowitz integrates to Hs^2/16") {
  const double hs = 3.0, tp = 10.0, wp = 2.0 * kPi / tp;
  // At the peak g^b = g and the Pierson-Moskowitz part is 5/16 Hs^2/wp exp(-5/4). Rounding only.
  const double peak = 5.0 / 16.0 * hs * hs / wp * std::exp(-1.25);
  CHECK(spectral_density(jonswap(hs, tp, 3.3), wp) ==
        Approx(peak * 3.3 * (1.0 - 0.287 * std::log(3.3))).epsilon(1e-13));
  SeaStateSpec pm = jonswap(hs, tp, 3.3);
  pm.type = SeaStateSpec::Type::pierson_moskowitz;
  CHECK(spectral_density(pm, wp) == Approx(peak).epsilon(1e-13));
  // int S dw up to W is Hs^2/16 exp(-1.25 (wp/W)^4); Simpson with 40,000 steps is far below 1e-9.
  CHECK(moment(pm, 0, 0.1, 8.0) == Approx(hs * hs / 16.0 * std::exp(-1.25 / std::pow(8.0, 4))).epsilon(1e-9));
  CHECK(spectral_density(pm, 0.0) == 0.0);
  CHECK(spectral_density(pm, -1.0) == 0.0);
  // The factor 1 - 0.287 ln g is a fit, good to about 1.5 % in energy (DNV-RP-C205, 3.5.5).
  for (const double gamma : {1.0, 2.0, 3.3, 5.0})
    CHECK(moment(jonswap(hs, tp, gamma), 0, 0.1, 8.0) == Approx(hs * hs / 16.0).epsilon(0.015));
}

TEST_CASE("the default peakedness follows the rule of Hs and Tp") {
  CHECK(default_gamma(4.0, 6.0) == 5.0);   // Tp/sqrt(Hs) = 3.0
  CHECK(default_gamma(4.0, 12.0) == 1.0);  // 6.0
  // exp(5.75 - 1.15 * 4.3) = exp(0.805)
  CHECK(default_gamma(4.0, 8.6) == Approx(2.236696499).epsilon(1e-9));
  const SeaStateSpec automatic = jonswap(4.0, 8.6, 0.0);
  CHECK(spectral_density(automatic, 0.7) ==
        Approx(spectral_density(jonswap(4.0, 8.6, default_gamma(4.0, 8.6)), 0.7)).epsilon(1e-14));
}

TEST_CASE("draws by index are the same bits everywhere") {
  // The same hash written in Python with unbounded integers.
  CHECK(portable_uniform(1, 1, 0) == 0x1.aa2b36e686544p-1);
  CHECK(portable_uniform(1, 1, 1) == 0x1.e5c384c3431dcp-2);
  CHECK(portable_uniform(7, 2, 59) == 0x1.094b7fcd28ff8p-2);
  double sum = 0.0, squares = 0.0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double u = portable_uniform(3, 1, i);
    REQUIRE((u >= 0.0 && u < 1.0));
    sum += u;
    squares += u * u;
  }
  // Standard deviations of the means: sqrt(1/12/n) = 0.0020, sqrt(4/45/n) = 0.0021; four of them.
  CHECK(std::abs(sum / n - 1.0 / 2.0) < 0.008);
  CHECK(std::abs(squares / n - 1.0 / 3.0) < 0.0085);
}

TEST_CASE("components carry the energy where the spectrum has it") {
  SeaStateSpec s = jonswap(2.5, 9.0, 3.3);
  s.seed = 4;
  const auto waves = spectrum_components(s, 9.81);
  REQUIRE(waves.size() == 60);
  double m0 = 0.0, m1 = 0.0, m2 = 0.0, below_peak = 0.0;
  const double wp = 2.0 * kPi / s.peak_period;
  for (const auto& c : waves) {
    const double e = 0.5 * c.amplitude * c.amplitude;
    m0 += e;
    m1 += e * c.frequency;
    m2 += e * c.frequency * c.frequency;
    below_peak += c.frequency < wp ? e : 0.0;
    CHECK(c.wavenumber == Approx(c.frequency * c.frequency / 9.81).epsilon(1e-14));
    CHECK(c.phase >= 0.0);
    CHECK(c.phase < 2.0 * kPi);
  }
  CHECK(m0 == Approx(2.5 * 2.5 / 16.0).epsilon(1e-12));
  const double all = moment(s, 0, 0.3, 4.0);
  // One frequency stands for half of its bin, so single moments scatter by about 1/60 of the spread within a bin.
  CHECK(m1 / m0 == Approx(moment(s, 1, 0.3, 4.0) / all).epsilon(0.005));
  CHECK(m2 / m0 == Approx(moment(s, 2, 0.3, 4.0) / all).epsilon(0.01));
  // Energy below the peak: to one component.
  CHECK(std::abs(below_peak / m0 - moment(s, 0, 0.3, 1.0) / all) < 1.0 / 60.0);
}

TEST_CASE("a seed gives a sea, another seed another, and none repeats within three hours") {
  for (const int count : {30, 60, 120}) {
    SeaStateSpec s = jonswap(2.0, 10.0, 2.0);
    s.components = count;
    s.seed = 11;
    const auto a = spectrum_components(s, 9.81), again = spectrum_components(s, 9.81);
    s.seed = 12;
    const auto b = spectrum_components(s, 9.81);
    int same = 0;
    for (int i = 0; i < count; ++i) {
      CHECK(a[i].phase == again[i].phase);
      CHECK(a[i].amplitude == b[i].amplitude);
      same += a[i].phase == b[i].phase;
    }
    CHECK(same == 0);
    // Autocorrelation of the elevation, 1 if the sea repeats. Of n components with unrelated frequencies it is about
    // normal with deviation sqrt(1/(2n)); of 3 h in steps of 1 s hold 4.5 deviations, and 0.5 more for what the bins
    // of a smooth spectrum have in common.
    double worst = 0.0;
    for (double lag = 300.0; lag <= 10800.0; lag += 1.0) {
      double sum = 0.0;
      for (const auto& c : a) sum += std::cos(c.frequency * lag);
      worst = std::max(worst, sum / count);
    }
    CHECK(worst < 5.0 * std::sqrt(0.5 / count));
  }
}

TEST_CASE("a short-crested sea spreads as cos^n and shares no frequency between directions") {
  SeaStateSpec s = jonswap(2.0, 10.0, 2.0);
  s.heading = 0.7;
  s.spreading = 2.0;
  s.directions = 9;
  s.components = 40;
  const auto waves = spectrum_components(s, 9.81);
  REQUIRE(waves.size() == 360);
  double energy = 0.0, along = 0.0, across = 0.0, cos2 = 0.0;
  std::set<double> frequencies, headings;
  for (const auto& c : waves) {
    const double e = c.amplitude * c.amplitude;
    const double delta = std::atan2(c.sin_heading, c.cos_heading) - s.heading;
    energy += e;
    along += e * std::cos(delta);
    across += e * std::sin(delta);
    cos2 += e * std::cos(2.0 * delta);
    frequencies.insert(c.frequency);
    headings.insert(std::round(delta * 1e9));
  }
  CHECK(frequencies.size() == 360);
  CHECK(headings.size() == 9);
  CHECK(energy / 2.0 == Approx(4.0 / 16.0).epsilon(1e-12));
  // Equal numbers on both sides: rounding only.
  CHECK(std::abs(across / energy) < 1e-6);
  // With D = (2/pi) cos^2: mean of cos is 8/(3 pi), of cos 2x is 1/2. Nine medians leave out the spread within a bin of
  // equal energy: a variance of about w^2/12 each, w = 0.2 rad in the middle and 0.6 at the two ends, 0.01 rad^2 on the
  // mean, which raises the two means by half of it and by twice it (times cos 2x).
  CHECK(along / energy == Approx(8.0 / (3.0 * kPi)).epsilon(0.015));
  CHECK(cos2 / energy == Approx(0.5).epsilon(0.04));
}

TEST_CASE("a sea that cannot be is refused by name") {
  const auto refused = [](SeaStateSpec s, const std::string& field) {
    try {
      build_wave_field(s, 9.81, 10.0);
    } catch (const SpecificationError& e) {
      return e.entry == "sea.states.storm" && e.field == field;
    }
    return false;
  };
  SeaStateSpec s = jonswap(2.0, 8.0, 0.0);
  CHECK_NOTHROW(build_wave_field(s, 9.81, 10.0));
  s.significant_height = 0.0;
  CHECK(refused(s, "significant_height"));
  s = jonswap(2.0, -1.0, 0.0);
  CHECK(refused(s, "peak_period"));
  s = jonswap(2.0, std::nan(""), 0.0);
  CHECK(refused(s, "peak_period"));
  s = jonswap(2.0, 8.0, 0.5);
  CHECK(refused(s, "gamma"));
  s = jonswap(2.0, 8.0, 0.0);
  s.components = 0;
  CHECK(refused(s, "components"));
  s.components = 2000;
  CHECK(refused(s, "components"));
  s = jonswap(2.0, 8.0, 0.0);
  s.directions = 5;
  CHECK(refused(s, "directions"));
  s.directions = 1;
  s.spreading = 4.0;
  CHECK(refused(s, "directions"));
  s = jonswap(2.0, 8.0, 0.0);
  s.type = SeaStateSpec::Type::regular;
  s.amplitude = 1.0;
  s.frequency = 0.0;
  CHECK(refused(s, "frequency"));
  s.frequency = 2.0;  // 15.4 m long and 2 m high does not break, 3 m does
  CHECK_NOTHROW(build_wave_field(s, 9.81, 10.0));
  s.amplitude = 1.5;
  CHECK(refused(s, "amplitude"));
}

}  // namespace
}  // namespace stillhook
