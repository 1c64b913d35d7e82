#include "sim/sea/wave_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/number_text.h"
#include "sim/sea/spectrum.h"
#include "sim/sea/wave_sums.h"

namespace stillhook {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

double phase_at(const WaveComponent& c, double t) { return std::remainder(c.phase - c.frequency * t, kTurn); }

void copy_out(const double* from, std::size_t start, std::size_t count, std::span<double> to) {
  std::copy_n(from, count, to.begin() + static_cast<std::ptrdiff_t>(start));
}

void sample_calm(std::span<const double> z, bool gradients, const WaveSamples& out) {
  std::ranges::fill(out.elevation, 0.0);
  const bool head = !out.head.empty();
  if (head) std::ranges::transform(z, out.head.begin(), [](double zi) { return -zi; });
  if (!gradients) return;
  std::ranges::fill(out.elevation_x, 0.0);
  std::ranges::fill(out.elevation_y, 0.0);
  if (!head) return;
  std::ranges::fill(out.head_x, 0.0);
  std::ranges::fill(out.head_y, 0.0);
  std::ranges::fill(out.head_z, -1.0);
}

[[noreturn]] void refuse(const SeaStateSpec& state, const char* field, const std::string& sentence) {
  throw SpecificationError("sea.states." + state.name, field, sentence);
}

void check(const SeaStateSpec& s) {
  if (!std::isfinite(s.heading)) refuse(s, "heading", "must be a number, got " + number_text(s.heading));
  if (s.type == SeaStateSpec::Type::regular) {
    if (!(s.amplitude >= 0.0) || !std::isfinite(s.amplitude))
      refuse(s, "amplitude", "must be >= 0 m, got " + number_text(s.amplitude));
    if (!(s.frequency > 0.0) || !std::isfinite(s.frequency))
      refuse(s, "frequency", "must be > 0 rad/s, got " + number_text(s.frequency));
    if (!std::isfinite(s.phase)) refuse(s, "phase", "must be a number, got " + number_text(s.phase));
    return;
  }
  if (!(s.significant_height > 0.0) || !std::isfinite(s.significant_height))
    refuse(s, "significant_height", "must be > 0 m, got " + number_text(s.significant_height));
  if (!(s.peak_period > 0.0) || !std::isfinite(s.peak_period))
    refuse(s, "peak_period", "must be > 0 s, got " + number_text(s.peak_period));
  // From 1/0.287 = e^3.48 on the factor 1 - 0.287 ln gamma is negative; measured spectra lie between 1 and 7.
  if (s.gamma != 0.0 && !(s.gamma >= 1.0 && s.gamma <= 10.0))
    refuse(s, "gamma", "must lie between 1 and 10 (or be left out), got " + number_text(s.gamma));
  if (!(s.spreading >= 0.0) || !std::isfinite(s.spreading))
    refuse(s, "spreading", "must be >= 0, got " + number_text(s.spreading));
  if (s.components < 1) refuse(s, "components", "must be at least 1, got " + std::to_string(s.components));
  if (s.directions < 1) refuse(s, "directions", "must be at least 1, got " + std::to_string(s.directions));
  if ((s.directions > 1) != (s.spreading > 0.0))
    refuse(s, "directions", "a short-crested sea needs both more than one direction and a spreading exponent > 0");
  if (static_cast<long>(s.components) * s.directions > kMaxWaveComponents)
    refuse(s, "components",
           "components times directions must be at most " + std::to_string(kMaxWaveComponents) + ", got " +
               std::to_string(static_cast<long>(s.components) * s.directions));
}

// Stokes' limit in deep water: a wave higher than a seventh of its length breaks.
void check_steepness(const SeaStateSpec& s, double gravity) {
  const double steepness = 2.0 * s.amplitude * s.frequency * s.frequency / (kTurn * gravity);
  if (steepness > 1.0 / 7.0)
    refuse(s, "amplitude",
           "the wave would break: height over length is " + number_text(steepness) + ", at most 1/7 is possible");
}

}  // namespace

WaveField::WaveField(std::vector<WaveComponent> components, double ramp)
    : components_(std::move(components)), ramp_(ramp) {
  if (components_.size() > kMaxWaveComponents) throw std::invalid_argument("too many wave components");
}

double WaveField::ramp(double t) const { return ramp_derivatives(t)[0]; }

std::array<double, 3> WaveField::ramp_derivatives(double t) const {
  if (t >= ramp_) return {1.0, 0.0, 0.0};
  if (t <= 0.0) return {0.0, 0.0, 0.0};
  const double s = t / ramp_, v = 1.0 - s;
  return {s * s * s * (10.0 + s * (-15.0 + 6.0 * s)), 30.0 * s * s * v * v / ramp_,
          60.0 * s * v * (v - s) / (ramp_ * ramp_)};
}

double WaveField::elevation(double x, double y, double t) const {
  double sum = 0.0;
  for (std::size_t start = 0; start < components_.size(); start += kPhaseBlock) {
    double wave[4 * kPhaseBlock] = {}, amplitude[kPhaseBlock] = {};
    for (std::size_t i = 0; i < std::min<std::size_t>(kPhaseBlock, components_.size() - start); ++i) {
      const WaveComponent& c = components_[start + i];
      wave[i] = c.wavenumber * c.cos_heading;
      wave[kPhaseBlock + i] = c.wavenumber * c.sin_heading;
      wave[2 * kPhaseBlock + i] = c.frequency;
      wave[3 * kPhaseBlock + i] = c.phase;
      amplitude[i] = c.amplitude;
    }
    sum += sum_elevation(wave, amplitude, 1, x, y, t);
  }
  return ramp(t) * sum;
}

void WaveField::sample(double t, std::span<const double> x, std::span<const double> y, std::span<const double> z,
                       bool gradients, const WaveSamples& out) const {
  const double r = ramp(t);
  if (calm() || r == 0.0) return sample_calm(z, gradients, out);

  std::array<FrozenWave, kMaxWaveComponents> waves;
  const int count = static_cast<int>(components_.size());
  for (int j = 0; j < count; ++j) {
    const WaveComponent& c = components_[j];
    waves[j] = {r * c.amplitude, c.wavenumber, c.wavenumber * c.cos_heading, c.wavenumber * c.sin_heading,
                phase_at(c, t)};
  }

  const bool head = !out.head.empty();
  WaveBlock block;
  for (std::size_t start = 0; start < x.size(); start += kWaveBlock) {
    const std::size_t n = std::min<std::size_t>(kWaveBlock, x.size() - start);
    for (std::size_t p = 0; p < kWaveBlock; ++p) {
      const std::size_t i = start + std::min(p, n - 1);
      block.x[p] = x[i], block.y[p] = y[i], block.z[p] = z[i];
    }
    evaluate_waves(waves.data(), count, head, gradients, block);
    copy_out(block.elevation, start, n, out.elevation);
    if (head) copy_out(block.head, start, n, out.head);
    if (!gradients) continue;
    copy_out(block.elevation_x, start, n, out.elevation_x);
    copy_out(block.elevation_y, start, n, out.elevation_y);
    if (!head) continue;
    copy_out(block.head_x, start, n, out.head_x);
    copy_out(block.head_y, start, n, out.head_y);
    copy_out(block.head_z, start, n, out.head_z);
  }
}

Vector3 WaveField::velocity(const Vector3& p_W, double t) const {
  Vector3 v = Vector3::Zero();
  for (const WaveComponent& c : components_) {
    const double theta = c.wavenumber * (p_W.x() * c.cos_heading + p_W.y() * c.sin_heading) + phase_at(c, t);
    const double speed = c.amplitude * c.frequency * std::exp(c.wavenumber * std::min(p_W.z(), 0.0));
    v += speed * Vector3(c.cos_heading * std::cos(theta), c.sin_heading * std::cos(theta), std::sin(theta));
  }
  return ramp(t) * v;
}

WaveField build_wave_field(const SeaStateSpec& state, double gravity, double ramp) {
  if (state.type == SeaStateSpec::Type::calm) return {};
  check(state);
  if (!(gravity > 0.0)) throw SpecificationError("sea", "gravity", "must be > 0 m/s2, got " + number_text(gravity));
  if (!(ramp >= 0.0)) throw SpecificationError("sea", "ramp", "must be >= 0 s, got " + number_text(ramp));
  if (state.type != SeaStateSpec::Type::regular) return {spectrum_components(state, gravity), ramp};
  check_steepness(state, gravity);
  if (state.amplitude == 0.0) return {};
  const double w = state.frequency;
  return {{{state.amplitude, w, w * w / gravity, std::cos(state.heading), std::sin(state.heading), state.phase}}, ramp};
}

}  // namespace stillhook
