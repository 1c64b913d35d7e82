// The wind over the height and its gusts, against closed forms.
#include "sim/environment/gusts.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "sim/environment/stream.h"
#include "sim/error.h"
#include "sim/spatial/constants.h"

using namespace stillhook;

namespace {

WindSpec gusty(double speed, WindSpec::Gusts gusts = WindSpec::Gusts::npd) {
  WindSpec wind;
  wind.speed = speed;
  wind.to = 0.3;
  wind.gusts = gusts;
  return wind;
}

double mean_at(const WindSpec& wind, double z) { return wind_speed(wind, z, Instant()).value; }

/// The formulae of NPD, evaluated elsewhere, to six digits.
struct NpdTruth {
  double speed, height;                                      // m/s, m
  double mean, minute, three_seconds, density, total, band;  // m/s; m2/s2/Hz at 0.01 Hz; m/s of all f and of the band
};
const std::vector<NpdTruth> kNpd = {{10, 10, 10, 11.4403, 12.4941, 16.7653, 1.02728, 0.871435},
                                    {15, 50, 17.4823, 19.5151, 21.0025, 35.7774, 1.50692, 1.2292},
                                    {20, 100, 25.2511, 28.1015, 30.1871, 66.215, 2.07621, 1.66153}};
constexpr double kSixDigits = 5e-6;

}  // namespace

TEST_CASE("means and gusts over the height are those of ISO 19901-1", "[wind]") {
  for (const NpdTruth& t : kNpd) {
    const WindSpec wind = gusty(t.speed);
    CHECK(mean_at(wind, t.height) == Approx(t.mean).epsilon(kSixDigits));
    CHECK(gust_speed(wind, t.height, 60.0) == Approx(t.minute).epsilon(kSixDigits));
    CHECK(gust_speed(wind, t.height, 3.0) == Approx(t.three_seconds).epsilon(kSixDigits));
    CHECK(gust_speed(wind, t.height, 3600.0) == Approx(t.mean).epsilon(kSixDigits));
  }
  WindSpec power = gusty(10.0);
  power.profile = WindSpec::Profile::power;
  CHECK(mean_at(power, 80.0) == Approx(10.0 * std::pow(8.0, 0.12)).epsilon(1e-12));
  CHECK(mean_at(gusty(10.0), 0.2) == Approx(mean_at(gusty(10.0), 1.0 + 1e-9)).epsilon(1e-9));
}

TEST_CASE("the NPD spectrum and what of it is simulated are as published", "[wind]") {
  for (const NpdTruth& t : kNpd) {
    const WindSpec wind = gusty(t.speed);
    CHECK(gust_density(wind, 0.01, t.height) == Approx(t.density).epsilon(kSixDigits));
    CHECK(gust_deviation(wind, t.height) == Approx(t.band).epsilon(1e-5));
    // All frequencies, by the trapezoidal rule in ln f; the tail falls as f^-5/3, whose rest above 1e12 Hz is 1e-8.
    double sum = 0.0;
    const double step = 0.01;
    for (double x = std::log(1e-12); x < std::log(1e12); x += step)
      sum += step * std::exp(x) * gust_density(wind, std::exp(x), t.height);
    CHECK(std::sqrt(sum) == Approx(t.total).epsilon(kSixDigits));
  }
}

TEST_CASE("the spectra of API and Kaimal hold the variance that they name", "[wind]") {
  // int S df = s^2 for API (truth N_api) and (for 6 x in place of 1.5 x: 4/(6 x 2/3) = 1) for Kaimal; the peak of f S
  // of the API spectrum lies at fp.
  for (const WindSpec::Gusts kind : {WindSpec::Gusts::api, WindSpec::Gusts::kaimal}) {
    WindSpec wind = gusty(12.0, kind);
    wind.turbulence = 0.13;
    double sum = 0.0;
    const double step = 0.01, z = 30.0;
    for (double x = std::log(1e-9); x < std::log(1e12); x += step)
      sum += step * std::exp(x) * gust_density(wind, std::exp(x), z);
    CHECK(std::sqrt(sum) == Approx(0.13 * mean_at(wind, z)).epsilon(1e-6));
  }
  const WindSpec api = gusty(12.0, WindSpec::Gusts::api);
  const double z = 30.0, peak = 0.025 * mean_at(api, z) / z;
  const auto energy = [&](double f) { return f * gust_density(api, f, z); };
  CHECK(energy(peak) > energy(1.01 * peak));
  CHECK(energy(peak) > energy(0.99 * peak));
  CHECK(gust_density(api, 0.05, z) * std::pow(turbulence_intensity(api, z) * mean_at(api, z), -2) * peak ==
        Approx(std::pow(1.0 + 1.5 * 0.05 / peak, -5.0 / 3.0)).epsilon(1e-12));
}

TEST_CASE("components carry the band's variance at every height", "[wind]") {
  // At the nodes exactly; between them the cubic over a factor of two in height leaves less than 0.05 % of NPD and API.
  // Below 4 m, where the cubic ends and the mean wind stops falling at 1 m, it is 0.5 %.
  // Kaimal's length stops growing at 60 m: the cubic rounds that corner, by less than 0.5 % of the deviation.
  for (const auto& [kind, tolerance] :
       {std::pair(WindSpec::Gusts::npd, 5e-4), {WindSpec::Gusts::api, 5e-4}, {WindSpec::Gusts::kaimal, 5e-3}}) {
    const WindSpec wind = gusty(15.0, kind);
    const Gusts gusts(wind, 4, 0.0);
    REQUIRE(gusts.frequencies().size() == 200);
    CHECK(gusts.frequencies().front() >= kTwoPi / 600.0);
    CHECK(gusts.frequencies().back() <= kTwoPi * 0.5);
    for (const double z : {1.2, 3.0, 7.5, 10.0, 21.0, 44.0, 60.0, 85.0, 170.0}) {
      double variance = 0.0;
      for (std::size_t j = 0; j < gusts.frequencies().size(); ++j) variance += 0.5 * std::pow(gusts.amplitude(j, z), 2);
      const double wanted = gust_deviation(wind, z);
      CAPTURE(z, static_cast<int>(kind));
      CHECK(std::sqrt(variance) == Approx(wanted).epsilon(z == 7.5 || z == 60.0 ? 1e-5
                                                          : z < 4.0             ? std::max(5e-3, tolerance)
                                                                                : tolerance));
    }
  }
}

TEST_CASE("gusts in time have the deviation and the spectrum that they come from", "[wind]") {
  // 60 h in steps of 1 s at 10 m: 60 of the longest gusts an hour or so; the deviation is known to 1 %.
  const WindSpec wind = gusty(10.0);
  const Gusts gusts(wind, 7, 0.0);
  std::vector<double> memory(Gusts::kMemory, 0.0);
  double sum = 0.0, square = 0.0;
  const int n = 216000;
  for (int i = 0; i < n; ++i) {
    Instant now;
    now.t = i;
    const double u = gusts.at(10.0, now, memory).value;
    sum += u;
    square += u * u;
  }
  CHECK(std::sqrt(square / n) == Approx(0.871435).epsilon(0.01));
  CHECK(std::abs(sum / n) < 0.01);
}

TEST_CASE("gusts come from the seed, begin with the run, and are the same when asked again", "[wind]") {
  const WindSpec wind = gusty(10.0);
  const Gusts gusts(wind, 7, 30.0), same(wind, 7, 30.0), other(wind, 8, 30.0);
  CHECK(gusts == same);
  CHECK_FALSE(gusts == other);
  const auto at = [](const Gusts& g, double t) {
    std::vector<double> memory(Gusts::kMemory, 0.0);
    Instant now;
    now.t = t;
    return g.at(40.0, now, memory).value;
  };
  CHECK(at(gusts, 100.0) != at(other, 100.0));
  CHECK(at(gusts, -1.0) == 0.0);
  CHECK(at(gusts, 0.0) == 0.0);
  std::vector<double> memory(Gusts::kMemory, 0.0);
  for (const double t : {100.0, 100.05, 100.0}) {
    Instant now;
    now.t = t;
    CHECK(gusts.at(40.0, now, memory).value == at(gusts, t));  // what is kept is that of the time
  }
}

TEST_CASE("a measured wind is felt as it was measured", "[wind]") {
  WindSpec wind = gusty(10.0, WindSpec::Gusts::record);
  WindRecord record;
  record.step = 2.0;
  for (int i = 0; i < 400; ++i) record.speed.push_back(10.0 + 1.5 * std::sin(0.1 * i));
  wind.record = std::make_shared<const WindRecord>(record);
  const WindStream stream(wind, 1, 0.0);
  const double mean = record.mean();
  Instant now;
  now.t = 246.0;
  CHECK(stream.at_hull(10.0, now, {}).norm() == Approx(10.0 + record.speed[123] - mean).epsilon(1e-12));
  now.t = 247.0;  // between two values: the cubic follows the sine of 63 steps a period to a thousandth
  CHECK(stream.at_hull(10.0, now, {}).norm() == Approx(20.0 + 1.5 * std::sin(12.35) - mean).epsilon(1e-4));
  wind.speed = 12.0;
  CHECK_THROWS_AS(WindStream(wind, 1, 0.0), SpecificationError);
  wind.record.reset();
  CHECK_THROWS_AS(WindStream(wind, 1, 0.0), SpecificationError);
}
