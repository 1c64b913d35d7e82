#include "sim/sea/wave_record.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "sim/error.h"
#include "sim/number_text.h"
#include "sim/sea/dispersion.h"
#include "sim/sea/wave_kernel.h"
#include "sim/spatial/constants.h"

namespace stillhook {

namespace {

constexpr double kMostLeftOut = 0.05;  // of the variance
constexpr std::size_t kShortestRecord = 16;

[[noreturn]] void refuse_record(const SeaStateSpec& state, const std::string& sentence) {
  throw SpecificationError("sea.states." + state.name, "record", sentence);
}

void check_record(const SeaStateSpec& state) {
  if (!state.record) refuse_record(state, "needs the record itself");
  const ElevationRecord& r = *state.record;
  if (!(r.step > 0.0) || !std::isfinite(r.step))
    refuse_record(state, "needs a time step > 0 s, got " + number_text(r.step));
  if (r.elevation.size() < kShortestRecord)
    refuse_record(state, "needs at least " + std::to_string(kShortestRecord) + " values, has " +
                             std::to_string(r.elevation.size()));
  for (std::size_t i = 0; i < r.elevation.size(); ++i)
    if (!std::isfinite(r.elevation[i])) refuse_record(state, "has no number in value " + std::to_string(i + 1));
}

/// Of value i of n: rises from 0 to 1 over the taper and falls again.
double taper(std::size_t i, std::size_t n) {
  const double width = kRecordTaper * static_cast<double>(n);
  const double from_end = std::min(static_cast<double>(i), static_cast<double>(n - 1 - i));
  return from_end >= width ? 1.0 : 0.5 - 0.5 * std::cos(std::numbers::pi * from_end / width);
}

/// a exp(-i f) of the waves n = 1, 2, ... of the tapered record.
std::vector<std::complex<double>> transformed(const ElevationRecord& record) {
  const std::size_t n = record.elevation.size();
  double sum = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    sum += taper(i, n) * record.elevation[i];
    weight += taper(i, n);
  }
  std::vector<double> tapered(n);
  for (std::size_t i = 0; i < n; ++i) tapered[i] = taper(i, n) * (record.elevation[i] - sum / weight);
  Eigen::FFT<double> fft;
  std::vector<std::complex<double>> spectrum;
  fft.fwd(spectrum, tapered);
  std::vector<std::complex<double>> waves;
  for (std::size_t k = 1; k <= n / 2; ++k) {
    const bool both = 2 * k == n;  // the highest frequency is its own mirror image
    waves.push_back((both ? 1.0 : 2.0) / static_cast<double>(n) * spectrum[k]);
  }
  return waves;
}

bool in_band(const SeaStateSpec& state, double w) {
  return w >= state.record_file.lowest * (1.0 - 1e-9) && w <= state.record_file.highest * (1.0 + 1e-9);
}

double share_left_out(const SeaStateSpec& state, const std::vector<std::complex<double>>& waves) {
  double all = 0.0, out = 0.0;
  for (std::size_t i = 0; i < waves.size(); ++i) {
    const double w = kTwoPi * static_cast<double>(i + 1) / record_length(*state.record);
    all += std::norm(waves[i]);
    if (!in_band(state, w)) out += std::norm(waves[i]);
  }
  return all > 0.0 ? out / all : 0.0;
}

}  // namespace

double record_length(const ElevationRecord& record) {
  return record.step * static_cast<double>(record.elevation.size());
}

double record_share_left_out(const SeaStateSpec& state) {
  check_record(state);
  return share_left_out(state, transformed(*state.record));
}

std::vector<WaveComponent> record_components(const SeaStateSpec& state, double gravity, double depth) {
  check_record(state);
  const std::vector<std::complex<double>> waves = transformed(*state.record);
  if (const double share = share_left_out(state, waves); share > kMostLeftOut)
    refuse_record(state, "has " + number_text(std::round(1000.0 * share) / 10.0) +
                             " % of its variance outside the band from " + number_text(state.record_file.lowest) +
                             " to " + number_text(state.record_file.highest) +
                             " rad/s, at most 5 % may be left out: widen lowest_rad_per_s and highest_rad_per_s");
  const double c = std::cos(state.heading), s = std::sin(state.heading);
  const double at = state.record_file.point[0] * c + state.record_file.point[1] * s;
  std::vector<WaveComponent> components;
  for (std::size_t i = 0; i < waves.size(); ++i) {
    const double w = kTwoPi * static_cast<double>(i + 1) / record_length(*state.record);
    if (!in_band(state, w)) continue;
    const double k = wave_number(w, gravity, depth);
    // a cos(w t - f) at the gauge is a cos(k at - w t + e), e = f - k at.
    components.push_back({std::abs(waves[i]), w, k, c, s, std::remainder(-std::arg(waves[i]) - k * at, kTwoPi)});
  }
  if (components.empty()) refuse_record(state, "has no waves in its band");
  if (components.size() > static_cast<std::size_t>(kMaxWaveComponents))
    refuse_record(state, "has " + std::to_string(components.size()) + " waves in its band, at most " +
                             std::to_string(kMaxWaveComponents) +
                             " are possible: take a narrower band or a shorter part of the record");
  return components;
}

}  // namespace stillhook
