#include "results/weather/period_ratio.h"

#include <cmath>

namespace stillhook {

PeriodRatios period_ratios(double gamma) {
  constexpr double kFirst = 0.2, kLast = 50.0;  // of w/wp; below the first the spectrum is 0 in double precision
  constexpr int kSteps = 20000;
  const double step = std::log(kLast / kFirst) / kSteps;
  double before = 0.0, zero = 0.0, second = 0.0;  // moments -1, 0 and 2
  for (int i = 0; i < kSteps; ++i) {
    const double x = kFirst * std::exp((i + 0.5) * step), width = x < 1.0 ? 0.07 : 0.09;
    const double b = std::exp(-0.5 * std::pow((x - 1.0) / width, 2));
    const double area = std::exp(-1.25 * std::pow(x, -4)) * std::pow(gamma, b) * std::pow(x, -4) * step;  // S dx
    before += area / x;
    zero += area;
    second += area * x * x;
  }
  second += 0.5 / (kLast * kLast);  // the tail x^-5 beyond; of the other moments less than 1e-6
  return {std::sqrt(second / zero), zero / before};
}

}  // namespace stillhook
