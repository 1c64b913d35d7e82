#include "problems/search/problem.h"

#include <cmath>
#include <cstddef>

namespace stillhook {
namespace {

// Objectives are sums of terms of order 1; this is far above any of them, yet small enough for a linear model through
// it (COBYLA) to keep its digits.
constexpr double kUnusableObjective = 1e4;

}  // namespace

bool better(const Evaluation& a, const Evaluation& b, double tolerance) {
  if (a.usable != b.usable) return a.usable;
  const bool a_feasible = a.violation() <= tolerance, b_feasible = b.violation() <= tolerance;
  if (a_feasible != b_feasible) return a_feasible;
  if (!a_feasible && a.violation() != b.violation()) return a.violation() < b.violation();
  return a.objective < b.objective;
}

std::string problem_fault(const SearchProblem& problem) {
  const Eigen::Index n = problem.start.size();
  if (n == 0) return "there is no variable to search over";
  if (problem.lower.size() != n || problem.upper.size() != n ||
      static_cast<Eigen::Index>(problem.variable_names.size()) != n ||
      (!problem.logarithmic.empty() && static_cast<Eigen::Index>(problem.logarithmic.size()) != n))
    return "variables, bounds and start differ in number";
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::string& name = problem.variable_names[static_cast<std::size_t>(i)];
    const double l = problem.lower[i], u = problem.upper[i], x = problem.start[i];
    if (!std::isfinite(l) || !std::isfinite(u)) return name + ": bounds must be finite";
    if (!(l < u)) return name + ": the lower bound must be below the upper one";
    if (!(x >= l && x <= u)) return name + ": the start is outside the bounds";
    if (!problem.logarithmic.empty() && problem.logarithmic[static_cast<std::size_t>(i)] && !(l > 0.0))
      return name + ": a logarithmic variable needs a lower bound > 0";
  }
  return {};
}

Evaluation sanitised(Evaluation evaluation, int constraints) {
  const bool finite = std::isfinite(evaluation.objective) && evaluation.constraints.size() == constraints &&
                      evaluation.constraints.allFinite();
  if (evaluation.usable && finite) return evaluation;
  if (finite && evaluation.objective < std::numeric_limits<double>::max()) return evaluation;  // graded by the problem
  evaluation.usable = false;
  evaluation.objective = kUnusableObjective;
  evaluation.constraints = Eigen::VectorXd::Ones(constraints);
  evaluation.gradient_valid = false;
  if (evaluation.message.empty()) evaluation.message = "objective or constraint is not a finite number";
  return evaluation;
}

UnitCube::UnitCube(const SearchProblem& problem)
    : lower_(problem.lower), upper_(problem.upper), logarithmic_(problem.logarithmic) {
  logarithmic_.resize(static_cast<std::size_t>(lower_.size()), false);
}

Eigen::VectorXd UnitCube::to_unit(const Eigen::VectorXd& x) const {
  Eigen::VectorXd z(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double share = logarithmic_[static_cast<std::size_t>(i)]
                             ? std::log(x[i] / lower_[i]) / std::log(upper_[i] / lower_[i])
                             : (x[i] - lower_[i]) / (upper_[i] - lower_[i]);
    z[i] = std::clamp(share, 0.0, 1.0);
  }
  return z;
}

Eigen::VectorXd UnitCube::from_unit(const Eigen::VectorXd& z) const {
  Eigen::VectorXd x(z.size());
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    const double share = std::clamp(z[i], 0.0, 1.0);
    const double value = logarithmic_[static_cast<std::size_t>(i)] ? lower_[i] * std::pow(upper_[i] / lower_[i], share)
                                                                   : lower_[i] + share * (upper_[i] - lower_[i]);
    x[i] = std::clamp(value, lower_[i], upper_[i]);
  }
  return x;
}

}  // namespace stillhook
