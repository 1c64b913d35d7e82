// Wave periods of a JONSWAP spectrum: peak, mean zero-crossing and energy period in terms of each other.
#pragma once

namespace stillhook {

/// Tp/Tz and Tp/Te, with Tz = 2 pi sqrt(m0/m2) and Te = 2 pi m_-1/m0, of the spectrum
/// w^-5 exp(-1.25 (w/wp)^-4) gamma^b, b = exp(-(w - wp)^2/(2 s^2 wp^2)), s = 0.07 below and 0.09 above the peak, with
/// its whole tail (Hasselmann et al. 1973). Pierson-Moskowitz, gamma = 1: Tp/Tz = (1.25 pi)^(1/4).
struct PeriodRatios {
  double peak_over_zero_crossing = 0.0, peak_over_energy = 0.0;
};
PeriodRatios period_ratios(double gamma);

}  // namespace stillhook
