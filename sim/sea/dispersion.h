// The length and the speed of waves over a flat bed, by linear theory.
//
//   w^2 = g k tanh(k h),   c = w / k,   c_g = (w / 2k) (1 + 2kh / sinh 2kh)          (Faltinsen 1990, ch. 2)
//
// Where k h > 20 the bed changes nothing that a double holds, and the waves are those of deep water.
#pragma once

namespace stillhook {

/// k h beyond which the water is deep: 1 - tanh(20) = 8e-18.
inline constexpr double kDeepWater = 20.0;

/// Wave number k > 0, rad/m. frequency rad/s, gravity m/s2; depth m, may be infinite.
double wave_number(double frequency, double gravity, double depth);

/// The inverse: rad/s.
double wave_frequency(double wavenumber, double gravity, double depth);

/// Speed at which the energy of waves travels, m/s.
double group_velocity(double frequency, double gravity, double depth);

/// exp(-2 k h): what comes back from the bed. 0 in deep water.
double bed_reflection(double wavenumber, double depth);

}  // namespace stillhook
