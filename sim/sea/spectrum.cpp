#include "sim/sea/spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace stillhook {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kLowest = 0.3, kHighest = 4.0;  // of the peak frequency; below 0.3 lies 1e-60 of the energy
constexpr int kGrid = 20000;                     // points of the energy table

enum Stream : std::uint64_t { kPhase = 1, kJitter = 2, kShuffle = 3 };

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

std::vector<double> equal_energy_frequencies(const SeaStateSpec& state, int count) {
  const double wp = 2.0 * kPi / state.peak_period;
  const EnergyTable table(kLowest * wp, kHighest * wp, [&](double w) { return spectral_density(state, w); });
  const auto seed = static_cast<std::uint64_t>(state.seed);
  std::vector<double> edge(count + 1, 0.0), frequency(count);
  for (int i = 0; i <= count; ++i) edge[i] = static_cast<double>(i) / count;
  for (int i = 0; i < count; ++i) {
    // A slice of half the bin's energy, placed at random in the bin: its mean over seeds is the bin.
    const double width = 0.5 / count;
    const double from = edge[i] + width * portable_uniform(seed, kJitter, i);
    const bool tail = i + 1 == count;  // the last bin is long: keep its moment instead
    frequency[i] = tail ? rms_between(table, edge[i], 1.0) : rms_between(table, from, from + width);
  }
  return frequency;
}

/// Directions relative to the main one that split the energy of cos^n into equal parts, each at its part's median.
std::vector<double> equal_energy_directions(double exponent, int count) {
  if (count == 1) return {0.0};
  const EnergyTable table(-kPi / 2, kPi / 2,
                          [&](double angle) { return std::pow(std::max(std::cos(angle), 0.0), exponent); });
  std::vector<double> direction(count);
  for (int d = 0; d < count; ++d) direction[d] = table.place((d + 0.5) / count);
  return direction;
}

double gamma_of(const SeaStateSpec& state) {
  if (state.type == SeaStateSpec::Type::pierson_moskowitz) return 1.0;
  return state.gamma > 0.0 ? state.gamma : default_gamma(state.significant_height, state.peak_period);
}

}  // namespace

double default_gamma(double significant_height, double peak_period) {
  const double ratio = peak_period / std::sqrt(significant_height);
  if (ratio <= 3.6) return 5.0;
  if (ratio >= 5.0) return 1.0;
  return std::exp(5.75 - 1.15 * ratio);
}

double spectral_density(const SeaStateSpec& state, double omega) {
  if (omega <= 0.0) return 0.0;
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

std::vector<WaveComponent> spectrum_components(const SeaStateSpec& state, double gravity) {
  const int directions = state.directions;
  const int count = state.components * directions;
  const auto seed = static_cast<std::uint64_t>(state.seed);
  const std::vector<double> frequency = equal_energy_frequencies(state, count);
  const std::vector<double> direction = equal_energy_directions(state.spreading, directions);
  const double amplitude = state.significant_height * std::sqrt(1.0 / (8.0 * count));

  std::vector<WaveComponent> components;
  components.reserve(count);
  std::vector<int> order(directions);
  for (int i = 0; i < count; ++i) {
    const int place = i % directions;
    if (place == 0) {
      // Fisher-Yates with draws by index.
      std::iota(order.begin(), order.end(), 0);
      for (int d = directions - 1; d > 0; --d)
        std::swap(order[d], order[static_cast<int>(portable_uniform(seed, kShuffle, i + d) * (d + 1))]);
    }
    const double heading = state.heading + direction[order[place]];
    const double w = frequency[i];
    components.push_back({amplitude, w, w * w / gravity, std::cos(heading), std::sin(heading),
                          2.0 * kPi * portable_uniform(seed, kPhase, i)});
  }
  return components;
}

}  // namespace stillhook
