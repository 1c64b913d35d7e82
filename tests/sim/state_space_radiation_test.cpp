#include "sim/hull/radiation/state_space_radiation.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "sim/hull/coefficients/coefficient_file.h"
#include "sim/hull/radiation/radiation_memory.h"
#include "tests/sim/resonant_radiation.h"

namespace stillhook {
namespace {

/// A radiation model with its memory, marched through a given velocity.
class Marched {
 public:
  explicit Marched(const Radiation& radiation)
      : radiation_(radiation),
        state_(radiation.state_size()),
        scratch_(radiation.scratch_size()),
        past_(radiation.modes()),
        D_(radiation.modes(), radiation.modes()) {}

  void start(const VectorX& V) { radiation_.start(span(V), memory()); }
  VectorX step(double h, const VectorX& V) {
    const VectorX F = try_step(h, V);
    radiation_.end_step(span(V), h, memory());
    return F;
  }
  VectorX try_step(double h, const VectorX& V) {
    radiation_.begin_step(h, memory(), {past_.data(), static_cast<std::size_t>(past_.size())},
                          {D_.data(), static_cast<std::size_t>(D_.size())});
    return past_ - D_ * V;
  }
  VectorX force_now(const VectorX& V) {
    VectorX F(radiation_.modes());
    radiation_.force(span(V), memory(), {F.data(), static_cast<std::size_t>(F.size())});
    return F;
  }
  void end_step(const VectorX& V, double h) { radiation_.end_step(span(V), h, memory()); }
  const MatrixX& D() const { return D_; }
  const std::vector<double>& state() const { return state_; }

 private:
  static std::span<const double> span(const VectorX& V) { return {V.data(), static_cast<std::size_t>(V.size())}; }
  Memory memory() { return {state_, scratch_}; }

  const Radiation& radiation_;
  std::vector<double> state_, scratch_;
  VectorX past_;
  MatrixX D_;
};

/// The closed form of resonant_radiation.h as poles and residues.
StateSpaceFit exact_fit(const ResonantRadiation& truth) {
  StateSpaceFit fit;
  fit.modes = truth.modes();
  StateSpaceBlock block;
  for (int i = 0; i < fit.modes; ++i) block.modes.push_back(i);
  for (const Resonance& r : truth.resonances) {
    const double v = std::sqrt(r.b * r.b - r.a * r.a);
    block.K.poles.push_back({-r.a, v});
    block.K.residues.push_back(r.G * Complex(0.5, 0.5 * r.a / v));
  }
  fit.blocks.push_back(block);
  return fit;
}

/// A motion of straight pieces, at rest before t = 0 and starting from zero.
struct Pieces {
  double length = 0.7;  // s, of a piece
  std::vector<VectorX> corner;

  Pieces(int modes, int count, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> draw;
    corner.push_back(VectorX::Zero(modes));
    for (int n = 0; n < count; ++n)
      corner.push_back(
          VectorX::NullaryExpr(modes, [&](Eigen::Index i) { return (i % 6 < 3 ? 1.0 : 0.02) * draw(random); }));
  }
  double duration() const { return length * (static_cast<double>(corner.size()) - 1.0); }
  VectorX at(double t) const {
    if (t <= 0.0) return corner[0];
    const int n = std::min(static_cast<int>(t / length), static_cast<int>(corner.size()) - 2);
    const double f = t / length - n;
    return (1.0 - f) * corner[n] + f * corner[n + 1];
  }
};

/// -int_0^t K(t - s) V(s) ds by Simpson's rule on each straight piece.
VectorX convolution(const ResonantRadiation& truth, const Pieces& V, double t) {
  VectorX sum = VectorX::Zero(truth.modes());
  const int cells = 40;  // a piece; K varies over 1/b = 0.7 s, so the error is (0.7/80)^4/180 or 1e-10
  for (double from = 0.0; from < t - 1e-12; from += V.length) {
    const double to = std::min(t, from + V.length), h = (to - from) / (2 * cells);
    for (int n = 0; n <= 2 * cells; ++n) {
      const double weight = n == 0 || n == 2 * cells ? 1.0 : (n % 2 == 1 ? 4.0 : 2.0);
      const double s = from + n * h;
      sum -= weight * h / 3.0 * (truth.kernel(t - s) * V.at(s));
    }
  }
  return sum;
}

/// |F|, each mode over its share of K(0) and the size of the velocities in Pieces.
double size_of(const VectorX& F, const ResonantRadiation& truth) {
  const MatrixX K = truth.kernel(0.0);
  double largest = 0.0;
  for (int i = 0; i < F.size(); ++i)
    if (K(i, i) > 0.0) largest = std::max(largest, std::abs(F(i)) / (K(i, i) * (i % 6 < 3 ? 1.0 : 0.02)));
  return largest;
}

TEST_CASE("the state space gives the convolution of its kernel for steps of any length", "[state_space]") {
  const ResonantRadiation truth = surge_pitch_heave();
  const StateSpaceRadiation radiation(exact_fit(truth));
  const Pieces V(6, 25, 3);
  // Steps that end on the corners and cut the pieces differently: thousandths of a second (where the closed forms of
  // the propagators would cancel), whole pieces, and a random mix.
  for (int way = 0; way < 3; ++way) {
    Marched run(radiation);
    run.start(V.at(0.0));
    std::mt19937 random(9);
    std::uniform_real_distribution<double> draw(0.001, 0.4);
    double t = 0.0, worst = 0.0, largest = 0.0;
    VectorX F;
    for (std::size_t n = 1; n < V.corner.size(); ++n) {
      const double corner = static_cast<double>(n) * V.length;
      while (t < corner) {
        double h = way == 0 ? 0.0007 : way == 1 ? V.length : draw(random);
        if (t + h > corner - 1e-4) h = corner - t;
        t = h == corner - t ? corner : t + h;
        F = run.step(h, V.at(t));
      }
      const VectorX exact = convolution(truth, V, t);
      worst = std::max(worst, size_of(F - exact, truth));
      worst = std::max(worst, size_of(run.force_now(V.at(t)) - exact, truth));
      largest = std::max(largest, size_of(exact, truth));
    }
    INFO("way " << way << ": " << worst << " of " << largest);
    CHECK(largest > 0.3);
    CHECK(worst < 1e-8);  // of the quadrature and of round-off over 25,000 steps
  }
}

TEST_CASE("real poles are marched as pairs are", "[state_space]") {
  // K(t) = (d exp(-d t) - e exp(-e t))/(d - e) against a ramp V = t: F = -int_0^t K(s) (t - s) ds.
  const double d = 0.4, e = 2.5;
  StateSpaceFit fit;
  fit.modes = 6;
  fit.blocks.push_back(
      {{3}, {{{-d, 0.0}, {-e, 0.0}}, {MatrixXc::Constant(1, 1, d / (d - e)), MatrixXc::Constant(1, 1, -e / (d - e))}}});
  CHECK(fit.states() == 2);
  const StateSpaceRadiation radiation(fit);
  Marched run(radiation);
  VectorX V = VectorX::Zero(6);
  run.start(V);
  double t = 0.0;
  for (double h : {0.3, 0.01, 0.002, 1.7, 0.4}) {
    t += h;
    V(3) = t;
    const VectorX F = run.step(h, V);
    // int_0^t exp(-a s)(t - s) ds = t/a - (1 - exp(-a t))/a^2
    const auto ramp = [&](double a) { return t / a - (1.0 - std::exp(-a * t)) / (a * a); };
    CHECK(F(3) == Approx(-(d * ramp(d) - e * ramp(e)) / (d - e)).epsilon(1e-12));
    CHECK(F.norm() == std::abs(F(3)));
  }
}

TEST_CASE("a state space leaves no trace of a failed step, and D is the derivative", "[state_space]") {
  const ResonantRadiation truth = surge_pitch_heave();
  const StateSpaceRadiation radiation(exact_fit(truth));
  const Pieces V(6, 5, 8);
  Marched run(radiation), once(radiation);
  run.start(V.corner[1]);
  once.start(V.corner[1]);
  run.step(0.05, V.corner[2]);
  once.step(0.05, V.corner[2]);
  const std::vector<double> before = run.state();
  VectorX moved = V.corner[3];
  const VectorX F0 = run.try_step(0.08, moved);
  moved(4) += 0.5;
  const VectorX F1 = run.try_step(0.08, moved);
  CHECK((run.D().col(4) + (F1 - F0) / 0.5).norm() < 1e-9 * run.D().col(4).norm());
  // D -> K(0) h/2 for short steps, from above since K falls: sign and size.
  run.try_step(1e-4, moved);
  CHECK((run.D() - 0.5e-4 * truth.kernel(0.0)).norm() < 1e-3 * run.D().norm());
  CHECK(run.state() == before);
  // A step ended with another length than the last one tried.
  run.end_step(V.corner[3], 0.04);
  once.step(0.04, V.corner[3]);
  CHECK(run.state() == once.state());
  VectorX D(36);
  radiation.instantaneous_damping({D.data(), 36});
  CHECK(D.isZero(0.0));
}

TEST_CASE("a motion that starts with a velocity has no past", "[state_space]") {
  const ResonantRadiation truth = surge_pitch_heave();
  const StateSpaceRadiation radiation(exact_fit(truth));
  Marched run(radiation);
  VectorX V = VectorX::Zero(6);
  V(2) = 1.5;
  run.start(V);
  CHECK(run.force_now(V).isZero(0.0));
  // Afterwards constant: F = -V int_0^t K; its value at first is -K(0) V t.
  CHECK(run.step(1e-3, V)(2) == Approx(-truth.kernel(0.0)(2, 2) * 1.5e-3).epsilon(1e-3));
  for (int n = 0; n < 2000; ++n) run.step(0.1, V);
  // B(0) = 0: steady motion is not opposed.
  CHECK(std::abs(run.force_now(V)(2)) < 1e-9 * truth.kernel(0.0)(2, 2));
}

TEST_CASE("state space and retardation functions of the crane hull agree", "[state_space]") {
  const HydrodynamicCoefficients c = read_coefficient_file(STILLHOOK_SOURCE_DIR "/problems/hulls/crane_110x46x4.csv");
  const StateSpaceModel model = fit_state_space(c);
  const StateSpaceRadiation radiation(model.fit);
  const RadiationMemory memory(c.retardation, 6);
  Marched reduced(radiation), whole(memory);
  // An irregular motion with periods of 5 to 20 s, in all modes at once.
  std::mt19937 random(4);
  std::uniform_real_distribution<double> phase(0.0, 6.283), frequency(0.31, 1.26);
  MatrixX w = MatrixX::NullaryExpr(6, 20, [&] { return frequency(random); });
  MatrixX e = MatrixX::NullaryExpr(6, 20, [&] { return phase(random); });
  const auto velocity = [&](double t) {
    const double ramp = t < 20.0 ? 0.5 * (1.0 - std::cos(t * 3.14159265 / 20.0)) : 1.0;
    VectorX V(6);
    for (int i = 0; i < 6; ++i) V(i) = ramp * (i < 3 ? 1.0 : 0.02) * (w.row(i) * t + e.row(i)).array().cos().sum();
    return V;
  };
  reduced.start(VectorX::Zero(6));
  whole.start(VectorX::Zero(6));
  VectorX error = VectorX::Zero(6), size = VectorX::Zero(6);
  const double h = 0.05;
  for (int n = 1; n < 12000; ++n) {
    const VectorX V = velocity(n * h);
    const VectorX F = whole.step(h, V);
    error += (reduced.step(h, V) - F).cwiseAbs2();
    size += F.cwiseAbs2();
  }
  for (int i = 0; i < 6; ++i) {
    INFO("mode " << i + 1 << ": " << std::sqrt(error(i) / size(i)));
    // The tolerance of the fit is 1 % rms over 0..3 rad/s; the motion sees a part of that band, where the error may be
    // half as large again.
    CHECK(error(i) < 0.015 * 0.015 * size(i));
  }
}

TEST_CASE("no motion draws energy from the state space", "[state_space]") {
  const HydrodynamicCoefficients c = read_coefficient_file(STILLHOOK_SOURCE_DIR "/problems/hulls/crane_110x46x4.csv");
  const StateSpaceModel model = fit_state_space(c);
  const StateSpaceRadiation radiation(model.fit);
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Pieces V(6, 60, seed);
    V.length = 0.3 * seed;  // slow and fast motions
    Marched run(radiation);
    run.start(V.at(0.0));
    // Simpson's rule over two short steps; the integrand varies with V's pieces and the fastest pole.
    const int cells = 40 * static_cast<int>(std::ceil(V.length));
    const double h = V.length / (2 * cells);
    double work = 0.0, absolute = 0.0, worst = 0.0, t = 0.0, power = 0.0;
    for (int n = 0; n < cells * 60; ++n) {
      const double first = power;
      const VectorX V1 = V.at(t + h), V2 = V.at(t + 2.0 * h);
      const double middle = run.step(h, V1).dot(V1);
      power = run.step(h, V2).dot(V2);
      t += 2.0 * h;
      work += h / 3.0 * (first + 4.0 * middle + power);
      absolute += h / 3.0 * std::abs(first + 4.0 * middle + power);
      worst = std::max(worst, work);
    }
    INFO("seed " << seed << ": " << work << " of " << absolute);
    CHECK(worst <= 1e-9 * absolute);
    CHECK(work < -0.01 * absolute);
  }
}

TEST_CASE("the sampled state space is passive for equal steps", "[state_space]") {
  const HydrodynamicCoefficients c = read_coefficient_file(STILLHOOK_SOURCE_DIR "/problems/hulls/crane_110x46x4.csv");
  const StateSpaceModel model = fit_state_space(c);
  const StateSpaceRadiation radiation(model.fit);
  std::mt19937 random(2);
  std::normal_distribution<double> draw;
  for (double h : {0.02, 0.1, 0.5, 2.0, 10.0}) {
    for (int kind = 0; kind < 3; ++kind) {  // noise, a drift, the sign changing at each step
      Marched run(radiation);
      run.start(VectorX::Zero(6));
      double sum = 0.0, absolute = 0.0, worst = 0.0;
      for (int n = 1; n <= 2000; ++n) {
        VectorX V = VectorX::NullaryExpr(6, [&](Eigen::Index i) { return (i < 3 ? 1.0 : 0.02) * draw(random); });
        if (kind > 0)
          for (int i = 0; i < 6; ++i) V(i) = (i < 3 ? 1.0 : 0.02) * (i + 1) * (kind == 1 || n % 2 == 0 ? 1.0 : -1.0);
        const double power = run.step(h, V).dot(V);
        sum += power;
        absolute += std::abs(power);
        worst = std::max(worst, sum);
      }
      INFO("h " << h << " kind " << kind << ": " << sum << " of " << absolute);
      CHECK(worst <= 1e-12 * absolute);
      CHECK(sum < 0.0);
    }
  }
}

}  // namespace
}  // namespace stillhook
