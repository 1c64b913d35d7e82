// Test problems with their published optima and gradients by hand: W. Hock and K. Schittkowski, "Test Examples for
// Nonlinear Programming Codes", Lecture Notes in Economics and Mathematical Systems 187, Springer 1981; numbers as
// there. Where a problem has no bounds, the box is wide around start and solution. The book's c(x) >= 0 is turned to
// g = -c <= 0; equalities come first.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "problems/search/problem.h"

namespace stillhook::truth {

struct HockSchittkowski {
  SearchProblem problem;
  double optimum = 0.0;
  Eigen::VectorXd solution;  // empty where there are several
};

namespace detail {

using Vec = Eigen::VectorXd;

/// f, its gradient, the book's constraints and their gradients, row by row.
struct Values {
  double f;
  Vec df, c;
  std::vector<Vec> dc;
};

inline Vec vec(std::initializer_list<double> values) {
  Vec v(static_cast<Eigen::Index>(values.size()));
  Eigen::Index i = 0;
  for (const double value : values) v[i++] = value;
  return v;
}
inline Vec all(int n, double value) { return Vec::Constant(n, value); }
inline double squared(double v) { return v * v; }
inline double cubed(double v) { return v * v * v; }

struct Box {
  Vec lower, upper;
};

template <class F>
HockSchittkowski make(int number, Box box, Vec start, double optimum, Vec solution, int equalities, F values) {
  HockSchittkowski hs;
  hs.problem.name = "HS" + std::to_string(number);
  hs.problem.lower = std::move(box.lower);
  hs.problem.upper = std::move(box.upper);
  hs.problem.start = std::move(start);
  hs.problem.equalities = equalities;
  hs.optimum = optimum;
  hs.solution = std::move(solution);
  for (Eigen::Index i = 0; i < hs.problem.start.size(); ++i)
    hs.problem.variable_names.push_back(std::string("x").append(std::to_string(i + 1)));
  for (Eigen::Index i = 0; i < values(hs.problem.start).c.size(); ++i)
    hs.problem.constraint_names.push_back(std::string("g").append(std::to_string(i + 1)));
  hs.problem.evaluate = [values](const Vec& x) {
    Evaluation e;
    const Values v = values(x);
    e.usable = true;
    e.objective = v.f;
    e.constraints = -v.c;
    return e;
  };
  hs.problem.evaluate_with_gradient = [values, plain = hs.problem.evaluate](const Vec& x) {
    Evaluation e = plain(x);
    const Values v = values(x);
    e.gradient_valid = true;
    e.objective_gradient = v.df;
    e.constraint_jacobian.resize(v.c.size(), x.size());
    for (std::size_t i = 0; i < v.dc.size(); ++i)
      e.constraint_jacobian.row(static_cast<Eigen::Index>(i)) = -v.dc[i].transpose();
    return e;
  };
  return hs;
}

inline std::vector<HockSchittkowski> two_variables() {
  std::vector<HockSchittkowski> p;
  p.push_back(make(6, {all(2, -5), all(2, 5)}, vec({-1.2, 1}), 0.0, vec({1, 1}), 1, [](const Vec& x) {
    return Values{
        squared(1 - x[0]), vec({2 * (x[0] - 1), 0}), vec({10 * (x[1] - x[0] * x[0])}), {vec({-20 * x[0], 10})}};
  }));
  p.push_back(
      make(7, {all(2, -5), all(2, 5)}, vec({2, 2}), -std::sqrt(3.0), vec({0, std::sqrt(3.0)}), 1, [](const Vec& x) {
        const double s = 1 + squared(x[0]);
        return Values{std::log(s) - x[1],
                      vec({2 * x[0] / s, -1}),
                      vec({s * s + squared(x[1]) - 4}),
                      {vec({4 * s * x[0], 2 * x[1]})}};
      }));
  p.push_back(make(10, {all(2, -20), all(2, 20)}, vec({-10, 10}), -1.0, vec({0, 1}), 0, [](const Vec& x) {
    return Values{x[0] - x[1],
                  vec({1, -1}),
                  vec({-3 * squared(x[0]) + 2 * x[0] * x[1] - squared(x[1]) + 1}),
                  {vec({-6 * x[0] + 2 * x[1], 2 * x[0] - 2 * x[1]})}};
  }));
  p.push_back(make(11, {all(2, -10), all(2, 10)}, vec({4.9, 0.1}), -8.498464223, vec({1.234773, 1.524664}), 0,
                   [](const Vec& x) {
                     return Values{squared(x[0] - 5) + squared(x[1]) - 25,
                                   vec({2 * (x[0] - 5), 2 * x[1]}),
                                   vec({x[1] - squared(x[0])}),
                                   {vec({-2 * x[0], 1})}};
                   }));
  p.push_back(make(12, {all(2, -10), all(2, 10)}, all(2, 0), -30.0, vec({2, 3}), 0, [](const Vec& x) {
    return Values{0.5 * squared(x[0]) + squared(x[1]) - x[0] * x[1] - 7 * x[0] - 7 * x[1],
                  vec({x[0] - x[1] - 7, 2 * x[1] - x[0] - 7}),
                  vec({25 - 4 * squared(x[0]) - squared(x[1])}),
                  {vec({-8 * x[0], -2 * x[1]})}};
  }));
  // The book starts at (-2, -2), outside its own bounds. The constraint's gradient vanishes at the solution.
  p.push_back(make(13, {all(2, 0), all(2, 5)}, all(2, 0), 1.0, vec({1, 0}), 0, [](const Vec& x) {
    return Values{squared(x[0] - 2) + squared(x[1]),
                  vec({2 * (x[0] - 2), 2 * x[1]}),
                  vec({cubed(1 - x[0]) - x[1]}),
                  {vec({-3 * squared(1 - x[0]), -1})}};
  }));
  const double r7 = std::sqrt(7.0);
  p.push_back(make(14, {all(2, -10), all(2, 10)}, all(2, 2), 9 - 2.875 * r7, vec({0.5 * (r7 - 1), 0.25 * (r7 + 1)}), 1,
                   [](const Vec& x) {
                     return Values{squared(x[0] - 2) + squared(x[1] - 1),
                                   vec({2 * (x[0] - 2), 2 * (x[1] - 1)}),
                                   vec({x[0] - 2 * x[1] + 1, 1 - 0.25 * squared(x[0]) - squared(x[1])}),
                                   {vec({1, -2}), vec({-0.5 * x[0], -2 * x[1]})}};
                   }));
  p.push_back(make(15, {all(2, -5), vec({0.5, 5})}, vec({-2, 1}), 306.5, vec({0.5, 2}), 0, [](const Vec& x) {
    const double a = x[1] - squared(x[0]);
    return Values{100 * a * a + squared(1 - x[0]),
                  vec({-400 * a * x[0] - 2 * (1 - x[0]), 200 * a}),
                  vec({x[0] * x[1] - 1, x[0] + squared(x[1])}),
                  {vec({x[1], x[0]}), vec({1, 2 * x[1]})}};
  }));
  p.push_back(make(24, {all(2, 0), all(2, 10)}, vec({1, 0.5}), -1.0, vec({3, std::sqrt(3.0)}), 0, [](const Vec& x) {
    const double r = std::sqrt(3.0), a = 27 * r, b = squared(x[0] - 3) - 9;
    return Values{b * cubed(x[1]) / a,
                  vec({2 * (x[0] - 3) * cubed(x[1]) / a, 3 * b * squared(x[1]) / a}),
                  vec({x[0] / r - x[1], x[0] + r * x[1], 6 - x[0] - r * x[1]}),
                  {vec({1 / r, -1}), vec({1, r}), vec({-1, -r})}};
  }));
  return p;
}

inline std::vector<HockSchittkowski> three_variables() {
  std::vector<HockSchittkowski> p;
  p.push_back(make(26, {all(3, -10), all(3, 10)}, vec({-2.6, 2, 2}), 0.0, all(3, 1), 1, [](const Vec& x) {
    const double a = x[0] - x[1], b = 4 * cubed(x[1] - x[2]), s = 1 + squared(x[1]);
    return Values{a * a + std::pow(x[1] - x[2], 4),
                  vec({2 * a, -2 * a + b, -b}),
                  vec({s * x[0] + std::pow(x[2], 4) - 3}),
                  {vec({s, 2 * x[0] * x[1], 4 * cubed(x[2])})}};
  }));
  p.push_back(make(27, {all(3, -10), all(3, 10)}, all(3, 2), 0.04, vec({-1, 1, 0}), 1, [](const Vec& x) {
    const double a = x[1] - squared(x[0]);
    return Values{0.01 * squared(x[0] - 1) + a * a,
                  vec({0.02 * (x[0] - 1) - 4 * a * x[0], 2 * a, 0}),
                  vec({x[0] + squared(x[2]) + 1}),
                  {vec({1, 0, 2 * x[2]})}};
  }));
  p.push_back(make(28, {all(3, -10), all(3, 10)}, vec({-4, 1, 1}), 0.0, vec({0.5, -0.5, 0.5}), 1, [](const Vec& x) {
    const double a = 2 * (x[0] + x[1]), b = 2 * (x[1] + x[2]);
    return Values{0.25 * (a * a + b * b), vec({a, a + b, b}), vec({x[0] + 2 * x[1] + 3 * x[2] - 1}), {vec({1, 2, 3})}};
  }));
  p.push_back(make(29, {all(3, -8), all(3, 8)}, all(3, 1), -16 * std::sqrt(2.0), {}, 0, [](const Vec& x) {
    return Values{-x[0] * x[1] * x[2],
                  vec({-x[1] * x[2], -x[0] * x[2], -x[0] * x[1]}),
                  vec({48 - squared(x[0]) - 2 * squared(x[1]) - 4 * squared(x[2])}),
                  {vec({-2 * x[0], -4 * x[1], -8 * x[2]})}};
  }));
  p.push_back(
      make(35, {all(3, 0), all(3, 5)}, all(3, 0.5), 1.0 / 9.0, vec({4.0 / 3, 7.0 / 9, 4.0 / 9}), 0, [](const Vec& x) {
        return Values{9 - 8 * x[0] - 6 * x[1] - 4 * x[2] + 2 * squared(x[0]) + 2 * squared(x[1]) + squared(x[2]) +
                          2 * x[0] * x[1] + 2 * x[0] * x[2],
                      vec({-8 + 4 * x[0] + 2 * x[1] + 2 * x[2], -6 + 4 * x[1] + 2 * x[0], -4 + 2 * x[2] + 2 * x[0]}),
                      vec({3 - x[0] - x[1] - 2 * x[2]}),
                      {vec({-1, -1, -2})}};
      }));
  p.push_back(make(65, {vec({-4.5, -4.5, -5}), vec({4.5, 4.5, 5})}, vec({-4.5, 4.5, 0}), 0.9535288567,
                   vec({3.650461821, 3.65046168, 4.6204170507}), 0, [](const Vec& x) {
                     const double a = x[0] - x[1], b = (x[0] + x[1] - 10) / 9;
                     return Values{a * a + 9 * b * b + squared(x[2] - 5),
                                   vec({2 * a + 2 * b, -2 * a + 2 * b, 2 * (x[2] - 5)}),
                                   vec({48 - x.squaredNorm()}),
                                   {-2 * x}};
                   }));
  return p;
}

inline std::vector<HockSchittkowski> four_variables() {
  std::vector<HockSchittkowski> p;
  p.push_back(make(39, {all(4, -10), all(4, 10)}, all(4, 2), -1.0, vec({1, 1, 0, 0}), 2, [](const Vec& x) {
    return Values{-x[0],
                  vec({-1, 0, 0, 0}),
                  vec({x[1] - cubed(x[0]) - squared(x[2]), squared(x[0]) - x[1] - squared(x[3])}),
                  {vec({-3 * squared(x[0]), 1, -2 * x[2], 0}), vec({2 * x[0], -1, 0, -2 * x[3]})}};
  }));
  p.push_back(make(40, {all(4, -3), all(4, 3)}, all(4, 0.8), -0.25, {}, 3, [](const Vec& x) {
    return Values{-x.prod(),
                  vec({-x[1] * x[2] * x[3], -x[0] * x[2] * x[3], -x[0] * x[1] * x[3], -x[0] * x[1] * x[2]}),
                  vec({cubed(x[0]) + squared(x[1]) - 1, squared(x[0]) * x[3] - x[2], squared(x[3]) - x[1]}),
                  {vec({3 * squared(x[0]), 2 * x[1], 0, 0}), vec({2 * x[0] * x[3], 0, -1, squared(x[0])}),
                   vec({0, -1, 0, 2 * x[3]})}};
  }));
  p.push_back(make(43, {all(4, -5), all(4, 5)}, all(4, 0), -44.0, vec({0, 1, 2, -1}), 0, [](const Vec& x) {
    return Values{
        squared(x[0]) + squared(x[1]) + 2 * squared(x[2]) + squared(x[3]) - 5 * x[0] - 5 * x[1] - 21 * x[2] + 7 * x[3],
        vec({2 * x[0] - 5, 2 * x[1] - 5, 4 * x[2] - 21, 2 * x[3] + 7}),
        vec({8 - x.squaredNorm() - x[0] + x[1] - x[2] + x[3],
             10 - squared(x[0]) - 2 * squared(x[1]) - squared(x[2]) - 2 * squared(x[3]) + x[0] + x[3],
             5 - 2 * squared(x[0]) - squared(x[1]) - squared(x[2]) - 2 * x[0] + x[1] + x[3]}),
        {vec({-2 * x[0] - 1, -2 * x[1] + 1, -2 * x[2] - 1, -2 * x[3] + 1}),
         vec({-2 * x[0] + 1, -4 * x[1], -2 * x[2], -4 * x[3] + 1}), vec({-4 * x[0] - 2, -2 * x[1] + 1, -2 * x[2], 1})}};
  }));
  p.push_back(make(
      71, {all(4, 1), all(4, 5)}, vec({1, 5, 5, 1}), 17.0140173, vec({1, 4.7429994, 3.8211503, 1.3794082}), 1,
      [](const Vec& x) {
        const double s = x[0] + x[1] + x[2];
        return Values{x[0] * x[3] * s + x[2],
                      vec({x[3] * (s + x[0]), x[0] * x[3], x[0] * x[3] + 1, x[0] * s}),
                      vec({x.squaredNorm() - 40, x.prod() - 25}),
                      {2 * x, vec({x[1] * x[2] * x[3], x[0] * x[2] * x[3], x[0] * x[1] * x[3], x[0] * x[1] * x[2]})}};
      }));
  p.push_back(make(76, {all(4, 0), all(4, 5)}, all(4, 0.5), -4.681818181, vec({0.2727273, 2.090909, 0, 0.5454545}), 0,
                   [](const Vec& x) {
                     return Values{squared(x[0]) + 0.5 * squared(x[1]) + squared(x[2]) + 0.5 * squared(x[3]) -
                                       x[0] * x[2] + x[2] * x[3] - x[0] - 3 * x[1] + x[2] - x[3],
                                   vec({2 * x[0] - x[2] - 1, x[1] - 3, 2 * x[2] - x[0] + x[3] + 1, x[3] + x[2] - 1}),
                                   vec({5 - x[0] - 2 * x[1] - x[2] - x[3], 4 - 3 * x[0] - x[1] - 2 * x[2] + x[3],
                                        x[1] + 4 * x[2] - 1.5}),
                                   {vec({-1, -2, -1, -1}), vec({-3, -1, -2, 1}), vec({0, 1, 4, 0})}};
                   }));
  return p;
}

inline std::vector<HockSchittkowski> five_variables() {
  std::vector<HockSchittkowski> p;
  p.push_back(make(48, {all(5, -10), all(5, 10)}, vec({3, 5, -3, 2, -2}), 0.0, all(5, 1), 2, [](const Vec& x) {
    const double a = x[0] - 1, b = x[1] - x[2], d = x[3] - x[4];
    return Values{a * a + b * b + d * d,
                  2 * vec({a, b, -b, d, -d}),
                  vec({x.sum() - 5, x[2] - 2 * (x[3] + x[4]) + 3}),
                  {all(5, 1), vec({0, 0, 1, -2, -2})}};
  }));
  p.push_back(make(49, {all(5, -20), all(5, 20)}, vec({10, 7, 2, -3, 0.8}), 0.0, all(5, 1), 2, [](const Vec& x) {
    const double a = x[0] - x[1], b = x[2] - 1, d = x[3] - 1, e = x[4] - 1;
    return Values{a * a + b * b + std::pow(d, 4) + std::pow(e, 6),
                  vec({2 * a, -2 * a, 2 * b, 4 * cubed(d), 6 * std::pow(e, 5)}),
                  vec({x[0] + x[1] + x[2] + 4 * x[3] - 7, x[2] + 5 * x[4] - 6}),
                  {vec({1, 1, 1, 4, 0}), vec({0, 0, 1, 0, 5})}};
  }));
  p.push_back(make(50, {all(5, -50), all(5, 50)}, vec({35, -31, 11, 5, -5}), 0.0, all(5, 1), 3, [](const Vec& x) {
    const double a = x[0] - x[1], b = x[1] - x[2], d = x[2] - x[3], e = x[3] - x[4];
    return Values{a * a + b * b + std::pow(d, 4) + e * e,
                  vec({2 * a, -2 * a + 2 * b, -2 * b + 4 * cubed(d), -4 * cubed(d) + 2 * e, -2 * e}),
                  vec({x[0] + 2 * x[1] + 3 * x[2] - 6, x[1] + 2 * x[2] + 3 * x[3] - 6, x[2] + 2 * x[3] + 3 * x[4] - 6}),
                  {vec({1, 2, 3, 0, 0}), vec({0, 1, 2, 3, 0}), vec({0, 0, 1, 2, 3})}};
  }));
  p.push_back(make(51, {all(5, -10), all(5, 10)}, vec({2.5, 0.5, 2, -1, 0.5}), 0.0, all(5, 1), 3, [](const Vec& x) {
    const double a = x[0] - x[1], b = x[1] + x[2] - 2, d = x[3] - 1, e = x[4] - 1;
    return Values{a * a + b * b + d * d + e * e,
                  2 * vec({a, b - a, b, d, e}),
                  vec({x[0] + 3 * x[1] - 4, x[2] + x[3] - 2 * x[4], x[1] - x[4]}),
                  {vec({1, 3, 0, 0, 0}), vec({0, 0, 1, 1, -2}), vec({0, 1, 0, 0, -1})}};
  }));
  return p;
}

inline Values values_100(const Vec& x) {
  return {squared(x[0] - 10) + 5 * squared(x[1] - 12) + std::pow(x[2], 4) + 3 * squared(x[3] - 11) +
              10 * std::pow(x[4], 6) + 7 * squared(x[5]) + std::pow(x[6], 4) - 4 * x[5] * x[6] - 10 * x[5] - 8 * x[6],
          vec({2 * (x[0] - 10), 10 * (x[1] - 12), 4 * cubed(x[2]), 6 * (x[3] - 11), 60 * std::pow(x[4], 5),
               14 * x[5] - 4 * x[6] - 10, 4 * cubed(x[6]) - 4 * x[5] - 8}),
          vec({127 - 2 * squared(x[0]) - 3 * std::pow(x[1], 4) - x[2] - 4 * squared(x[3]) - 5 * x[4],
               282 - 7 * x[0] - 3 * x[1] - 10 * squared(x[2]) - x[3] + x[4],
               196 - 23 * x[0] - squared(x[1]) - 6 * squared(x[5]) + 8 * x[6],
               -4 * squared(x[0]) - squared(x[1]) + 3 * x[0] * x[1] - 2 * squared(x[2]) - 5 * x[5] + 11 * x[6]}),
          {vec({-4 * x[0], -12 * cubed(x[1]), -1, -8 * x[3], -5, 0, 0}), vec({-7, -3, -20 * x[2], -1, 1, 0, 0}),
           vec({-23, -2 * x[1], 0, 0, 0, -12 * x[5], 8}),
           vec({-8 * x[0] + 3 * x[1], -2 * x[1] + 3 * x[0], -4 * x[2], 0, 0, -5, 11})}};
}

/// A hexagon in the unit circle: differences of coordinates i and j, squared, in several of its constraints.
inline Values values_108(const Vec& x) {
  Values v{-0.5 * (x[0] * x[3] - x[1] * x[2] + x[2] * x[8] - x[4] * x[8] + x[4] * x[7] - x[5] * x[6]),
           -0.5 * vec({x[3], -x[2], -x[1] + x[8], x[0], -x[8] + x[7], -x[6], -x[5], x[4], x[2] - x[4]}),
           Vec(14),
           {}};
  // 1 - (x_a - x_b)^2 - (x_c - x_d)^2, -1 = nothing
  const int unit[][4] = {{2, -1, 3, -1}, {8, -1, -1, -1}, {4, -1, 5, -1}, {0, -1, 1, 8}, {0, 4, 1, 5},
                         {0, 6, 1, 7},   {2, 4, 3, 5},    {2, 6, 3, 7},   {6, -1, 7, 8}};
  const auto at = [&](int i) { return i < 0 ? 0.0 : x[i]; };
  for (const auto& [a, b, c, d] : unit) {
    const double p = at(a) - at(b), q = at(c) - at(d);
    Vec row = Vec::Zero(9);
    for (const auto& [i, slope] : {std::pair{a, -2 * p}, {b, 2 * p}, {c, -2 * q}, {d, 2 * q}})
      if (i >= 0) row[i] += slope;
    v.c[static_cast<Eigen::Index>(v.dc.size())] = 1 - p * p - q * q;
    v.dc.push_back(row);
  }
  v.c.tail(5) = vec({x[0] * x[3] - x[1] * x[2], x[2] * x[8], -x[4] * x[8], x[4] * x[7] - x[5] * x[6], x[8]});
  v.dc.push_back(vec({x[3], -x[2], -x[1], x[0], 0, 0, 0, 0, 0}));
  v.dc.push_back(vec({0, 0, x[8], 0, 0, 0, 0, 0, x[2]}));
  v.dc.push_back(vec({0, 0, 0, 0, -x[8], 0, 0, 0, -x[4]}));
  v.dc.push_back(vec({0, 0, 0, 0, x[7], -x[6], -x[5], x[4], 0}));
  v.dc.push_back(vec({0, 0, 0, 0, 0, 0, 0, 0, 1}));
  return v;
}

inline Values values_113(const Vec& x) {
  return {
      squared(x[0]) + squared(x[1]) + x[0] * x[1] - 14 * x[0] - 16 * x[1] + squared(x[2] - 10) + 4 * squared(x[3] - 5) +
          squared(x[4] - 3) + 2 * squared(x[5] - 1) + 5 * squared(x[6]) + 7 * squared(x[7] - 11) +
          2 * squared(x[8] - 10) + squared(x[9] - 7) + 45,
      vec({2 * x[0] + x[1] - 14, 2 * x[1] + x[0] - 16, 2 * (x[2] - 10), 8 * (x[3] - 5), 2 * (x[4] - 3), 4 * (x[5] - 1),
           10 * x[6], 14 * (x[7] - 11), 4 * (x[8] - 10), 2 * (x[9] - 7)}),
      vec({105 - 4 * x[0] - 5 * x[1] + 3 * x[6] - 9 * x[7], -10 * x[0] + 8 * x[1] + 17 * x[6] - 2 * x[7],
           8 * x[0] - 2 * x[1] - 5 * x[8] + 2 * x[9] + 12,
           -3 * squared(x[0] - 2) - 4 * squared(x[1] - 3) - 2 * squared(x[2]) + 7 * x[3] + 120,
           -5 * squared(x[0]) - 8 * x[1] - squared(x[2] - 6) + 2 * x[3] + 40,
           -0.5 * squared(x[0] - 8) - 2 * squared(x[1] - 4) - 3 * squared(x[4]) + x[5] + 30,
           -squared(x[0]) - 2 * squared(x[1] - 2) + 2 * x[0] * x[1] - 14 * x[4] + 6 * x[5],
           3 * x[0] - 6 * x[1] - 12 * squared(x[8] - 8) + 7 * x[9]}),
      {vec({-4, -5, 0, 0, 0, 0, 3, -9, 0, 0}), vec({-10, 8, 0, 0, 0, 0, 17, -2, 0, 0}),
       vec({8, -2, 0, 0, 0, 0, 0, 0, -5, 2}), vec({-6 * (x[0] - 2), -8 * (x[1] - 3), -4 * x[2], 7, 0, 0, 0, 0, 0, 0}),
       vec({-10 * x[0], -8, -2 * (x[2] - 6), 2, 0, 0, 0, 0, 0, 0}),
       vec({-(x[0] - 8), -4 * (x[1] - 4), 0, 0, -6 * x[4], 1, 0, 0, 0, 0}),
       vec({-2 * x[0] + 2 * x[1], -4 * (x[1] - 2) + 2 * x[0], 0, 0, -14, 6, 0, 0, 0, 0}),
       vec({3, -6, 0, 0, 0, 0, 0, 0, -24 * (x[8] - 8), 7})}};
}

inline std::vector<HockSchittkowski> many_variables() {
  std::vector<HockSchittkowski> p;
  p.push_back(make(100, {all(7, -10), all(7, 10)}, vec({1, 2, 0, 4, 0, 1, 1}), 680.6300573,
                   vec({2.330499, 1.951372, -0.4775414, 4.365726, -0.6244870, 1.038131, 1.594227}), 0, values_100));
  p.push_back(make(108, {all(9, -3), all(9, 3)}, all(9, 1), -0.5 * std::sqrt(3.0), {}, 0, values_108));
  p.push_back(
      make(113, {all(10, -5), all(10, 20)}, vec({2, 3, 5, 5, 1, 2, 7, 3, 6, 10}), 24.3062091,
           vec({2.171996, 2.363683, 8.773926, 5.095984, 0.9906548, 1.430574, 1.321644, 9.828726, 8.280092, 8.375927}),
           0, values_113));
  return p;
}

}  // namespace detail

/// Problems 6, 7, 10-15, 24, 26-29, 35, 39, 40, 43, 48-51, 65, 71, 76, 100, 108 and 113, by number of variables.
inline std::vector<HockSchittkowski> hock_schittkowski_problems() {
  std::vector<HockSchittkowski> all;
  for (auto&& part : {detail::two_variables(), detail::three_variables(), detail::four_variables(),
                      detail::five_variables(), detail::many_variables()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

inline HockSchittkowski hock_schittkowski(int number) {
  for (HockSchittkowski& hs : hock_schittkowski_problems())
    if (hs.problem.name == "HS" + std::to_string(number)) return hs;
  throw std::out_of_range("no such problem here");
}

/// Those with inequalities only that a search without gradients reaches from the published start.
inline std::vector<HockSchittkowski> inequality_problems() {
  std::vector<HockSchittkowski> all;
  for (const int number : {12, 24, 35, 43, 65, 76, 100}) all.push_back(hock_schittkowski(number));
  return all;
}

}  // namespace stillhook::truth
