// Multipliers against known ones, and against what the optimum really gains when a limit is moved.
#include "problems/search/multipliers.h"

#include <catch2/catch.hpp>

#include "problems/search/solve.h"
#include "tests/problems/search_problems.h"
#include "tests/truth/hock_schittkowski.h"

using namespace stillhook;

namespace {

SearchReport solved(const SearchProblem& problem, const std::string& solver = "ipopt") {
  SolveOptions options;
  options.solver = solver;
  options.optimality_tolerance = 1e-9;
  options.x_tolerance = 1e-9;
  options.evaluations = 400;
  return solve(problem, options);
}

/// The problem with constraint i relaxed to g_i <= by.
SearchProblem relaxed(const SearchProblem& problem, Eigen::Index i, double by) {
  SearchProblem result = problem;
  result.evaluate_with_gradient = [evaluate = problem.evaluate_with_gradient, i, by](const Eigen::VectorXd& x) {
    Evaluation e = evaluate(x);
    e.constraints[i] -= by;
    return e;
  };
  return result;
}

Multipliers at_optimum(const SearchProblem& problem, const SearchReport& report) {
  return multipliers_at(problem, report.best_x, sanitised(problem.evaluate_with_gradient(report.best_x), problem));
}

}  // namespace

TEST_CASE("multipliers are what moving a limit gains") {
  for (const int number : {43, 71, 76}) {
    const SearchProblem problem = truth::hock_schittkowski(number).problem;
    const SearchReport report = solved(problem);
    const Multipliers m = at_optimum(problem, report);
    CAPTURE(problem.name, m.constraints.transpose(), m.residual);
    CHECK(m.residual < 1e-4);
    for (Eigen::Index i = 0; i < m.constraints.size(); ++i) {
      // Second derivatives of the optimum are of the order of the multipliers, so a central difference over 2e-3 is
      // right to 1e-5 of them; the optima themselves are good to 1e-8, thus 1e-5.
      constexpr double kBy = 1e-3;
      const double gain =
          (solved(relaxed(problem, i, -kBy)).best.objective - solved(relaxed(problem, i, kBy)).best.objective) /
          (2 * kBy);
      CHECK(m.constraints[i] == Approx(gain).epsilon(2e-3).margin(2e-3));
      if (i >= problem.equalities) CHECK(m.constraints[i] >= 0.0);
    }
  }
}

TEST_CASE("known multipliers: HS43 and HS71") {
  // HS43: grad f + lambda grad g = 0 at (0, 1, 2, -1) with the first and third constraint active: 1 and 2 (by hand).
  const SearchProblem problem = truth::hock_schittkowski(43).problem;
  const Eigen::VectorXd x = vec({0, 1, 2, -1});
  const Multipliers m = multipliers_at(problem, x, problem.evaluate_with_gradient(x));
  CHECK(m.residual < 1e-12);
  CHECK(m.constraints[0] == Approx(1.0));
  CHECK(m.constraints[1] == 0.0);
  CHECK(m.constraints[2] == Approx(2.0));
  CHECK(m.bounds.norm() == 0.0);
  // HS71: x1 lies on its lower bound and would like to go on; published multiplier of the bound 1.0879.
  const SearchProblem hs71 = truth::hock_schittkowski(71).problem;
  const Multipliers n = at_optimum(hs71, solved(hs71));
  CHECK(n.bounds[0] == Approx(-1.0879).epsilon(1e-3));
  CHECK(n.bounds.tail(3).norm() == 0.0);
  CHECK(n.constraints[0] ==
        Approx(-0.1615).epsilon(1e-3));  // published for the sum of squares less 40, here 40 less it
  CHECK(n.constraints[1] == Approx(0.5523).epsilon(1e-3));
}

TEST_CASE("the residual tells an optimum from another point; a gradient is needed") {
  const SearchProblem problem = truth::hock_schittkowski(43).problem;
  const Eigen::VectorXd x = vec({0.2, 0.9, 1.8, -0.8});
  CHECK(multipliers_at(problem, x, problem.evaluate_with_gradient(x)).residual > 0.1);
  CHECK_THROWS_AS(multipliers_at(problem, x, problem.evaluate(x)), std::invalid_argument);
  // Where the objective wants to leave the limit by itself, the limit is worth nothing.
  SearchProblem away = bowl();
  away.constraint_names = {"limit"};
  away.evaluate_with_gradient = [evaluate = away.evaluate_with_gradient](const Eigen::VectorXd& at) {
    Evaluation e = evaluate(at);
    e.constraints = vec({at[0] - 4});
    e.constraint_jacobian = Eigen::RowVector3d(1, 0, 0);
    return e;
  };
  const Eigen::VectorXd on_it = vec({4, 0, 0});
  CHECK(multipliers_at(away, on_it, away.evaluate_with_gradient(on_it)).constraints[0] == 0.0);
}
