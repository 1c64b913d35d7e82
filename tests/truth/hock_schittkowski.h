// Test problems with inequality constraints and their published optima: W. Hock and K. Schittkowski, "Test Examples for
// Nonlinear Programming Codes", Lecture Notes in Economics and Mathematical Systems 187, Springer 1981; numbers as
// there. Where a problem has no bounds, the box is wide around start and solution. Constraints are turned to g(x) <= 0.
#pragma once

#include <cmath>
#include <vector>

#include "problems/search/problem.h"

namespace stillhook::truth {

struct HockSchittkowski {
  SearchProblem problem;
  double optimum = 0.0;
  Eigen::VectorXd solution;
};

namespace detail {

using Vec = Eigen::VectorXd;

inline Vec vec(std::initializer_list<double> values) {
  Vec v(static_cast<Eigen::Index>(values.size()));
  Eigen::Index i = 0;
  for (const double value : values) v[i++] = value;
  return v;
}

/// `satisfied` holds the book's constraints, c(x) >= 0.
template <class F, class C>
HockSchittkowski make(const char* name, Vec lower, Vec upper, Vec start, double optimum, Vec solution, F f,
                      C satisfied) {
  HockSchittkowski hs;
  hs.problem.name = name;
  hs.problem.lower = std::move(lower);
  hs.problem.upper = std::move(upper);
  hs.problem.start = std::move(start);
  hs.optimum = optimum;
  hs.solution = std::move(solution);
  for (Eigen::Index i = 0; i < hs.problem.start.size(); ++i)
    hs.problem.variable_names.push_back(std::string("x").append(std::to_string(i + 1)));
  const Eigen::Index constraints = satisfied(hs.problem.start).size();
  for (Eigen::Index i = 0; i < constraints; ++i)
    hs.problem.constraint_names.push_back(std::string("g").append(std::to_string(i + 1)));
  hs.problem.evaluate = [f, satisfied](const Vec& x) {
    Evaluation e;
    e.usable = true;
    e.objective = f(x);
    e.constraints = -satisfied(x);
    return e;
  };
  return hs;
}

inline double squared(double v) { return v * v; }

}  // namespace detail

inline std::vector<HockSchittkowski> inequality_problems() {
  using detail::make, detail::vec, detail::squared, detail::Vec;
  const auto box = [](int n, double value) { return Vec::Constant(n, value).eval(); };
  std::vector<HockSchittkowski> all;
  all.push_back(make(
      "HS12", box(2, -10), box(2, 10), vec({0, 0}), -30.0, vec({2, 3}),
      [](const Vec& x) { return 0.5 * squared(x[0]) + squared(x[1]) - x[0] * x[1] - 7 * x[0] - 7 * x[1]; },
      [](const Vec& x) { return vec({25 - 4 * squared(x[0]) - squared(x[1])}); }));
  all.push_back(make(
      "HS24", box(2, 0), box(2, 10), vec({1, 0.5}), -1.0, vec({3, std::sqrt(3.0)}),
      [](const Vec& x) { return (squared(x[0] - 3) - 9) * std::pow(x[1], 3) / (27 * std::sqrt(3.0)); },
      [](const Vec& x) {
        const double r = std::sqrt(3.0);
        return vec({x[0] / r - x[1], x[0] + r * x[1], 6 - x[0] - r * x[1]});
      }));
  all.push_back(make(
      "HS35", box(3, 0), box(3, 5), vec({0.5, 0.5, 0.5}), 1.0 / 9.0, vec({4.0 / 3, 7.0 / 9, 4.0 / 9}),
      [](const Vec& x) {
        return 9 - 8 * x[0] - 6 * x[1] - 4 * x[2] + 2 * squared(x[0]) + 2 * squared(x[1]) + squared(x[2]) +
               2 * x[0] * x[1] + 2 * x[0] * x[2];
      },
      [](const Vec& x) { return vec({3 - x[0] - x[1] - 2 * x[2]}); }));
  all.push_back(make(
      "HS43", box(4, -5), box(4, 5), box(4, 0), -44.0, vec({0, 1, 2, -1}),
      [](const Vec& x) {
        return squared(x[0]) + squared(x[1]) + 2 * squared(x[2]) + squared(x[3]) - 5 * x[0] - 5 * x[1] - 21 * x[2] +
               7 * x[3];
      },
      [](const Vec& x) {
        return vec({8 - x.squaredNorm() - x[0] + x[1] - x[2] + x[3],
                    10 - squared(x[0]) - 2 * squared(x[1]) - squared(x[2]) - 2 * squared(x[3]) + x[0] + x[3],
                    5 - 2 * squared(x[0]) - squared(x[1]) - squared(x[2]) - 2 * x[0] + x[1] + x[3]});
      }));
  all.push_back(make(
      "HS65", vec({-4.5, -4.5, -5}), vec({4.5, 4.5, 5}), vec({-4.5, 4.5, 0}), 0.9535288567,
      vec({3.650461821, 3.65046168, 4.6204170507}),
      [](const Vec& x) { return squared(x[0] - x[1]) + squared(x[0] + x[1] - 10) / 9 + squared(x[2] - 5); },
      [](const Vec& x) { return vec({48 - x.squaredNorm()}); }));
  all.push_back(make(
      "HS76", box(4, 0), box(4, 5), box(4, 0.5), -4.681818181, vec({0.2727273, 2.090909, 0, 0.5454545}),
      [](const Vec& x) {
        return squared(x[0]) + 0.5 * squared(x[1]) + squared(x[2]) + 0.5 * squared(x[3]) - x[0] * x[2] + x[2] * x[3] -
               x[0] - 3 * x[1] + x[2] - x[3];
      },
      [](const Vec& x) {
        return vec({5 - x[0] - 2 * x[1] - x[2] - x[3], 4 - 3 * x[0] - x[1] - 2 * x[2] + x[3], x[1] + 4 * x[2] - 1.5});
      }));
  all.push_back(make(
      "HS100", box(7, -10), box(7, 10), vec({1, 2, 0, 4, 0, 1, 1}), 680.6300573,
      vec({2.330499, 1.951372, -0.4775414, 4.365726, -0.6244870, 1.038131, 1.594227}),
      [](const Vec& x) {
        return squared(x[0] - 10) + 5 * squared(x[1] - 12) + std::pow(x[2], 4) + 3 * squared(x[3] - 11) +
               10 * std::pow(x[4], 6) + 7 * squared(x[5]) + std::pow(x[6], 4) - 4 * x[5] * x[6] - 10 * x[5] - 8 * x[6];
      },
      [](const Vec& x) {
        return vec({127 - 2 * squared(x[0]) - 3 * std::pow(x[1], 4) - x[2] - 4 * squared(x[3]) - 5 * x[4],
                    282 - 7 * x[0] - 3 * x[1] - 10 * squared(x[2]) - x[3] + x[4],
                    196 - 23 * x[0] - squared(x[1]) - 6 * squared(x[5]) + 8 * x[6],
                    -4 * squared(x[0]) - squared(x[1]) + 3 * x[0] * x[1] - 2 * squared(x[2]) - 5 * x[5] + 11 * x[6]});
      }));
  return all;
}

}  // namespace stillhook::truth
