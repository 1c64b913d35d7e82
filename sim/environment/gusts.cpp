#include "sim/environment/gusts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/error.h"
#include "sim/number_text.h"
#include "sim/sea/spectrum.h"
#include "sim/sea/wave_field.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr double kReferenceHeight = 10.0, kLowestWind = 1.0;  // m
constexpr double kLowestNode = 60.0 / 64.0;  // m, so that 60 m, where IEC's length has its kink, is a node
constexpr double kNpdPower = 0.468;
constexpr double kWidestPiece = 0.1;  // of ln f, for a rule that is exact to the third power: 1e-6 of the integral
constexpr double kMeansDiffer = 0.1;  // 1, of a record and the wind that it is said to be
constexpr std::uint64_t kGustStream = 0x67757374;  // apart from the streams of seas of the same seed

double steady_speed(const WindSpec& wind, double z) { return wind_speed(wind, z, Instant()).value; }

double gust_sigma(const WindSpec& wind, double z) {
  return wind.turbulence.value_or(turbulence_intensity(wind, z)) * steady_speed(wind, z);
}

/// Integral of the density over ln f from `low` to `high`: two points of Gauss in each of even pieces.
double variance_between(const WindSpec& wind, double z, double low, double high) {
  const int pieces = std::max(1, static_cast<int>(std::ceil((high - low) / kWidestPiece)));
  const double half = 0.5 * (high - low) / pieces, offset = half / std::sqrt(3.0);
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i)
    for (const double side : {-offset, offset}) {
      const double f = std::exp(low + (2 * i + 1) * half + side);
      sum += half * f * gust_density(wind, f, z);
    }
  return sum;
}

double node_height(int k) { return std::ldexp(kLowestNode, k); }

/// Weights of the nodes for the value at a height, and their derivatives by it (1/m): cubic with slopes from the
/// neighbours.
struct NodeWeights {
  std::array<double, Gusts::kHeights> value = {}, slope = {};
};

NodeWeights weights_at(double z, const Instant& now) {
  constexpr int n = Gusts::kHeights;
  NodeWeights w;
  const bool moves = now.on(z > kLowestWind), below_top = now.on(z < node_height(n - 1));
  if (!moves) z = kLowestWind;
  if (!below_top) {
    w.value[n - 1] = 1.0;
    return w;
  }
  const double x = std::log2(z / kLowestNode);
  const int i = std::clamp(static_cast<int>(std::floor(x)), 0, n - 2);
  const double s = x - i, by_z = moves ? 1.0 / (z * std::log(2.0)) : 0.0;
  const auto add = [&](int k, double value, double slope) {
    w.value[static_cast<std::size_t>(k)] += value;
    w.slope[static_cast<std::size_t>(k)] += slope * by_z;
  };
  add(i, 1.0 + s * s * (2.0 * s - 3.0), 6.0 * s * (s - 1.0));
  add(i + 1, s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s));
  const auto add_tangent = [&](int k, double value, double slope) {  // the weight of the slope at node k
    const int before = std::max(k - 1, 0), after = std::min(k + 1, n - 1);
    const double per = 1.0 / (after - before);
    add(after, value * per, slope * per);
    add(before, -value * per, -slope * per);
  };
  add_tangent(i, s * (1.0 - s) * (1.0 - s), 1.0 + s * (3.0 * s - 4.0));
  add_tangent(i + 1, s * s * (s - 1.0), s * (3.0 * s - 2.0));
  return w;
}

/// As the waves do: 0 at rest before the run.
double grown(double t, double ramp) { return WaveField({}, ramp).ramp(t); }

}  // namespace

double WindRecord::mean() const {
  return std::accumulate(speed.begin(), speed.end(), 0.0) / static_cast<double>(speed.size());
}

WindSpeed wind_speed(const WindSpec& wind, double z, const Instant& now) {
  if (!now.on(z > kLowestWind)) {
    const Instant plain;
    return {wind_speed(wind, std::nextafter(kLowestWind, 2.0), plain).value, 0.0};
  }
  switch (wind.profile) {
    case WindSpec::Profile::iso: {
      const double C = 0.0573 * std::sqrt(1.0 + 0.148 * wind.speed);
      return {wind.speed * (1.0 + C * std::log(z / kReferenceHeight)), wind.speed * C / z};
    }
    case WindSpec::Profile::power: {
      const double value = wind.speed * std::pow(z / kReferenceHeight, wind.exponent);
      return {value, value * wind.exponent / z};
    }
    case WindSpec::Profile::constant:
      break;
  }
  return {wind.speed, 0.0};
}

double turbulence_intensity(const WindSpec& wind, double z) {
  return 0.06 * (1.0 + 0.043 * wind.speed) * std::pow(std::max(z, kLowestWind) / kReferenceHeight, -0.22);
}

double gust_speed(const WindSpec& wind, double z, double duration) {
  return steady_speed(wind, z) * (1.0 - 0.41 * turbulence_intensity(wind, z) * std::log(duration / 3600.0));
}

double gust_density(const WindSpec& wind, double f, double z) {
  z = std::max(z, kLowestWind);
  const double U = steady_speed(wind, z);
  switch (wind.gusts) {
    case WindSpec::Gusts::npd: {
      const double h = z / kReferenceHeight, u = wind.speed / 10.0;
      const double F = 172.0 * f * std::pow(h, 2.0 / 3.0) * std::pow(u, -0.75);
      return 320.0 * u * u * std::pow(h, 0.45) / std::pow(1.0 + std::pow(F, kNpdPower), 5.0 / (3.0 * kNpdPower));
    }
    case WindSpec::Gusts::api: {
      const double s = gust_sigma(wind, z), peak = 0.025 * U / z;
      return s * s / peak / std::pow(1.0 + 1.5 * f / peak, 5.0 / 3.0);
    }
    case WindSpec::Gusts::kaimal: {
      const double s = gust_sigma(wind, z);
      const double time = wind.turbulence_length.value_or(8.1 * 0.7 * std::min(z, 60.0)) / U;
      return 4.0 * s * s * time / std::pow(1.0 + 6.0 * f * time, 5.0 / 3.0);
    }
    case WindSpec::Gusts::none:
    case WindSpec::Gusts::record:
      break;
  }
  return 0.0;
}

double gust_deviation(const WindSpec& wind, double z) {
  if (wind.gusts == WindSpec::Gusts::record && wind.record) {
    const double mean = wind.record->mean();
    double sum = 0.0;
    for (const double v : wind.record->speed) sum += (v - mean) * (v - mean);
    return std::sqrt(sum / static_cast<double>(wind.record->speed.size()));
  }
  return std::sqrt(variance_between(wind, z, std::log(kLowestGust), std::log(kHighestGust)));
}

Gusts::Gusts(const WindSpec& wind, int seed, double ramp) : ramp_(ramp) {
  if (wind.seeded()) add_components(wind, seed);
  if (wind.blows() && wind.gusts == WindSpec::Gusts::record) take_record(wind);
}

void Gusts::add_components(const WindSpec& wind, int seed) {
  const double low = std::log(kLowestGust), width = (std::log(kHighestGust) - low) / wind.components;
  for (int j = 0; j < wind.components; ++j) {
    const double from = low + j * width;
    const auto draw = [&](std::uint64_t which) {
      return portable_uniform(static_cast<std::uint64_t>(seed), kGustStream + which, static_cast<std::uint64_t>(j));
    };
    frequency_.push_back(kTwoPi * std::exp(from + draw(0) * width));
    phase_.push_back(kTwoPi * draw(1));
    Heights a;
    for (int k = 0; k < kHeights; ++k)
      a[static_cast<std::size_t>(k)] = std::sqrt(2.0 * variance_between(wind, node_height(k), from, from + width));
    amplitude_.push_back(a);
  }
}

void Gusts::take_record(const WindSpec& wind) {
  if (!wind.record || wind.record->speed.size() < 2 || !(wind.record->step > 0.0))
    throw SpecificationError("wind", "record_file", "needs two values at least");
  const double mean = wind.record->mean(), wanted = steady_speed(wind, wind.record_height);
  if (!(std::abs(mean - wanted) <= kMeansDiffer * wanted))
    throw SpecificationError("wind", "record_file",
                             "has a mean of " + number_text(mean) + " m/s, but the wind is " + number_text(wanted) +
                                 " m/s at " + number_text(wind.record_height) +
                                 " m: more than a tenth apart; set speed_m_per_s, the profile or record_height_m so "
                                 "that they agree");
  record_step_ = wind.record->step;
  for (const double v : wind.record->speed) record_.push_back(v - mean);
}

// Cubic between the values, with slopes from the neighbours; the last value holds after the end.
double Gusts::recorded(double t) const {
  const int last = static_cast<int>(record_.size()) - 1;
  const double x = std::clamp(t / record_step_, 0.0, static_cast<double>(last));
  const int i = std::min(static_cast<int>(x), last - 1);
  const auto value = [&](int k) { return record_[static_cast<std::size_t>(std::clamp(k, 0, last))]; };
  const double s = x - i, d0 = 0.5 * (value(i + 1) - value(i - 1)), d1 = 0.5 * (value(i + 2) - value(i));
  return value(i) + s * (d0 + s * (3.0 * (value(i + 1) - value(i)) - 2.0 * d0 - d1 +
                                   s * (d0 + d1 - 2.0 * (value(i + 1) - value(i)))));
}

Gusts::Heights Gusts::speeds(double t) const {
  Heights sum = {};
  const double r = grown(t, ramp_);
  if (r == 0.0) return sum;
  for (std::size_t j = 0; j < frequency_.size(); ++j) {
    const double c = std::cos(frequency_[j] * t + phase_[j]);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += amplitude_[j][k] * c;
  }
  for (double& v : sum) v *= r;
  return sum;
}

WindSpeed Gusts::at(double z, const Instant& now, std::span<double> memory) const {
  if (!record_.empty()) return {grown(now.t, ramp_) * recorded(now.t), 0.0};
  if (frequency_.empty()) return {};
  if (memory[0] != 1.0 || memory[1] != now.t) {
    const Heights sum = speeds(now.t);
    std::copy(sum.begin(), sum.end(), memory.begin() + 2);
    memory[0] = 1.0;
    memory[1] = now.t;
  }
  const NodeWeights w = weights_at(z, now);
  WindSpeed gust;
  for (std::size_t k = 0; k < w.value.size(); ++k) {
    gust.value += w.value[k] * memory[2 + k];
    gust.slope += w.slope[k] * memory[2 + k];
  }
  return gust;
}

double Gusts::amplitude(std::size_t j, double z) const {
  const NodeWeights w = weights_at(z, Instant());
  return std::inner_product(w.value.begin(), w.value.end(), amplitude_[j].begin(), 0.0);
}

}  // namespace stillhook
