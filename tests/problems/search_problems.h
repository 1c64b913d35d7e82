// Small problems for the tests of the search.
#pragma once

#include <functional>
#include <string>

#include "problems/search/problem.h"

namespace stillhook {

inline Eigen::VectorXd vec(std::initializer_list<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.begin(), static_cast<Eigen::Index>(values.size()));
}

/// A problem without constraints and without gradient.
inline SearchProblem plain(Eigen::VectorXd lower, Eigen::VectorXd upper, Eigen::VectorXd start,
                           std::function<double(const Eigen::VectorXd&)> f) {
  SearchProblem problem;
  for (Eigen::Index i = 0; i < start.size(); ++i)
    problem.variable_names.push_back(std::string("v").append(std::to_string(i)));
  problem.lower = std::move(lower);
  problem.upper = std::move(upper);
  problem.start = std::move(start);
  problem.evaluate = [f = std::move(f)](const Eigen::VectorXd& x) {
    Evaluation e;
    e.usable = true;
    e.objective = f(x);
    return e;
  };
  return problem;
}

/// The same with a gradient.
inline SearchProblem smooth(Eigen::VectorXd lower, Eigen::VectorXd upper, Eigen::VectorXd start,
                            std::function<double(const Eigen::VectorXd&)> f,
                            std::function<Eigen::VectorXd(const Eigen::VectorXd&)> gradient) {
  SearchProblem problem = plain(std::move(lower), std::move(upper), std::move(start), std::move(f));
  problem.evaluate_with_gradient = [evaluate = problem.evaluate,
                                    gradient = std::move(gradient)](const Eigen::VectorXd& x) {
    Evaluation e = evaluate(x);
    e.objective_gradient = gradient(x);
    e.gradient_valid = true;
    return e;
  };
  return problem;
}

/// Three variables, one optimum with objective zero at (1, 0.5, -1.2).
inline SearchProblem bowl() {
  return smooth(
      vec({-3, -2, -4}), vec({5, 4, 3}), vec({4, -1, 2}),
      [](const Eigen::VectorXd& x) {
        return std::pow(x[0] - 1, 2) + 4 * std::pow(x[1] - 0.5, 2) + 0.5 * std::pow(x[2] + 1 + 0.2 * x[0], 2);
      },
      [](const Eigen::VectorXd& x) {
        const double c = x[2] + 1 + 0.2 * x[0];
        return vec({2 * (x[0] - 1) + 0.2 * c, 8 * (x[1] - 0.5), c});
      });
}

/// The problem, telling `asked` before every evaluation whether it is one with gradient.
inline SearchProblem watched(const SearchProblem& problem,
                             std::function<void(const Eigen::VectorXd& x, bool with_gradient)> asked) {
  SearchProblem result = problem;
  result.evaluate = [=, evaluate = problem.evaluate](const Eigen::VectorXd& x) {
    asked(x, false);
    return evaluate(x);
  };
  if (problem.evaluate_with_gradient)
    result.evaluate_with_gradient = [=, evaluate = problem.evaluate_with_gradient](const Eigen::VectorXd& x) {
      asked(x, true);
      return evaluate(x);
    };
  return result;
}

}  // namespace stillhook
