// Retardation functions of the box hull 110 x 46 m, draft 4 m, from the state space fitted to the panel method's A and
// B up to 2 rad/s, against the cosine transform of the damping of another code.
//
// Truth: frequency-domain code Capytaine, 6,016 panels, B(w) from 0 to 3 rad/s with a power-law tail beyond; about
// midship in the water plane, rho 1025 kg/m3. Kramers-Kronig: A(w) comes back from it within 0.7 %. Before 0.5 s the
// tail matters and it is not trusted.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "sim/hull/radiation/state_space_fit.h"
#include "tests/validation/reference_lift.h"

namespace stillhook {
namespace {

constexpr int kSamples = 24;
constexpr double kFirst = 0.5, kInterval = 0.5;  // s

struct Kernel {
  int i, j;
  std::array<double, kSamples> value;  // N per (m/s or rad/s) and per s; moments N m
};
constexpr std::array<Kernel, 8> kKernels{
    {{0, 0, {1.194e+06,  -3.274e+05, -8.88e+05, -8.253e+05, -5.645e+05, -3.164e+05, -1.272e+05, 3523,
             7.727e+04,  1.036e+05,  1.02e+05,  8.807e+04,  6.786e+04,  4.411e+04,  2.095e+04,  1630,
             -1.317e+04, -2.291e+04, -2.59e+04, -2.151e+04, -1.17e+04,  667.2,      1.336e+04,  2.395e+04}},
     {1, 1, {3.067e+06, -6.171e+05, -2.047e+06, -1.998e+06, -1.455e+06, -9.097e+05, -4.745e+05, -1.577e+05,
             3.901e+04, 1.369e+05,  1.78e+05,   1.917e+05,  1.853e+05,  1.629e+05,  1.351e+05,  1.095e+05,
             8.565e+04, 6.173e+04,  3.999e+04,  2.22e+04,   6554,       -8350,      -2.056e+04, -2.787e+04}},
     {2, 2, {1.694e+07,  1.199e+07,  5.963e+06,  5.895e+05,  -3.299e+06, -5.65e+06,  -6.711e+06, -6.74e+06,
             -6.007e+06, -4.872e+06, -3.728e+06, -2.837e+06, -2.228e+06, -1.772e+06, -1.342e+06, -9.156e+05,
             -5.584e+05, -3.239e+05, -1.97e+05,  -1.14e+05,  -2.433e+04, 7.189e+04,  1.408e+05,  1.59e+05}},
     {3, 3, {8.123e+08,  5e+08,      1.159e+08,  -2.302e+08, -4.595e+08, -5.452e+08, -5.086e+08, -3.972e+08,
             -2.597e+08, -1.305e+08, -2.725e+07, 4.525e+07,  8.949e+07,  1.111e+08,  1.162e+08,  1.101e+08,
             9.718e+07,  8.05e+07,   6.231e+07,  4.4e+07,    2.66e+07,   1.102e+07,  -1.923e+06, -1.175e+07}},
     {4, 4, {8.856e+09,  5.511e+09,  1.595e+09,  -1.867e+09, -4.244e+09, -5.326e+09, -5.26e+09, -4.411e+09,
             -3.198e+09, -1.965e+09, -9.159e+08, -1.265e+08, 4.124e+08,  7.42e+08,   9.067e+08, 9.467e+08,
             8.995e+08,  7.988e+08,  6.72e+08,   5.386e+08,  4.116e+08,  2.982e+08,  2.004e+08, 1.173e+08}},
     {5, 5, {2.744e+09, -1.118e+09, -2.43e+09,  -2.119e+09, -1.321e+09, -6.002e+08, -8.713e+07, 2.24e+08,
             3.577e+08, 3.651e+08,  3.103e+08,  2.329e+08,  1.471e+08,  6.828e+07,  1.765e+07,  1.453e+06,
             3.228e+06, 2.01e+06,   -9.648e+06, -2.667e+07, -4.192e+07, -5.196e+07, -5.741e+07, -6.076e+07}},
     {0, 4, {6.779e+07,  3.279e+07,  -4.289e+06, -2.911e+07, -3.807e+07, -3.559e+07, -2.793e+07, -1.933e+07,
             -1.168e+07, -5.657e+06, -1.407e+06, 1.287e+06,  2.851e+06,  3.653e+06,  3.905e+06,  3.783e+06,
             3.513e+06,  3.269e+06,  3.08e+06,   2.89e+06,   2.683e+06,  2.46e+06,   2.157e+06,  1.665e+06}},
     {1, 3, {-4.464e+07, -2.165e+07, 4.127e+06,  2.216e+07,  2.857e+07,  2.61e+07,   1.963e+07,  1.255e+07,
             6.288e+06,  1.358e+06,  -2.005e+06, -3.932e+06, -4.827e+06, -5.017e+06, -4.658e+06, -3.923e+06,
             -3.064e+06, -2.255e+06, -1.515e+06, -8.326e+05, -2.775e+05, 8.944e+04,  3.152e+05,  4.948e+05}}}};

}  // namespace

TEST_CASE("retardation functions of the crane's hull against another code", "[validation][slow]") {
  const Model model = build_model(reference_case().specification);
  const HydrodynamicCoefficients& set = *model.coefficients(model.body_index("crane")).set;
  REQUIRE(set.volume[0] == Approx(110.0 * 46.0 * 4.0).epsilon(0.005));
  StateSpaceOptions options;
  options.tolerance = model.specification().panel_method.fit_tolerance;  // as runs have it
  const StateSpaceFit fit = fit_state_space(set, options).fit;
  for (const Kernel& exact : kKernels) {
    double difference = 0.0, size = 0.0;
    for (int n = 0; n < kSamples; ++n) {
      difference += std::pow(fit.retardation(kFirst + n * kInterval)(exact.i, exact.j) - exact.value[n], 2);
      size += std::pow(exact.value[n], 2);
    }
    const double error = std::sqrt(difference / size);
    INFO("K" << exact.i + 1 << exact.j + 1 << ": rms " << 100.0 * error << " %");
    // The damping is good to 3 %, the fit to 1 or 2 %; in yaw it has not died out at 2 rad/s, where the band ends.
    CHECK(error < (exact.i == 5 ? 0.10 : 0.065));  // 6.2 % was found in surge
  }
}

}  // namespace stillhook
