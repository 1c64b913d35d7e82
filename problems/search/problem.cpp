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
  if (problem.equalities < 0 || problem.equalities > static_cast<int>(problem.constraint_names.size()))
    return "there are more equalities than constraints";
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

std::string start_fault(const SearchProblem& problem, const Eigen::VectorXd& x) {
  if (x.size() != problem.start.size()) return "a start has another number of variables than the problem";
  const bool inside = (x.array() >= problem.lower.array()).all() && (x.array() <= problem.upper.array()).all();
  return inside ? "" : "a start is outside the bounds";
}

Evaluation sanitised(Evaluation evaluation, const SearchProblem& problem) {
  const Eigen::Index m = static_cast<Eigen::Index>(problem.constraint_names.size()), n = problem.start.size();
  evaluation.equalities = problem.equalities;
  const bool finite =
      std::isfinite(evaluation.objective) && evaluation.constraints.size() == m && evaluation.constraints.allFinite();
  const bool graded = finite && !evaluation.usable && evaluation.objective < std::numeric_limits<double>::max();
  if (!(finite && evaluation.usable) && !graded) {
    evaluation.usable = false;
    evaluation.objective = kUnusableObjective;
    evaluation.constraints = Eigen::VectorXd::Ones(m);
    if (evaluation.message.empty()) evaluation.message = "objective or constraint is not a finite number";
  }
  const bool sizes = evaluation.objective_gradient.size() == n && evaluation.constraint_jacobian.rows() == m &&
                     (m == 0 || evaluation.constraint_jacobian.cols() == n);
  evaluation.gradient_valid = evaluation.gradient_valid && evaluation.usable && sizes &&
                              evaluation.objective_gradient.allFinite() && evaluation.constraint_jacobian.allFinite();
  return evaluation;
}

bool SearchReport::take(const Eigen::VectorXd& x, const Evaluation& evaluation, bool with_gradient,
                        double constraint_tolerance) {
  ++evaluations;
  gradients += with_gradient ? 1 : 0;
  simulations += evaluation.from_store ? 0 : 1;
  history.push_back({evaluation.objective, evaluation.violation(), evaluation.usable, with_gradient});
  if (best_evaluation != 0 && !better(evaluation, best, constraint_tolerance)) return false;
  best = evaluation;
  best_x = x;
  best_evaluation = evaluations;
  return true;
}

void SearchReport::append(const SearchReport& later, double constraint_tolerance) {
  if (later.best_evaluation != 0 && (best_evaluation == 0 || better(later.best, best, constraint_tolerance))) {
    best = later.best;
    best_x = later.best_x;
    best_evaluation = evaluations + later.best_evaluation;
  }
  evaluations += later.evaluations;
  gradients += later.gradients;
  simulations += later.simulations;
  history.insert(history.end(), later.history.begin(), later.history.end());
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

Eigen::VectorXd UnitCube::slope(const Eigen::VectorXd& x) const {
  Eigen::VectorXd slope(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    slope[i] =
        logarithmic_[static_cast<std::size_t>(i)] ? x[i] * std::log(upper_[i] / lower_[i]) : upper_[i] - lower_[i];
  return slope;
}

}  // namespace stillhook
