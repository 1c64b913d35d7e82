// A planning problem in closed equations, for comparing solvers without a simulator: a load on a pendulum under a
// trolley in waves, with a tagline.
//
//   l theta'' = -g theta - a(t) - g A w cos(w t) - (kp theta + kd theta') / m        theta(0) = theta'(0) = 0
//
//   a  acceleration of the trolley, from twelve rates at equal times scaled to the travel, m/s2;  A, w  waves;
//   kp, kd  gains of the tagline, both searched by their logarithm
//
//   minimise    mean of theta^2 / theta_0^2 + (kp / kp_0)^2 + (kd / kd_0)^2
//   subject to  100-norm of theta <= theta_max,  largest rate <= rate_max (in a 100-norm),
//               swing at the end <= theta_end
//
// Gradients by dual numbers through the Runge-Kutta steps: exact for the discrete problem.
#pragma once

#include <ceres/jet.h>

#include <array>
#include <cmath>

#include "problems/search/problem.h"

namespace stillhook::bench {

constexpr int kKnots = 12, kSwayVariables = kKnots + 2;

template <class T>
struct SwayValues {
  T objective;
  std::array<T, 3> constraints;
};

template <class T>
SwayValues<T> sway_values(const std::array<T, kSwayVariables>& x) {
  using std::pow;
  using std::sqrt;
  constexpr double kGravity = 9.80665, kLength = 40.0, kMass = 500.0, kTravel = 30.0, kDuration = 120.0;
  constexpr double kWaveAmplitude = 0.004, kWaveFrequency = 0.62;  // rad, rad/s
  constexpr double kStep = 0.1, kNorm = 100.0;
  const double interval = kDuration / (kKnots + 1);
  T area = T(0.0);
  for (int i = 0; i < kKnots; ++i) area += x[i] * interval;
  std::array<T, kKnots + 2> rate;
  rate.front() = rate.back() = T(0.0);
  for (int i = 0; i < kKnots; ++i) rate[i + 1] = x[i] * (kTravel / area);
  const T &kp = x[kKnots], &kd = x[kKnots + 1];

  T theta = T(0.0), speed = T(0.0), mean = T(0.0), peak = T(0.0), fastest = T(0.0);
  const int steps = static_cast<int>(std::lround(kDuration / kStep));
  const auto slope = [&](double t, int knot, const T& at, const T& at_speed) {
    const T a = (rate[knot + 1] - rate[knot]) / interval;
    return T((-kGravity * at - a - kGravity * kWaveAmplitude * std::cos(kWaveFrequency * t) -
              (kp * at + kd * at_speed) / kMass) /
             kLength);
  };
  for (int k = 0; k < steps; ++k) {
    const double t = k * kStep, h = kStep;
    const int knot = std::min(kKnots, static_cast<int>((t + 0.5 * h) / interval));
    const T v1 = slope(t, knot, theta, speed);
    const T x2 = theta + 0.5 * h * speed, s2 = speed + 0.5 * h * v1, v2 = slope(t + 0.5 * h, knot, x2, s2);
    const T x3 = theta + 0.5 * h * s2, s3 = speed + 0.5 * h * v2, v3 = slope(t + 0.5 * h, knot, x3, s3);
    const T x4 = theta + h * s3, s4 = speed + h * v3, v4 = slope(t + h, knot, x4, s4);
    theta += h / 6.0 * (speed + 2.0 * s2 + 2.0 * s3 + s4);
    speed += h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
    mean += theta * theta / static_cast<double>(steps);
    peak += pow(theta * theta / (0.03 * 0.03), kNorm / 2.0) / static_cast<double>(steps);
  }
  for (const T& r : rate) fastest += pow(r * r / (0.5 * 0.5) + 1e-30, kNorm / 2.0) / (kKnots + 2.0);
  const T w2 = T(kGravity / kLength);
  const T end = sqrt(theta * theta + speed * speed / w2 + 1e-12);
  return {mean / (0.01 * 0.01) + kp * kp / 4e6 + kd * kd / 1e8,
          {pow(peak + 1e-30, 1.0 / kNorm) - 1.0, pow(fastest, 1.0 / kNorm) - 1.0, end / 0.01 - 1.0}};
}

inline SearchProblem sway_problem() {
  using Jet = ceres::Jet<double, kSwayVariables>;
  SearchProblem problem;
  problem.name = "sway";
  problem.lower = Eigen::VectorXd::Constant(kSwayVariables, 0.05);
  problem.upper = Eigen::VectorXd::Constant(kSwayVariables, 1.0);
  problem.start = Eigen::VectorXd::Constant(kSwayVariables, 0.5);
  problem.lower.tail(2) << 1.0, 1.0;
  problem.upper.tail(2) << 1e4, 1e5;
  problem.start.tail(2) << 10.0, 100.0;
  problem.logarithmic.assign(kSwayVariables, false);
  for (int i = 0; i < kKnots; ++i) problem.variable_names.push_back("rate " + std::to_string(i + 1));
  for (const int i : {kKnots, kKnots + 1}) problem.logarithmic[static_cast<std::size_t>(i)] = true;
  problem.variable_names.insert(problem.variable_names.end(), {"kp", "kd"});
  problem.constraint_names = {"peak sway", "peak rate", "swing at the end"};
  problem.evaluate = [](const Eigen::VectorXd& x) {
    std::array<double, kSwayVariables> at;
    std::copy(x.begin(), x.end(), at.begin());
    const SwayValues<double> values = sway_values(at);
    Evaluation e;
    e.usable = true;
    e.objective = values.objective;
    e.constraints = Eigen::Map<const Eigen::VectorXd>(values.constraints.data(), 3);
    return e;
  };
  problem.evaluate_with_gradient = [](const Eigen::VectorXd& x) {
    std::array<Jet, kSwayVariables> at;
    for (int i = 0; i < kSwayVariables; ++i) at[static_cast<std::size_t>(i)] = Jet(x[i], i);
    const SwayValues<Jet> values = sway_values(at);
    Evaluation e;
    e.usable = e.gradient_valid = true;
    e.objective = values.objective.a;
    e.objective_gradient = values.objective.v;
    e.constraints.resize(3);
    e.constraint_jacobian.resize(3, kSwayVariables);
    for (int i = 0; i < 3; ++i) {
      e.constraints[i] = values.constraints[static_cast<std::size_t>(i)].a;
      e.constraint_jacobian.row(i) = values.constraints[static_cast<std::size_t>(i)].v.transpose();
    }
    return e;
  };
  return problem;
}

}  // namespace stillhook::bench
