#include "sim/sea/spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "sim/number_text.h"
#include "sim/sea/dispersion.h"

namespace stillhook {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kLowest = 0.3, kHighestOfPeak = 4.0;  // of the peak frequency; below 0.3 lies 1e-40 of the energy
constexpr int kGrid = 20000;                     // points of the energy table

enum Stream : std::uint64_t { kPhase = 1, kJitter = 2, kShuffle = 3, kDirection = 4, kStreams = 16 };

// The draws of one part of a sea.
struct Draws {
  std::uint64_t seed, first;
  double uniform(Stream stream, int index) const {
    return portable_uniform(seed, first + stream, static_cast<std::uint64_t>(index));
  }
};

// A density given on an even grid, integrated by the trapezoidal rule and inverted piecewise linearly.
class EnergyTable {
 public:
  template <typename Density>
  EnergyTable(double low, double high, Density density) : low_(low), step_((high - low) / kGrid), sum_(kGrid + 1, 0.0) {
    double before = density(low);
    for (int i = 1; i <= kGrid; ++i) {
      const double here = density(low + i * step_);
      sum_[i] = sum_[i - 1] + 0.5 * (before + here) * step_;
      before = here;
    }
  }
  /// The place below which the share q of the energy lies.
  double place(double q) const {
    const double wanted = q * sum_.back();
    const auto above = std::upper_bound(sum_.begin(), sum_.end(), wanted);
    if (above == sum_.end()) return low_ + kGrid * step_;
    const auto i = std::max<std::ptrdiff_t>(above - sum_.begin(), 1);
    return low_ + step_ * (static_cast<double>(i - 1) + (wanted - sum_[i - 1]) / (sum_[i] - sum_[i - 1]));
  }

 private:
  double low_, step_;
  std::vector<double> sum_;
};

// Root mean square frequency between shares q0 and q1 of the energy: keeps the second moment of the spectrum. Taken
// over equal shares of energy, so the average is a plain one.
double rms_between(const EnergyTable& table, double q0, double q1) {
  constexpr int n = 40;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double w = table.place(q0 + (q1 - q0) * (i + 0.5) / n);
    sum += w * w;
  }
  return std::sqrt(sum / n);
}

EnergyTable energy_of(const SeaStateSpec& state) {
  const bool tabulated = state.type == SeaStateSpec::Type::spectrum;
  const double wp = tabulated ? 0.0 : 2.0 * kPi / state.peak_period;
  return {tabulated ? state.spectrum->frequency.front() : kLowest * wp,
          tabulated ? state.spectrum->frequency.back() : kHighestOfPeak * wp,
          [&](double w) { return spectral_density(state, w); }};
}

// Rad/s, from low to high energy.
std::vector<double> equal_energy_frequencies(const SeaStateSpec& state, const Draws& draws, int count) {
  const EnergyTable table = energy_of(state);
  std::vector<double> edge(count + 1, 0.0), frequency(count);
  for (int i = 0; i <= count; ++i) edge[i] = static_cast<double>(i) / count;
  for (int i = 0; i < count; ++i) {
    // A slice of half the bin's energy, placed at random in the bin: its mean over seeds is the bin.
    const double width = 0.5 / count;
    const double from = edge[i] + width * draws.uniform(kJitter, i);
    const bool tail = i + 1 == count;  // the last bin is long: keep its moment instead
    frequency[i] = tail ? rms_between(table, edge[i], 1.0) : rms_between(table, from, from + width);
  }
  return frequency;
}

/// Directions relative to the main one that split the energy into equal parts, each at its part's median.
std::vector<double> equal_energy_directions(const SeaStateSpec& state, int count) {
  if (count == 1) return {0.0};
  const bool round = state.spreading_2s > 0.0;
  const double exponent = round ? 2.0 * state.spreading_2s : state.spreading, reach = round ? kPi : kPi / 2;
  const EnergyTable table(-reach, reach, [&](double angle) {
    return std::pow(std::max(std::cos(round ? 0.5 * angle : angle), 0.0), exponent);
  });
  std::vector<double> direction(count);
  for (int d = 0; d < count; ++d) direction[d] = table.place((d + 0.5) / count);
  return direction;
}

double ochi_hubble_density(const SeaStateSpec& s, double omega) {
  const double wp = 2.0 * kPi / s.peak_period, r4 = std::pow(wp / omega, 4), b = 0.25 * (4.0 * s.lambda + 1.0);
  const double hs = s.significant_height;
  return 0.25 * hs * hs / omega *
         std::exp(s.lambda * std::log(b * r4) - std::lgamma(s.lambda) - b * r4);
}

// Place of the entry below w among the frequencies of a 2-D spectrum, and how far w is on the way to the next.
std::pair<std::size_t, double> entry_below(const DirectionalSpectrum& spectrum, double w) {
  const std::vector<double>& f = spectrum.frequency;
  const auto above = std::upper_bound(f.begin() + 1, f.end() - 1, w);
  const auto i = static_cast<std::size_t>(above - f.begin()) - 1;
  return {i, (w - f[i]) / (f[i + 1] - f[i])};
}

/// The heading below which the share q of the energy at w lies, each entry's spread evenly over its bin.
double drawn_heading(const DirectionalSpectrum& spectrum, double w, double q) {
  const auto [i, share] = entry_below(spectrum, w);
  const std::size_t n = spectrum.heading.size();
  const double bin = 2.0 * kPi / static_cast<double>(n);
  std::vector<double> sum(n + 1, 0.0);
  for (std::size_t b = 0; b < n; ++b)
    sum[b + 1] = sum[b] + (1.0 - share) * spectrum.density[i * n + b] + share * spectrum.density[(i + 1) * n + b];
  const double wanted = q * sum.back();
  const auto above = std::upper_bound(sum.begin(), sum.end(), wanted);
  const std::size_t b = above == sum.end() ? n - 1 : static_cast<std::size_t>(above - sum.begin()) - 1;
  const double within = sum[b + 1] > sum[b] ? (wanted - sum[b]) / (sum[b + 1] - sum[b]) : 0.5;
  return spectrum.heading[b] + (within - 0.5) * bin;
}

std::vector<WaveComponent> drawn_components(const SeaStateSpec& state, const Draws& draws, double gravity,
                                            double depth) {
  const DirectionalSpectrum& spectrum = *state.spectrum;
  const std::vector<double> frequency = equal_energy_frequencies(state, draws, state.waves);
  const double amplitude = std::sqrt(2.0 * variance_of(spectrum) / state.waves);
  std::vector<WaveComponent> components;
  for (int i = 0; i < state.waves; ++i) {
    const double w = frequency[i], heading = drawn_heading(spectrum, w, draws.uniform(kDirection, i));
    components.push_back({amplitude, w, wave_number(w, gravity, depth), std::cos(heading), std::sin(heading),
                          2.0 * kPi * draws.uniform(kPhase, i)});
  }
  return components;
}

}  // namespace

double default_gamma(double significant_height, double peak_period) {
  const double ratio = peak_period / std::sqrt(significant_height);
  if (ratio <= 3.6) return 5.0;
  if (ratio >= 5.0) return 1.0;
  return std::exp(5.75 - 1.15 * ratio);
}

double gamma_of(const SeaStateSpec& state) {
  if (state.type == SeaStateSpec::Type::pierson_moskowitz) return 1.0;
  return state.gamma > 0.0 ? state.gamma : default_gamma(state.significant_height, state.peak_period);
}

double frequency_below(const SeaStateSpec& state, double share) { return energy_of(state).place(share); }

double density_at(const DirectionalSpectrum& spectrum, std::size_t i) {
  const std::size_t n = spectrum.heading.size();
  double sum = 0.0;
  for (std::size_t b = 0; b < n; ++b) sum += spectrum.density[i * n + b];
  return sum * 2.0 * kPi / static_cast<double>(n);
}

double variance_of(const DirectionalSpectrum& spectrum) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < spectrum.frequency.size(); ++i)
    sum += 0.5 * (density_at(spectrum, i) + density_at(spectrum, i + 1)) *
           (spectrum.frequency[i + 1] - spectrum.frequency[i]);
  return sum;
}

std::string fault_of(const DirectionalSpectrum& spectrum) {
  const std::vector<double>&f = spectrum.frequency, &b = spectrum.heading;
  if (f.size() < 2) return "needs at least 2 frequencies, has " + std::to_string(f.size());
  for (std::size_t i = 0; i < f.size(); ++i)
    if (!std::isfinite(f[i]) || !(f[i] > (i == 0 ? 0.0 : f[i - 1])))
      return "has frequencies that do not rise from above 0: entry " + std::to_string(i + 1) + " is " +
             number_text(f[i]) + " rad/s";
  if (b.size() < 8) return "needs at least 8 directions, has " + std::to_string(b.size());
  const double bin = 2.0 * kPi / static_cast<double>(b.size());
  for (std::size_t i = 0; i + 1 < b.size(); ++i)
    if (!(std::abs(b[i + 1] - b[i] - bin) <= 0.01 * bin))
      return "has directions that do not go round the circle in even steps: " + number_text(b[i] * 180.0 / kPi) +
             " deg is followed by " + number_text(b[i + 1] * 180.0 / kPi) + " deg, of " + std::to_string(b.size());
  if (spectrum.density.size() != f.size() * b.size()) return "needs a density for each frequency and direction";
  for (std::size_t i = 0; i < spectrum.density.size(); ++i)
    if (!(spectrum.density[i] >= 0.0) || !std::isfinite(spectrum.density[i]))
      return "has a density that is not a number >= 0 at frequency " + std::to_string(i / b.size() + 1) +
             ", direction " + std::to_string(i % b.size() + 1);
  return variance_of(spectrum) > 0.0 ? "" : "has no energy";
}

SeaStateSpec part_of(const SeaStateSpec& sum, int i) {
  SeaStateSpec part = sum.parts[static_cast<std::size_t>(i)];
  part.seed = part.part_seed.value_or(sum.seed + i);
  part.name = sum.name + ".parts." + part.name;
  return part;
}

double spectral_density(const SeaStateSpec& state, double omega) {
  if (omega <= 0.0) return 0.0;
  if (state.type == SeaStateSpec::Type::ochi_hubble) return ochi_hubble_density(state, omega);
  if (state.type == SeaStateSpec::Type::spectrum) {
    const DirectionalSpectrum& spectrum = *state.spectrum;
    if (omega < spectrum.frequency.front() || omega > spectrum.frequency.back()) return 0.0;
    const auto [i, share] = entry_below(spectrum, omega);
    return (1.0 - share) * density_at(spectrum, i) + share * density_at(spectrum, i + 1);
  }
  const double gamma = gamma_of(state);
  const double wp = 2.0 * kPi / state.peak_period;
  const double r = wp / omega;
  const double sigma = omega <= wp ? 0.07 : 0.09;
  const double b = std::exp(-std::pow((omega - wp) / (sigma * wp), 2) / 2.0);
  const double hs = state.significant_height;
  return (1.0 - 0.287 * std::log(gamma)) * (5.0 / 16.0) * hs * hs * std::pow(r, 4) / omega *
         std::exp(-1.25 * std::pow(r, 4)) * std::pow(gamma, b);
}

double portable_uniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
  std::uint64_t z = 0;
  for (const std::uint64_t word : {seed, stream, index}) {
    z += word + 0x9E3779B97F4A7C15ull;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    z ^= z >> 31;
  }
  return static_cast<double>(z >> 11) * 0x1.0p-53;
}

std::vector<WaveComponent> spectrum_components(const SeaStateSpec& state, double gravity, double depth, int place) {
  const Draws draws{static_cast<std::uint64_t>(state.seed), kStreams * static_cast<std::uint64_t>(place)};
  if (state.type == SeaStateSpec::Type::spectrum) return drawn_components(state, draws, gravity, depth);
  const int directions = state.directions;
  const int count = state.components * directions;
  const std::vector<double> frequency = equal_energy_frequencies(state, draws, count);
  const std::vector<double> direction = equal_energy_directions(state, directions);
  const double amplitude = state.significant_height * std::sqrt(1.0 / (8.0 * count));

  std::vector<WaveComponent> components;
  components.reserve(count);
  std::vector<int> order(directions);
  for (int i = 0; i < count; ++i) {
    const int d0 = i % directions;
    if (d0 == 0) {
      // Fisher-Yates with draws by index.
      std::iota(order.begin(), order.end(), 0);
      for (int d = directions - 1; d > 0; --d)
        std::swap(order[d], order[static_cast<int>(draws.uniform(kShuffle, i + d) * (d + 1))]);
    }
    const double heading = state.heading + direction[order[d0]];
    const double w = frequency[i];
    components.push_back({amplitude, w, wave_number(w, gravity, depth), std::cos(heading), std::sin(heading),
                          2.0 * kPi * draws.uniform(kPhase, i)});
  }
  return components;
}

}  // namespace stillhook
