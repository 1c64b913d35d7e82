#include "problems/search/multipliers.h"

#include <cmath>
#include <stdexcept>

namespace stillhook {
namespace {

/// Minimises |A y - b| with y_i >= 0 where not_negative[i]: the active-set method of Lawson & Hanson.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                              const std::vector<bool>& not_negative) {
  const Eigen::Index n = A.cols();
  Eigen::VectorXd y = Eigen::VectorXd::Zero(n);
  std::vector<bool> free(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i) free[static_cast<std::size_t>(i)] = !not_negative[static_cast<std::size_t>(i)];
  const auto solve_free = [&] {
    std::vector<Eigen::Index> columns;
    for (Eigen::Index i = 0; i < n; ++i)
      if (free[static_cast<std::size_t>(i)]) columns.push_back(i);
    Eigen::VectorXd full = Eigen::VectorXd::Zero(n);
    if (columns.empty()) return full;
    const Eigen::MatrixXd part = A(Eigen::all, columns);
    const Eigen::VectorXd solution = part.completeOrthogonalDecomposition().solve(b);
    full(columns) = solution;
    return full;
  };
  y = solve_free();
  const double tolerance = 1e-12 * std::max(1.0, A.norm()) * std::max(1.0, b.norm());
  for (Eigen::Index round = 0; round < 3 * n; ++round) {
    // The one that wants to grow most becomes free.
    const Eigen::VectorXd wish = A.transpose() * (b - A * y);
    Eigen::Index most = -1;
    for (Eigen::Index i = 0; i < n; ++i)
      if (!free[static_cast<std::size_t>(i)] && wish[i] > tolerance && (most < 0 || wish[i] > wish[most])) most = i;
    if (most < 0) break;
    free[static_cast<std::size_t>(most)] = true;
    // Towards the least squares of the free ones, as far as the signs allow; those that reach zero are held there.
    for (Eigen::VectorXd target = solve_free();; target = solve_free()) {
      double step = 1.0;
      for (Eigen::Index i = 0; i < n; ++i)
        if (free[static_cast<std::size_t>(i)] && not_negative[static_cast<std::size_t>(i)] && target[i] <= 0.0)
          step = std::min(step, y[i] / (y[i] - target[i]));
      y += step * (target - y);
      if (step >= 1.0) break;
      for (Eigen::Index i = 0; i < n; ++i)
        if (not_negative[static_cast<std::size_t>(i)] && free[static_cast<std::size_t>(i)] && y[i] <= tolerance) {
          free[static_cast<std::size_t>(i)] = false;
          y[i] = 0.0;
        }
    }
  }
  return y;
}

}  // namespace

Multipliers multipliers_at(const SearchProblem& problem, const Eigen::VectorXd& x, const Evaluation& evaluation,
                           double activity) {
  if (!evaluation.gradient_valid) throw std::invalid_argument("multipliers need a valid gradient");
  const UnitCube cube(problem);
  const Eigen::VectorXd z = cube.to_unit(x), slope = cube.slope(x);
  const Eigen::VectorXd gradient = evaluation.objective_gradient.cwiseProduct(slope);
  // One column for each active constraint, then for each active bound; all but equalities with a sign.
  struct Column {
    Eigen::Index index;
    double sign;  // 0 of a constraint
  };
  std::vector<Column> columns;
  for (Eigen::Index i = 0; i < evaluation.constraints.size(); ++i)
    if (i < problem.equalities || evaluation.constraints[i] >= -activity) columns.push_back({i, 0.0});
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    if (z[j] <= activity) columns.push_back({j, -1.0});
    if (z[j] >= 1.0 - activity) columns.push_back({j, 1.0});
  }
  const Eigen::Index count = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(x.size(), count);
  std::vector<bool> not_negative;
  for (Eigen::Index k = 0; k < count; ++k) {
    const Column& column = columns[static_cast<std::size_t>(k)];
    if (column.sign == 0.0)
      A.col(k) = evaluation.constraint_jacobian.row(column.index).transpose().cwiseProduct(slope);
    else
      A(column.index, k) = column.sign;
    not_negative.push_back(column.sign != 0.0 || column.index >= problem.equalities);
  }
  const Eigen::VectorXd y = count ? least_squares(A, -gradient, not_negative) : Eigen::VectorXd();
  Multipliers result;
  result.constraints = Eigen::VectorXd::Zero(evaluation.constraints.size());
  result.bounds = Eigen::VectorXd::Zero(x.size());
  for (Eigen::Index k = 0; k < count; ++k) {
    const Column& column = columns[static_cast<std::size_t>(k)];
    if (column.sign == 0.0)
      result.constraints[column.index] = y[k];
    else
      result.bounds[column.index] += column.sign * y[k] / slope[column.index];
  }
  const Eigen::VectorXd left = count ? Eigen::VectorXd(gradient + A * y) : gradient;
  const double size = gradient.norm();
  result.residual = size > 0.0 ? left.norm() / size : 0.0;
  return result;
}

}  // namespace stillhook
