// Mean wind over the height, and its gusts.
//
// Profiles of the hourly mean, with U0 at 10 m:
//   iso       U = U0 (1 + C ln(z/10)),  C = 0.0573 sqrt(1 + 0.148 U0)        ISO 19901-1, from NPD
//   power     U = U0 (z/10)^a
//   constant  U = U0
// Below 1 m the wind is that at 1 m.
//
// Mean over t s (the largest of an hour), after ISO 19901-1, whatever the profile:
//   U(z, t) = U(z) (1 - 0.41 Iu ln(t/3600)),   Iu = 0.06 (1 + 0.043 U0) (z/10)^-0.22
//
// Spectra, one-sided in f (Hz), m2/s2/Hz; s: standard deviation, Iu U(z) unless the case gives its share of U(z):
//   npd     S = 320 (U0/10)^2 (z/10)^0.45 / (1 + F^n)^(5/(3n)),   F = 172 f (z/10)^(2/3) (U0/10)^-0.75,   n = 0.468
//   api     S = (s^2/fp) / (1 + 1.5 f/fp)^(5/3),   fp = 0.025 U(z)/z
//   kaimal  S = 4 s^2 (L/U(z)) / (1 + 6 f L/U(z))^(5/3),   L = 8.1 x 0.7 min(z, 60 m) unless the case gives it
// (ISO 19901-1; API RP 2A; IEC 61400-1.)
//
//   u'(z, t) = sum_j a_j(z) cos(2 pi f_j t + e_j),   a_j^2/2 = integral of S(f, z) over bin j
//
// The bins cut the band of 1/600 to 0.5 Hz evenly in ln f: the NPD spectrum was fitted there, and its integral over all
// frequencies is 20 % more than Iu U. In each bin the frequency is drawn, so that the gusts do not repeat. The phases
// are those of all heights: gusts are coherent, which is on the safe side of what a body feels. a_j is held at heights
// that double from 0.94 to 240 m, cubic between them in ln z; above, it is that at 240 m. The gusts grow as the waves
// do.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/environment/wind_spec.h"
#include "sim/multibody/force_element.h"

namespace stillhook {

/// Band of the gusts' spectra that is simulated, Hz.
inline constexpr double kLowestGust = 1.0 / 600.0, kHighestGust = 0.5;

/// Wind speed at a height, m/s, and its derivative by the height, 1/s.
struct WindSpeed {
  double value = 0.0, slope = 0.0;
};

/// Mean wind at height z (m) above still water.
WindSpeed wind_speed(const WindSpec& wind, double z, const Instant& now);

/// Turbulence intensity of ISO 19901-1 at height z (m), 1.
double turbulence_intensity(const WindSpec& wind, double z);

/// Largest mean over `duration` (s, at most an hour) of the hour at height z (m), m/s.
double gust_speed(const WindSpec& wind, double z, double duration);

/// Spectral density of the gusts at f (Hz) and height z (m), m2/s2/Hz; 0 without a spectrum.
double gust_density(const WindSpec& wind, double f, double z);

/// Standard deviation of the gusts within the band that is simulated, m/s; of a record that of its values.
double gust_deviation(const WindSpec& wind, double z);

/// The gusts of one wind.
class Gusts {
 public:
  /// What has to be known of one instant: the gust at each of the heights, m/s. 1.0 in front once it is filled in.
  static constexpr int kHeights = 9, kMemory = 2 + kHeights;

  Gusts() = default;  // none
  /// `seed`: of the phases. `ramp` (s): they grow from nothing over this time. Throws SpecificationError("wind") for a
  /// record that is none, or whose mean contradicts the speed of the wind.
  Gusts(const WindSpec& wind, int seed, double ramp);

  bool operator==(const Gusts&) const = default;
  bool none() const { return frequency_.empty() && record_.empty(); }

  /// Gust at height z at an instant. `memory`: kMemory numbers, zero at first, in which the sum over the spectrum is
  /// kept for the next question about the same time.
  WindSpeed at(double z, const Instant& now, std::span<double> memory) const;

  /// rad/s and m/s at height z of the components, in order.
  const std::vector<double>& frequencies() const { return frequency_; }
  double amplitude(std::size_t j, double z) const;

 private:
  using Heights = std::array<double, kHeights>;
  void add_components(const WindSpec& wind, int seed);
  void take_record(const WindSpec& wind);
  Heights speeds(double t) const;
  double recorded(double t) const;

  double ramp_ = 0.0;                      // s
  std::vector<double> frequency_, phase_;  // rad/s, rad
  std::vector<Heights> amplitude_;         // m/s
  double record_step_ = 0.0;               // s
  std::vector<double> record_;             // m/s, less the mean
};

}  // namespace stillhook
