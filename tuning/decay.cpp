#include "tuning/decay.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace stillhook {
namespace {

constexpr double kSmallest = 0.05;  // of the first amplitude
constexpr double kHysteresis = 0.02;  // of the span: smaller turns are noise

struct Turn {
  double time, value;
};

struct Series {
  std::vector<double> time, value;
};

Series valid_part(const std::vector<double>& time, const std::vector<double>& value) {
  Series s;
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (std::isnan(value[i])) continue;
    s.time.push_back(time[i]);
    s.value.push_back(value[i]);
  }
  return s;
}

/// The extreme near sample i, by the parabola through its neighbours within a few samples.
Turn refined(const Series& s, std::size_t i, std::size_t reach) {
  const std::size_t low = i < reach ? 0 : i - reach, high = std::min(s.time.size() - 1, i + reach);
  if (high - low < 2) return {s.time[i], s.value[i]};
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t k = low; k <= high; ++k) {
    const double t = s.time[k] - s.time[i];
    const Eigen::Vector3d basis(1.0, t, t * t);
    normal += basis * basis.transpose();
    right += s.value[k] * basis;
  }
  const Eigen::Vector3d c = normal.ldlt().solve(right);
  if (c[2] == 0.0) return {s.time[i], s.value[i]};
  const double t = -c[1] / (2.0 * c[2]);
  if (s.time[i] + t < s.time[low] || s.time[i] + t > s.time[high]) return {s.time[i], s.value[i]};
  return {s.time[i] + t, c[0] + c[1] * t + c[2] * t * t};
}

/// Maxima and minima in turn; a turn counts once the motion has gone back by the hysteresis.
std::vector<Turn> turns_of(const Series& s) {
  const auto [low, high] = std::minmax_element(s.value.begin(), s.value.end());
  const double least = kHysteresis * (*high - *low);
  std::vector<std::size_t> at;
  int direction = 0;
  std::size_t candidate = 0;
  for (std::size_t i = 1; i < s.value.size(); ++i) {
    const double change = s.value[i] - s.value[candidate];
    if (direction == 0) {
      if (std::abs(change) > least) direction = change > 0.0 ? 1 : -1, candidate = i;
    } else if (change * direction >= 0.0) {
      candidate = i;
    } else if (std::abs(change) > least) {
      at.push_back(candidate);
      direction = -direction;
      candidate = i;
    }
  }
  std::vector<Turn> turns;
  for (std::size_t n = 0; n < at.size(); ++n) {
    const std::size_t half = n + 1 < at.size() ? at[n + 1] - at[n] : (n > 0 ? at[n] - at[n - 1] : 4);
    turns.push_back(refined(s, at[n], std::max<std::size_t>(1, half / 6)));
  }
  return turns;
}

/// Least squares of decrement = p + q A with neither negative.
void fit_line(DecayLine& line) {
  double n = 0.0, A = 0.0, AA = 0.0, D = 0.0, AD = 0.0;
  for (const DecayCycle& c : line.cycles) {
    n += 1.0;
    A += c.amplitude;
    AA += c.amplitude * c.amplitude;
    D += c.decrement;
    AD += c.amplitude * c.decrement;
  }
  const double det = n * AA - A * A;
  line.q = det > 1e-12 * n * AA ? (n * AD - A * D) / det : 0.0;
  line.p = (D - line.q * A) / n;
  if (line.q < 0.0) {
    line.q = 0.0;
    line.p = D / n;
  } else if (line.p < 0.0) {
    line.p = 0.0;
    line.q = AD / AA;
  }
  line.p = std::max(0.0, line.p);
}

}  // namespace

double DecayLine::linear(double inertia) const { return p * inertia * 2.0 / period; }
double DecayLine::quadratic(double inertia) const { return 3.0 / 8.0 * q * inertia; }

DecayLine analyse_decay(const std::vector<double>& time, const std::vector<double>& value) {
  DecayLine line;
  const Series s = valid_part(time, value);
  const auto none = [&line](const char* why) {
    line.message = why;
    return line;
  };
  if (s.time.size() < 10) return none("there are too few samples");
  std::vector<Turn> turns = turns_of(s);
  if (turns.size() < 4) return none("there are fewer than four turns");
  // Half the distance of neighbouring turns is an amplitude free of any offset.
  std::vector<double> amplitude;
  for (std::size_t i = 1; i < turns.size(); ++i) amplitude.push_back(0.5 * std::abs(turns[i].value - turns[i - 1].value));
  std::size_t count = 1;
  while (count < amplitude.size() && amplitude[count] > kSmallest * amplitude.front()) ++count;
  if (count < 3) return none("it dies out within a cycle and a half");
  double period = 0.0, centre = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    period += 2.0 * (turns[i + 1].time - turns[i].time) / static_cast<double>(count);
    centre += 0.5 * (turns[i + 1].value + turns[i].value) / static_cast<double>(count);
  }
  line.period = period;
  line.centre = centre;
  for (std::size_t i = 1; i + 1 < count; ++i) {
    // Over the cycle from the half cycle before to the one after.
    const double mean = 0.5 * (amplitude[i - 1] + amplitude[i + 1]);
    line.cycles.push_back({mean, (amplitude[i - 1] - amplitude[i + 1]) / mean});
  }
  if (line.cycles.empty()) return none("it dies out within two cycles");
  fit_line(line);
  return line;
}

}  // namespace stillhook
