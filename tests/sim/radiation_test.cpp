#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "sim/hull/coefficients/coefficient_file.h"
#include "sim/hull/radiation/radiation.h"
#include "sim/hull/radiation/radiation_memory.h"

namespace stillhook {
namespace {

/// A radiation model with its memory, marched through a given velocity.
class Marched {
 public:
  explicit Marched(const Radiation& radiation)
      : radiation_(radiation),
        state_(radiation.state_size()),
        past_(radiation.modes()),
        D_(radiation.modes() * radiation.modes()),
        F_(radiation.modes()) {}

  void start(const std::vector<double>& V) { radiation_.start(V, memory()); }
  /// Force at the end of the step, as the interface promises it.
  const std::vector<double>& step(double h, const std::vector<double>& V) {
    try_step(h, V);
    radiation_.end_step(V, h, memory());
    return F_;
  }
  /// The same without committing it.
  const std::vector<double>& try_step(double h, const std::vector<double>& V) {
    radiation_.begin_step(h, memory(), past_, D_);
    const int n = radiation_.modes();
    for (int i = 0; i < n; ++i) {
      F_[i] = past_[i];
      for (int j = 0; j < n; ++j) F_[i] -= D_[i + n * j] * V[j];
    }
    return F_;
  }
  std::vector<double> force_now(const std::vector<double>& V) {
    std::vector<double> F(radiation_.modes());
    radiation_.force(V, memory(), F);
    return F;
  }
  const std::vector<double>& state() const { return state_; }
  double D(int i, int j) const { return D_[i + radiation_.modes() * j]; }
  Memory memory() { return {state_, {}}; }

 private:
  const Radiation& radiation_;
  std::vector<double> state_, past_, D_, F_;
};

constexpr double kDecay = 0.35, kFrequency = 0.8;

/// K(s) = exp(-a s) on (i, j), cut where it has fallen to 1e-9.
RetardationFunctions exponential(int i, int j, double interval) {
  RetardationFunctions K{interval, {{i, j, {}}}};
  for (int m = 0; m * interval < 60.0; ++m) K.kernels[0].value.push_back(std::exp(-kDecay * m * interval));
  return K;
}

/// -int_0^t exp(-a s) V(t - s) ds for V = sin^2(w t / 2) = (1 - cos w t)/2, which starts from rest smoothly.
double velocity(double t) { return 0.5 * (1.0 - std::cos(kFrequency * t)); }
double exact_force(double t) {
  const double a = kDecay, w = kFrequency, d = a * a + w * w;
  const double constant = (1.0 - std::exp(-a * t)) / a;
  const double cosine = (a * std::cos(w * t) + w * std::sin(w * t) - a * std::exp(-a * t)) / d;
  return -0.5 * (constant - cosine);
}

/// Root mean square error of the force over 25 s with steps drawn between `low` and `high`.
double error_with_steps(double interval, double low, double high, bool at_instant = false) {
  const RadiationMemory radiation(exponential(1, 4, interval), 6);
  Marched run(radiation);
  std::vector<double> V(6, 0.0);
  run.start(V);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> draw(low, high);
  double sum = 0.0;
  int count = 0;
  for (double t = 0.0; t < 25.0; ++count) {
    const double h = draw(random);
    t += h;
    V[4] = velocity(t);
    const double F = run.step(h, V)[1];
    const double error = (at_instant ? run.force_now(V)[1] : F) - exact_force(t);
    sum += error * error;
  }
  return std::sqrt(sum / count);
}

}  // namespace

TEST_CASE("constant radiation damping", "[radiation]") {
  MatrixX B = MatrixX::Zero(6, 6);
  B(2, 2) = 3.0;
  B(2, 4) = B(4, 2) = -1.0;
  B(4, 4) = 2.0;
  const ConstantRadiation radiation(B);
  Marched run(radiation);
  const std::vector<double> V = {1.0, 1.0, 2.0, 1.0, 0.5, 1.0};
  CHECK(run.step(0.05, V)[2] == Approx(-5.5));
  CHECK(run.force_now(V)[4] == Approx(1.0));
  CHECK(radiation.radiated_power(V) == Approx(2.0 * 5.5 - 0.5 * 1.0));
}

TEST_CASE("memory force is second order for steps that vary", "[radiation]") {
  // Interval and steps refined together; in the last sets the steps span several intervals.
  struct Set {
    double low, high;
  };
  for (const Set& set : {Set{0.2, 0.9}, Set{0.5, 0.5}, Set{0.05, 0.1}, Set{1.2, 3.7}}) {
    for (bool at_instant : {false, true}) {
      const double coarse = error_with_steps(0.2, 0.2 * set.low, 0.2 * set.high, at_instant);
      const double fine = error_with_steps(0.05, 0.05 * set.low, 0.05 * set.high, at_instant);
      INFO("steps " << set.low << ".." << set.high << " intervals, errors " << coarse << " " << fine);
      // Second order: 16; the random steps differ between the runs.
      CHECK(coarse / fine > 13.0);
      // The force is of order 1.
      CHECK(fine < (set.high > 1.0 ? 2e-3 : 2e-4));
    }
  }
}

TEST_CASE("memory force opposes a steady motion by the whole integral of its kernel", "[radiation]") {
  const RadiationMemory radiation(exponential(0, 0, 0.1), 6);
  Marched run(radiation);
  std::vector<double> V(6, 0.0);
  run.start(V);
  V[0] = 2.0;
  double F = 0.0;
  for (int n = 0; n < 2000; ++n) F = run.step(0.037, V)[0];
  // B(0) = int K; straight lines between samples add a^2 interval^2 / 12 = 1e-4 of it.
  CHECK(F == Approx(-2.0 / kDecay).epsilon(2e-4));
  CHECK(run.force_now(V)[0] == Approx(F).epsilon(1e-9));
}

TEST_CASE("a failed step leaves no trace and D is the derivative", "[radiation]") {
  const RadiationMemory radiation(exponential(1, 4, 0.1), 6);
  Marched run(radiation), once(radiation);
  std::vector<double> V(6, 0.0);
  run.start(V);
  once.start(V);
  double t = 0.0;
  for (double h : {0.05, 0.05, 0.03, 0.04, 0.25}) {
    t += h;
    V[4] = velocity(t);
    run.step(h, V);
    once.step(h, V);
  }
  const std::vector<double> before = run.state();
  std::vector<double> W = V;
  W[4] += 10.0;
  const double F0 = run.try_step(0.08, V)[1];
  const double F1 = run.try_step(0.08, W)[1];
  CHECK(run.D(1, 4) == Approx(-(F1 - F0) / 10.0).epsilon(1e-10));
  // int_0^h exp(-a s) (1 - s/h) ds = h/2 - a h^2/6 + ...; straight lines: 1e-4.
  CHECK(run.D(1, 4) == Approx(0.08 / 2.0 - kDecay * 0.08 * 0.08 / 6.0).epsilon(1e-3));
  CHECK(run.D(4, 1) == 0.0);
  CHECK(run.state() == before);
  V[4] = velocity(t + 0.04);
  CHECK(run.step(0.04, V)[1] == once.step(0.04, V)[1]);
}

TEST_CASE("the memory force of the crane hull follows A(w) and B(w)", "[radiation]") {
  const HydrodynamicCoefficients c = read_coefficient_file(STILLHOOK_SOURCE_DIR "/problems/hulls/crane_110x46x4.csv");
  const RetardationFunctions K = truncated(c.retardation, 0.005);
  const RadiationMemory radiation(K, 6);
  for (double w : {0.571, 1.0}) {
    const MatrixX B = damping_from_kernels(K, 6, w), dA = added_mass_from_kernels(MatrixX::Zero(6, 6), K, w);
    const auto impedance = [&](int i) { return std::hypot(B(i, i), w * dA(i, i)); };
    for (int mode : {0, 2, 3, 4}) {
      Marched run(radiation);
      std::vector<double> V(6, 0.0);
      run.start(V);
      const double h = 0.05;
      double worst = 0.0, t = 0.0, largest = 0.0;
      for (int n = 1; n < 1600; ++n) {
        t = n * h;
        V[mode] = std::sin(w * t);
        const std::vector<double> F = run.step(h, V);
        if (t < K.duration() + 1.0) continue;  // the start still remembered
        for (int i = 0; i < 6; ++i) {
          // F = -B V - (A - A_inf) dV/dt
          const double expected = -B(i, mode) * V[mode] - dA(i, mode) * w * std::cos(w * t);
          const double scale = std::sqrt(impedance(i) * impedance(mode));
          worst = std::max(worst, std::abs(F[i] - expected) / scale);
          largest = std::max(largest, std::abs(F[i]) / scale);
        }
      }
      INFO("mode " << mode + 1 << " at " << w << ": " << worst);
      CHECK(largest > 0.9);
      // Relative to the diagonal's impedance. Lines between samples cost (w interval)^2 / 12 = 0.1 % each for V and K
      // at 1 rad/s, and the start is remembered to the tolerance of the cut.
      CHECK(worst < 0.003);
    }
  }
}

TEST_CASE("heave with memory reaches the response of the frequency domain", "[radiation]") {
  // One degree of freedom: (m + A_inf) z'' + int K z' + c z = F cos(w t), Newmark's average acceleration.
  const HydrodynamicCoefficients c = read_coefficient_file(STILLHOOK_SOURCE_DIR "/problems/hulls/crane_110x46x4.csv");
  RetardationFunctions K = truncated(c.retardation, 0.005);
  std::erase_if(K.kernels, [](const RetardationKernel& k) { return k.i != 2 || k.j != 2; });
  const RadiationMemory memory(K, 6);
  const double w = 0.628, mass = 20.746e6, stiffness = 1025.0 * 9.80665 * 110.0 * 46.0, force = 1e7;
  const FrequencyCoefficients* table = nullptr;
  for (const FrequencyCoefficients& f : c.frequency)
    if (f.frequency == w) table = &f;
  REQUIRE(table != nullptr);
  const auto response = [&](double A, double B) { return force / Complex(stiffness - w * w * (mass + A), -w * B); };
  MatrixX constant = MatrixX::Zero(6, 6);
  constant(2, 2) = table->B(2, 2);
  const ConstantRadiation damping(constant);

  const auto march = [&](const Radiation& radiation, double A) {
    Marched run(radiation);
    std::vector<double> V(6, 0.0);
    run.start(V);
    const double M = mass + A;
    double z = 0.0, v = 0.0, a = 0.0;
    Complex harmonic = 0.0;
    const int per_cycle = 500, steps = 50 * per_cycle;  // 50 cycles; transients have died out after 10
    const double dt = 2.0 * std::numbers::pi / w / per_cycle;
    for (int n = 1; n <= steps; ++n) {
      const double t = n * dt;
      const double ramp = std::min(1.0, t / 60.0);
      V[2] = 0.0;  // the force at no velocity is the past part
      const double past = run.try_step(dt, V)[2], D = run.D(2, 2);
      // v1 = v + dt (a + a1)/2, z1 = z + dt v + dt^2 (a + a1)/4
      const double v_free = v + 0.5 * dt * a, z_free = z + dt * v + 0.25 * dt * dt * a;
      const double a1 = (ramp * force * std::cos(w * t) + past - D * v_free - stiffness * z_free) /
                        (M + 0.5 * dt * D + 0.25 * dt * dt * stiffness);
      v = v_free + 0.5 * dt * a1;
      z = z_free + 0.25 * dt * dt * a1;
      a = a1;
      V[2] = v;
      run.step(dt, V);
      if (n > steps - 10 * per_cycle) harmonic += 2.0 * z * std::polar(1.0, w * t) / (10.0 * per_cycle);
    }
    return harmonic;
  };

  // exp(-i w t): z = Re[Z exp(-i w t)], so the harmonic is z exp(+i w t) averaged.
  const MatrixX A_K = added_mass_from_kernels(c.A_inf, K, w), B_K = damping_from_kernels(K, 6, w);
  const Complex with_memory = march(memory, c.A_inf(2, 2));
  const Complex own = response(A_K(2, 2), B_K(2, 2)), from_table = response(table->A(2, 2), table->B(2, 2));
  CHECK(std::abs(with_memory - own) < 0.001 * std::abs(own));               // time stepping alone
  CHECK(std::abs(with_memory - from_table) < 0.01 * std::abs(from_table));  // and the mesh behind K
  const Complex with_constants = march(damping, table->A(2, 2));
  CHECK(std::abs(with_constants - from_table) < 0.001 * std::abs(from_table));
  // The force leads the motion: a lag in the sign convention of the coefficients.
  CHECK(std::arg(with_memory) > 0.0);
}

}  // namespace stillhook
