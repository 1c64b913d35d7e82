#include "sim/sea/sea_statistics.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "sim/sea/spectrum.h"
#include "sim/sea/wave_record.h"
#include "sim/spatial/constants.h"

namespace stillhook {

namespace {

using SpecType = SeaStateSpec::Type;

/// Moments of the spectrum (m2, m2 rad/s, m2 rad2/s2) and the first one over direction.
struct SeaMoments {
  double m0 = 0.0, m1 = 0.0, m2 = 0.0;
  std::complex<double> direction = 0.0;  // int int S exp(i b)
  void add(const SeaMoments& other) {
    m0 += other.m0;
    m1 += other.m1;
    m2 += other.m2;
    direction += other.direction;
  }
};

/// a1 of cos^n: the quotient of two Beta functions.
double first_harmonic_cos_n(double n) {
  return std::exp(2.0 * std::lgamma(0.5 * n + 1.0) - std::lgamma(0.5 * (n + 3.0)) - std::lgamma(0.5 * (n + 1.0)));
}

double first_harmonic(const SeaStateSpec& s) {
  if (s.directions == 1) return 1.0;
  if (s.spreading_2s > 0.0) return s.spreading_2s / (s.spreading_2s + 1.0);
  return s.spreading > 0.0 ? first_harmonic_cos_n(s.spreading) : 1.0;
}

/// Hs as given, and the ratios of the moments of the shape.
SeaMoments of_shape(const SeaStateSpec& s) {
  const double wp = kTwoPi / s.peak_period, m0 = s.significant_height * s.significant_height / 16.0;
  SeaMoments m;
  m.m0 = m0;
  if (s.type == SpecType::ochi_hubble) {
    // With x = b (wp/w)^4 the moments are Gamma functions.
    const double b = s.lambda + 0.25;
    const auto ratio = [&](int n) {
      return std::pow(wp * std::pow(b, 0.25), n) * std::exp(std::lgamma(s.lambda - 0.25 * n) - std::lgamma(s.lambda));
    };
    m.m1 = m0 * ratio(1);
    m.m2 = m0 * ratio(2);
  } else {
    // Over u = wp/w, in which the tail w^-5 ends at 0; Simpson's rule to either side of the kink at the peak.
    constexpr int n = 2000;
    double sum[3] = {};
    for (const auto& [from, to] : {std::pair(0.0, 1.0), std::pair(1.0, 3.5)})
      for (int i = 0; i <= n; ++i) {
        const double u = from + (to - from) * i / n, share = i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
        if (u == 0.0) continue;  // S dw/du = u^3, u^2, u there
        const double w = wp / u;
        const double energy = share * (to - from) / (3.0 * n) * spectral_density(s, w) * wp / (u * u);
        for (int k = 0; k < 3; ++k) sum[k] += energy * std::pow(w, k);
      }
    m.m1 = m0 * sum[1] / sum[0];
    m.m2 = m0 * sum[2] / sum[0];
  }
  m.direction = std::polar(m0 * first_harmonic(s), s.heading);
  return m;
}

/// By the trapezoidal rule over its own frequencies.
SeaMoments of_spectrum(const DirectionalSpectrum& spectrum) {
  const std::size_t n = spectrum.heading.size();
  const auto at = [&](std::size_t i) {
    SeaMoments m;
    m.m0 = density_at(spectrum, i);
    m.m1 = m.m0 * spectrum.frequency[i];
    m.m2 = m.m1 * spectrum.frequency[i];
    for (std::size_t b = 0; b < n; ++b)
      m.direction += std::polar(spectrum.density[i * n + b] * kTwoPi / static_cast<double>(n), spectrum.heading[b]);
    return m;
  };
  SeaMoments sum;
  for (std::size_t i = 0; i + 1 < spectrum.frequency.size(); ++i) {
    const double half = 0.5 * (spectrum.frequency[i + 1] - spectrum.frequency[i]);
    for (const SeaMoments& end : {at(i), at(i + 1)})
      sum.add({half * end.m0, half * end.m1, half * end.m2, half * end.direction});
  }
  return sum;
}

SeaMoments of_waves(const std::vector<WaveComponent>& waves) {
  SeaMoments m;
  for (const WaveComponent& c : waves) {
    const double energy = 0.5 * c.amplitude * c.amplitude, w = c.frequency;
    m.add({energy, energy * w, energy * w * w, energy * std::complex<double>(c.cos_heading, c.sin_heading)});
  }
  return m;
}

SeaMoments moments_of(const SeaStateSpec& s) {
  switch (s.type) {
    case SpecType::calm:
      break;
    case SpecType::regular: {
      const double energy = 0.5 * s.amplitude * s.amplitude, w = s.frequency;
      return {energy, energy * w, energy * w * w, std::polar(energy, s.heading)};
    }
    case SpecType::jonswap:
    case SpecType::pierson_moskowitz:
    case SpecType::ochi_hubble:
      return of_shape(s);
    case SpecType::spectrum:
      return of_spectrum(*s.spectrum);
    case SpecType::record:
      return of_waves(record_components(s, kStandardGravity, std::numeric_limits<double>::infinity()));
    case SpecType::sum: {
      SeaMoments all;
      for (const SeaStateSpec& part : s.parts) all.add(moments_of(part));
      return all;
    }
  }
  return {};
}

/// rad/s, where the density is largest on a fine grid over the bands of the parts; those of one frequency have none.
double peak_of_sum(const SeaStateSpec& sum) {
  double low = std::numeric_limits<double>::infinity(), high = 0.0, peak = 0.0, largest = 0.0;
  for (const SeaStateSpec& part : sum.parts) {
    if (part.type == SpecType::regular) continue;
    low = std::min(low, frequency_below(part, 0.001));
    high = std::max(high, frequency_below(part, 0.99));
  }
  constexpr int kPlaces = 4000;
  for (int i = 0; i <= kPlaces && high > low; ++i) {
    const double w = low * std::pow(high / low, static_cast<double>(i) / kPlaces);
    double density = 0.0;
    for (const SeaStateSpec& part : sum.parts)
      if (part.type != SpecType::regular) density += spectral_density(part, w);
    if (density > largest) largest = density, peak = w;
  }
  return peak;
}

/// Of a record: the mean, by energy, of the eleven neighbouring waves with the most of it.
double peak_of_waves(const std::vector<WaveComponent>& waves) {
  constexpr std::size_t kSide = 5;
  double largest = 0.0, peak = 0.0;
  for (std::size_t i = 0; i < waves.size(); ++i) {
    double sum = 0.0, moment = 0.0;
    for (std::size_t j = i > kSide ? i - kSide : 0; j <= std::min(i + kSide, waves.size() - 1); ++j) {
      const double energy = waves[j].amplitude * waves[j].amplitude;
      sum += energy;
      moment += energy * waves[j].frequency;
    }
    if (sum > largest) largest = sum, peak = moment / sum;
  }
  return peak;
}

double peak_of(const SeaStateSpec& s) {
  switch (s.type) {
    case SpecType::calm:
      return 0.0;
    case SpecType::regular:
      return s.frequency;
    case SpecType::jonswap:
    case SpecType::pierson_moskowitz:
    case SpecType::ochi_hubble:
      return kTwoPi / s.peak_period;
    case SpecType::record:
      return peak_of_waves(record_components(s, kStandardGravity, std::numeric_limits<double>::infinity()));
    case SpecType::spectrum: {
      std::size_t best = 0;
      for (std::size_t i = 1; i < s.spectrum->frequency.size(); ++i)
        if (density_at(*s.spectrum, i) > density_at(*s.spectrum, best)) best = i;
      return s.spectrum->frequency[best];
    }
    case SpecType::sum:
      break;
  }
  // Where all parts are regular, the highest of them.
  if (const double peak = peak_of_sum(s); peak > 0.0) return peak;
  return std::ranges::max_element(s.parts, {}, &SeaStateSpec::amplitude)->frequency;
}

/// rad/s, below which a twentieth of the energy of what a file holds lies; infinite for other seas.
double long_end_of(const SeaStateSpec& s, double m0) {
  constexpr double kShare = 0.05;
  if (s.type == SpecType::spectrum) return frequency_below(s, kShare);
  double sum = 0.0;
  if (s.type == SpecType::record)
    for (const WaveComponent& c : record_components(s, kStandardGravity, std::numeric_limits<double>::infinity()))
      if ((sum += 0.5 * c.amplitude * c.amplitude) >= kShare * m0) return c.frequency;
  return std::numeric_limits<double>::infinity();
}

SeaStatistics statistics_of(const SeaStateSpec& s) {
  const SeaMoments m = moments_of(s);
  SeaStatistics result;
  result.name = s.name;
  if (!(m.m0 > 0.0)) return result;
  result.significant_height = 4.0 * std::sqrt(m.m0);
  result.peak_period = kTwoPi / peak_of(s);
  result.long_period = std::max(result.peak_period, kTwoPi / long_end_of(s, m.m0));
  result.mean_period = kTwoPi * m.m0 / m.m1;
  result.zero_crossing_period = kTwoPi * std::sqrt(m.m0 / m.m2);
  result.heading = std::arg(m.direction);
  result.spread = std::sqrt(std::max(2.0 * (1.0 - std::abs(m.direction) / m.m0), 0.0));
  return result;
}

}  // namespace

std::vector<SeaStatistics> sea_statistics(const SeaStateSpec& state) {
  if (state.type == SpecType::calm) return {};
  std::vector<SeaStatistics> all;
  for (const SeaStateSpec& part : state.parts)
    if (state.type == SpecType::sum) all.push_back(statistics_of(part));
  all.push_back(statistics_of(state));
  return all;
}

double circular_spread_cos_n(double n) { return std::sqrt(2.0 * (1.0 - first_harmonic_cos_n(n))); }

double circular_spread_cos_2s(double s) { return std::sqrt(2.0 / (s + 1.0)); }

}  // namespace stillhook
