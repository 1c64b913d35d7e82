#include "sim/hull/radiation/damping_transform.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace stillhook {
namespace {

constexpr int kPieces = 12;           // straight lines between two frequencies of the table
constexpr double kTailGrowth = 1.02;  // of the frequency from line to line in the tail
constexpr double kTailEnd = 1e-4;     // of B at the last frequency
constexpr double kLeastPower = 3.0, kLargestPower = 10.0;

/// The abscissae, and at each what must be multiplied with B to integrate B cos(w t) exactly for straight lines.
class CosineRule {
 public:
  explicit CosineRule(std::vector<double> w) : w_(std::move(w)), weight_(w_.size()) {}

  const std::vector<double>& frequencies() const { return w_; }

  const std::vector<double>& at(double t) {
    std::fill(weight_.begin(), weight_.end(), 0.0);
    for (std::size_t n = 0; n + 1 < w_.size(); ++n) {
      const double h = w_[n + 1] - w_[n], q = h * t;
      // int_0^1 (1 - u) cos(a + q u) du = C cos a - S sin a, and the mirror image from the other end.
      double C = 0.5 - q * q / 24.0, S = q / 6.0 - q * q * q / 120.0;
      if (q > 1e-2) {
        C = (1.0 - std::cos(q)) / (q * q);
        S = (1.0 - std::sin(q) / q) / q;
      }
      weight_[n] += h * (C * std::cos(w_[n] * t) - S * std::sin(w_[n] * t));
      weight_[n + 1] += h * (C * std::cos(w_[n + 1] * t) + S * std::sin(w_[n + 1] * t));
    }
    return weight_;
  }

 private:
  std::vector<double> w_, weight_;
};

/// Slopes of the monotone cubic through (x, y).
std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  std::vector<double> secant(n - 1), slope(n, 0.0);
  for (std::size_t k = 0; k + 1 < n; ++k) secant[k] = (y[k + 1] - y[k]) / (x[k + 1] - x[k]);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    if (secant[k - 1] * secant[k] <= 0.0) continue;
    // Harmonic mean weighted for uneven steps (Fritsch and Butland 1984).
    const double a = x[k] - x[k - 1], b = x[k + 1] - x[k];
    slope[k] = 3.0 * (a + b) / ((2.0 * b + a) / secant[k - 1] + (b + 2.0 * a) / secant[k]);
  }
  slope[n - 1] = secant[n - 2];  // slope[0] = 0: B begins with a power of w
  return slope;
}

struct DampingTable {
  std::vector<double> w;  // rad/s, from 0
  const std::vector<FrequencyCoefficients>* rows;
  std::size_t first;  // of the rows with w > 0

  std::vector<double> series(int i, int j) const {
    std::vector<double> y = {0.0};
    for (std::size_t f = first; f < rows->size(); ++f) y.push_back((*rows)[f].B(i, j));
    return y;
  }
};

/// n_i of the tail.
VectorX tail_powers(const DampingTable& table, int modes) {
  VectorX power = VectorX::Constant(modes, kLeastPower);
  const std::size_t n = table.w.size();
  for (int i = 0; i < modes; ++i) {
    const std::vector<double> y = table.series(i, i);
    if (y[n - 1] > 0.0 && y[n - 2] > 0.0)
      power(i) = std::clamp(-std::log(y[n - 1] / y[n - 2]) / std::log(table.w[n - 1] / table.w[n - 2]), kLeastPower,
                            kLargestPower);
  }
  return power;
}

/// B_ij at the rule's frequencies: the monotone cubic, then the tail.
std::vector<double> refined(const DampingTable& table, int i, int j, double power, const std::vector<double>& fine) {
  const std::vector<double> y = table.series(i, j), slope = monotone_slopes(table.w, y);
  const double last = table.w.back();
  std::vector<double> B;
  std::size_t k = 0;
  for (double w : fine) {
    if (w >= last) {
      B.push_back(y.back() * std::pow(last / w, power));
      continue;
    }
    while (w >= table.w[k + 1]) ++k;
    const double h = table.w[k + 1] - table.w[k], u = (w - table.w[k]) / h, v = 1.0 - u;
    B.push_back(v * v * (1.0 + 2.0 * u) * y[k] + u * u * (1.0 + 2.0 * v) * y[k + 1] +
                h * u * v * (v * slope[k] - u * slope[k + 1]));
  }
  return B;
}

std::vector<double> fine_grid(const std::vector<double>& w, double least_power) {
  std::vector<double> fine;
  for (std::size_t k = 0; k + 1 < w.size(); ++k)
    for (int p = 0; p < kPieces; ++p) fine.push_back(w[k] + (w[k + 1] - w[k]) * p / kPieces);
  const double end = w.back() * std::pow(kTailEnd, -1.0 / least_power);
  for (double x = w.back(); x < end; x *= kTailGrowth) fine.push_back(x);
  return fine;
}

}  // namespace

RetardationFunctions retardation_from_damping(const std::vector<FrequencyCoefficients>& rows,
                                              const RetardationOptions& options) {
  if (!(options.interval > 0.0) || !(options.duration > options.interval))
    throw std::invalid_argument("the interval of the retardation functions must be > 0 and below their duration");
  DampingTable table{{0.0}, &rows, !rows.empty() && rows[0].frequency == 0.0 ? 1u : 0u};
  for (std::size_t f = table.first; f < rows.size(); ++f) table.w.push_back(rows[f].frequency);
  if (table.w.size() < 4)
    throw std::invalid_argument("the damping of at least three frequencies > 0 is needed for retardation functions");
  const int modes = static_cast<int>(rows[0].B.rows());
  const VectorX power = tail_powers(table, modes);
  CosineRule rule(fine_grid(table.w, power.minCoeff()));
  RetardationFunctions K{options.interval, {}};
  std::vector<std::vector<double>> damping;
  for (int i = 0; i < modes; ++i)
    for (int j = 0; j < modes; ++j) {
      const std::vector<double> B = table.series(i, j);
      if (std::all_of(B.begin(), B.end(), [](double b) { return b == 0.0; })) continue;
      damping.push_back(refined(table, i, j, 0.5 * (power(i) + power(j)), rule.frequencies()));
      K.kernels.push_back({i, j, {}});
    }
  const int samples = static_cast<int>(std::lround(options.duration / options.interval)) + 1;
  for (int m = 0; m < samples; ++m) {
    const std::vector<double>& weight = rule.at(m * options.interval);
    for (std::size_t n = 0; n < damping.size(); ++n) {
      double sum = 0.0;
      for (std::size_t k = 0; k < weight.size(); ++k) sum += weight[k] * damping[n][k];
      K.kernels[n].value.push_back(2.0 / std::numbers::pi * sum);
    }
  }
  return K;
}

std::vector<FrequencyCoefficients> sampled(const HydrodynamicCoefficients& c, const std::vector<double>& frequencies) {
  std::vector<FrequencyCoefficients> rows;
  for (double w : frequencies)
    rows.push_back(
        {w, added_mass_from_kernels(c.A_inf, c.retardation, w), damping_from_kernels(c.retardation, c.modes(), w)});
  return rows;
}

}  // namespace stillhook
