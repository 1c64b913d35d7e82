#include "sim/sea/wave_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/sea/dispersion.h"
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

}  // namespace

WaveField::WaveField(std::vector<WaveComponent> components, double ramp, double depth)
    : components_(std::move(components)), ramp_(ramp) {
  if (components_.size() > kMaxWaveComponents) throw std::invalid_argument("too many wave components");
  const auto feels_bed = [&](const WaveComponent& c) { return bed_reflection(c.wavenumber, depth) > 0.0; };
  if (std::ranges::any_of(components_, feels_bed)) depth_ = depth;
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
                phase_at(c, t), bed_reflection(c.wavenumber, depth_)};
  }

  const bool head = !out.head.empty();
  WaveBlock block;
  for (std::size_t start = 0; start < x.size(); start += kWaveBlock) {
    const std::size_t n = std::min<std::size_t>(kWaveBlock, x.size() - start);
    for (std::size_t p = 0; p < kWaveBlock; ++p) {
      const std::size_t i = start + std::min(p, n - 1);
      block.x[p] = x[i], block.y[p] = y[i], block.z[p] = z[i];
    }
    evaluate_waves(waves.data(), count, deep() ? 0.0 : depth_, head, gradients, block);
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

double WaveField::stretched_height(const Vector3& p_W, double t, Stretching stretching) const {
  if (stretching == Stretching::vertical) return std::clamp(p_W.z(), -depth_, 0.0);
  const double zeta = elevation(p_W.x(), p_W.y(), t);
  const double under = std::min(p_W.z() - zeta, 0.0);
  return deep() ? under : std::max(under * depth_ / (depth_ + zeta), -depth_);
}

WaterMotion WaveField::motion(const Vector3& p_W, double t, Stretching stretching) const {
  const auto [r, rate, curvature] = ramp_derivatives(t);
  WaterMotion m;
  if (calm() || r == 0.0) return m;
  const double z = stretched_height(p_W, t, stretching);
  for (const WaveComponent& c : components_) {
    const double theta = c.wavenumber * (p_W.x() * c.cos_heading + p_W.y() * c.sin_heading) + phase_at(c, t);
    const double fall = std::exp(c.wavenumber * z);
    const double bed = bed_reflection(c.wavenumber, depth_), back = bed / fall;  // exp(-k (z + 2h))
    const double size = c.amplitude * c.frequency / (1.0 - bed), along = size * (fall + back), up = size * (fall - back);
    const double cosine = std::cos(theta), sine = std::sin(theta);
    m.velocity += Vector3(along * c.cos_heading * cosine, along * c.sin_heading * cosine, up * sine);
    m.acceleration +=
        c.frequency * Vector3(along * c.cos_heading * sine, along * c.sin_heading * sine, -up * cosine);
  }
  m.acceleration = r * m.acceleration + rate * m.velocity;
  m.velocity *= r;
  return m;
}

Vector3 WaveField::velocity(const Vector3& p_W, double t, Stretching stretching) const {
  return motion(p_W, t, stretching).velocity;
}

Vector3 WaveField::acceleration(const Vector3& p_W, double t, Stretching stretching) const {
  return motion(p_W, t, stretching).acceleration;
}

}  // namespace stillhook
