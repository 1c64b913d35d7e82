// One solver by name against published optima, and what each solver does when it is stopped, limited or misled.
#include "problems/search/solve.h"

#include <omp.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "problems/search/solvers.h"
#include "tests/problems/search_problems.h"
#include "tests/truth/hock_schittkowski.h"

using namespace stillhook;

namespace {

SolveOptions with(const std::string& solver, int evaluations = 500) {
  SolveOptions options;
  options.solver = solver;
  options.evaluations = evaluations;
  return options;
}

bool solved(const truth::HockSchittkowski& hs, const SearchReport& report) {
  // Within 1e-6 of every constraint; the objective to 1e-4 of its size, a hundredth of what comparisons of codes on
  // these problems ask for (Schittkowski 1987).
  return report.feasible && report.best.violation() <= 1e-6 &&
         std::abs(report.best.objective - hs.optimum) <= 1e-4 * std::max(1.0, std::abs(hs.optimum));
}

/// Names of the Hock-Schittkowski problems that a solver does not solve.
std::vector<std::string> unsolved(const std::string& solver) {
  std::vector<std::string> names;
  for (const truth::HockSchittkowski& hs : truth::hock_schittkowski_problems()) {
    const SearchReport report = solve(hs.problem, with(solver));
    if (!solved(hs, report)) {
      names.push_back(hs.problem.name);
      continue;
    }
    CAPTURE(solver, hs.problem.name);
    // In problem 108 rounding decides Ipopt's way: of forty starts 1e-15 apart it solves 33, in 67 to 459 evaluations,
    // and this start in 69 or 111, as the optimiser of the compiler rounds the problem's functions. Its bound is the
    // budget of 500.
    if (hs.problem.name != "HS108") CHECK(report.evaluations <= 100);
    CHECK(report.gradients == report.evaluations);
    CHECK(static_cast<int>(report.history.size()) == report.evaluations);
  }
  return names;
}

struct Odd : std::exception {
  const char* what() const noexcept override { return "odd"; }
};

}  // namespace

TEST_CASE("gradients and solutions of the Hock-Schittkowski problems are right") {
  const std::vector<truth::HockSchittkowski> all = truth::hock_schittkowski_problems();
  CHECK(all.size() == 27);
  for (const truth::HockSchittkowski& hs : all) {
    CAPTURE(hs.problem.name);
    Eigen::VectorXd x = hs.problem.start;
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] += 0.1 * std::sin(1.0 + static_cast<double>(i));
    const Evaluation e = hs.problem.evaluate_with_gradient(x);
    REQUIRE(e.constraint_jacobian.rows() == e.constraints.size());
    constexpr double kStep = 1e-5;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      Eigen::VectorXd plus = x, minus = x;
      plus[i] += kStep;
      minus[i] -= kStep;
      const Evaluation p = hs.problem.evaluate(plus), m = hs.problem.evaluate(minus);
      // Third derivatives of up to a thousand times the gradient, times the step squared.
      const double tolerance = 1e-7 * std::max(1.0, e.objective_gradient.norm());
      CHECK(std::abs((p.objective - m.objective) / (2 * kStep) - e.objective_gradient[i]) <= tolerance);
      const Eigen::VectorXd column = (p.constraints - m.constraints) / (2 * kStep);
      CHECK((column - e.constraint_jacobian.col(i)).norm() <= 1e-7 * std::max(1.0, e.constraint_jacobian.norm()));
    }
    if (hs.solution.size() == 0) continue;
    const Evaluation best = sanitised(hs.problem.evaluate(hs.solution), hs.problem);
    // Published with seven digits.
    CHECK(best.objective == Approx(hs.optimum).epsilon(1e-6).margin(1e-6));
    CHECK(best.violation() <= 1e-4);
  }
}

TEST_CASE("Ipopt and SLSQP solve the Hock-Schittkowski problems, all but one each") {
  // 26 of 27 are 96 %. In problem 13 the constraint's gradient vanishes at the solution: a violation of 1e-6 is worth
  // 1e-2 of the objective, which SLSQP takes, and Ipopt comes to 1.1e-4 of it very slowly.
  CHECK(unsolved("ipopt") == std::vector<std::string>{"HS13"});
  CHECK(unsolved("slsqp") == std::vector<std::string>{"HS13"});
}

namespace {

void check_solves_in_threads(int solves) {
  std::vector<truth::HockSchittkowski> all;
  for (const int number : {11, 12, 14, 24, 35, 40, 65, 71}) {
    all.push_back(truth::hock_schittkowski(number));
    // Now and then one waits, so that the threads take turns.
    all.back().problem = watched(all.back().problem, [](const Eigen::VectorXd& x, bool) {
      if (std::fmod(std::abs(x[0]) * 1e6, 1.0) < 0.2) usleep(20);
    });
  }
  std::vector<SearchReport> truth;
  for (const truth::HockSchittkowski& hs : all) truth.push_back(solve(hs.problem, with("ipopt")));
  std::vector<SearchReport> reports(static_cast<std::size_t>(solves));
#pragma omp parallel for num_threads(3) schedule(dynamic, 1)
  for (int i = 0; i < solves; ++i)
    reports[static_cast<std::size_t>(i)] = solve(all[static_cast<std::size_t>(i) % all.size()].problem, with("ipopt"));
  for (std::size_t i = 0; i < reports.size(); ++i) {
    CAPTURE(all[i % all.size()].problem.name);
    const SearchReport& expected = truth[i % all.size()];
    CHECK(reports[i].best_x == expected.best_x);
    CHECK(reports[i].evaluations == expected.evaluations);
    CHECK(reports[i].message == expected.message);
  }
}

}  // namespace

TEST_CASE("forty-eight Ipopt solves in three threads give what one thread gives") { check_solves_in_threads(48); }

TEST_CASE("three hundred Ipopt solves in three threads give what one thread gives", "[slow]") { check_solves_in_threads(300); }

TEST_CASE("an evaluation may itself solve a problem with Ipopt") {
  // min over x of x^2 + min over y of (y - x)^2 + (y - 1)^2: the inner one is (1 - x)^2 / 2 at y = (1 + x) / 2.
  SearchProblem outer = smooth(
      vec({-3}), vec({3}), vec({2}),
      [](const Eigen::VectorXd& x) {
        const SearchProblem inner = smooth(
            vec({-5}), vec({5}), vec({0}),
            [&](const Eigen::VectorXd& y) { return std::pow(y[0] - x[0], 2) + std::pow(y[0] - 1, 2); },
            [&](const Eigen::VectorXd& y) { return vec({2 * (y[0] - x[0]) + 2 * (y[0] - 1)}); });
        return x[0] * x[0] + solve(inner, with("ipopt")).best.objective;
      },
      [](const Eigen::VectorXd& x) { return vec({2 * x[0] - (1 - x[0])}); });
  const SearchReport report = solve(outer, with("ipopt"));
  CHECK(report.best_x[0] == Approx(1.0 / 3).margin(1e-5));
}

TEST_CASE("every solver that can be named comes near a smooth optimum, the same way twice") {
  for (const Solver& solver : solvers()) {
    CAPTURE(solver.name);
    std::vector<bool> kinds;
    std::vector<Eigen::VectorXd> points;
    const SearchProblem problem = watched(bowl(), [&](const Eigen::VectorXd& x, bool with_gradient) {
      kinds.push_back(with_gradient);
      points.push_back(x);
    });
    const SearchReport report = solve(problem, with(solver.name, 3000));
    CHECK(report.algorithm == solver.name);
    CHECK(report.status != SearchStatus::failed);
    CHECK(report.feasible);
    // From 42 at the start. The global ones are slow near an optimum; the local ones are not.
    CHECK(report.best.objective <= (solver.global ? 0.2 : 1e-8));
    // Each asks for the kind it needs.
    CHECK(std::count(kinds.begin(), kinds.end(), solver.gradient) == static_cast<long>(kinds.size()));
    if (solver.gradient) CHECK(points.front() == problem.start);  // others begin where they like
    const SearchReport again = solve(problem, with(solver.name, 3000));
    CHECK(again.best_x == report.best_x);
    CHECK(again.evaluations == report.evaluations);
  }
}

TEST_CASE("solvers with gradients ask once for objective, constraints and gradients at a point") {
  for (const std::string solver : {"ipopt", "slsqp", "mma", "ccsaq", "auglag_lbfgs"}) {
    CAPTURE(solver);
    std::vector<Eigen::VectorXd> asked;
    const SearchProblem problem =
        watched(truth::hock_schittkowski(43).problem, [&](const auto& x, bool) { asked.push_back(x); });
    const SearchReport report = solve(problem, with(solver));
    CHECK(static_cast<int>(asked.size()) == report.evaluations);
    for (std::size_t i = 1; i < asked.size(); ++i) CHECK(asked[i] != asked[i - 1]);
  }
}

TEST_CASE("the budget is kept by every solver") {
  const SearchProblem problem = bowl();
  for (const Solver& solver : solvers())
    for (const int budget : {1, 2, 9}) {
      CAPTURE(solver.name, budget);
      int asked = 0;
      const SearchReport report =
          solve(watched(problem, [&](const auto&, bool) { ++asked; }), with(solver.name, budget));
      CHECK(asked <= budget);
      CHECK(report.evaluations == asked);
      CHECK((report.status == SearchStatus::budget_used || report.status == SearchStatus::converged));
      CHECK(report.best_x.size() == 3);
    }
  SolveOptions options = with("ipopt");
  options.time_budget = 1e-9;
  CHECK(solve(problem, options).status == SearchStatus::budget_used);
}

TEST_CASE("an exception ends every solver at once and arrives unchanged") {
  for (const Solver& solver : solvers()) {
    CAPTURE(solver.name);
    int calls = 0;
    const SearchProblem problem = watched(bowl(), [&](const auto&, bool) {
      if (++calls == 5) throw Odd();
    });
    CHECK_THROWS_AS(solve(problem, with(solver.name)), Odd);
    CHECK(calls == 5);
  }
}

TEST_CASE("a request to stop ends every solver with the best so far") {
  for (const Solver& solver : solvers()) {
    CAPTURE(solver.name);
    SolveOptions options = with(solver.name);
    int told = 0;
    options.progress = [&](const SearchProgress& p) { told = p.evaluations; };
    options.should_stop = [&] { return told >= 6; };
    const SearchReport report = solve(bowl(), options);
    CHECK(report.status == SearchStatus::interrupted);
    CHECK(report.evaluations == 6);
    CHECK(report.best_x.size() == 3);

    // An evaluation that was cut short is no result.
    SearchProblem problem = bowl();
    int calls = 0;
    const auto cut = [&](const auto& evaluate) {
      return [&calls, evaluate](const Eigen::VectorXd& x) {
        Evaluation e = evaluate(x);
        e.interrupted = ++calls == 5;
        if (e.interrupted) e.objective = -1e9;
        return e;
      };
    };
    problem.evaluate = cut(problem.evaluate);
    problem.evaluate_with_gradient = cut(problem.evaluate_with_gradient);
    const SearchReport cut_short = solve(problem, with(solver.name));
    CHECK(cut_short.status == SearchStatus::interrupted);
    CHECK(cut_short.evaluations == 4);
    CHECK(cut_short.best.objective >= 0.0);
  }
}

TEST_CASE("points that are not numbers never reach a solver and are never the best") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  // Nothing can be computed beyond a plane that every first step crosses; or the value is there and the gradient not.
  for (const bool only_gradient : {false, true})
    for (const Solver& solver : solvers()) {
      CAPTURE(solver.name, only_gradient);
      SearchProblem problem = bowl();
      problem.start = vec({1.5, 1.5, 0});
      const auto sick = [&](const auto& evaluate) {
        return [=](const Eigen::VectorXd& x) {
          Evaluation e = evaluate(x);
          const bool is_sick = x[1] < 0.3;
          if (is_sick && !only_gradient) e.objective = nan;
          if (is_sick && e.gradient_valid) e.objective_gradient[0] = nan;
          return e;
        };
      };
      problem.evaluate = sick(problem.evaluate);
      problem.evaluate_with_gradient = sick(problem.evaluate_with_gradient);
      const SearchReport report = solve(problem, with(solver.name, 1000));
      CHECK(report.best.usable);
      CHECK(std::isfinite(report.best.objective));
      CHECK(report.best.objective <= solve(problem, with(solver.name, 1)).best.objective);
      for (const SearchStep& step : report.history) CHECK(std::isfinite(step.objective));
      // Ipopt goes round; the optimum itself is healthy.
      if (solver.name == "ipopt" || (!solver.global && !solver.gradient)) CHECK(report.best.objective <= 1e-6);
    }
}

TEST_CASE("without a valid gradient at the start a solver says so after one evaluation") {
  SearchProblem problem = bowl();
  problem.evaluate_with_gradient = problem.evaluate;
  for (const Solver& solver : solvers()) {
    if (!solver.gradient || solver.global) continue;
    CAPTURE(solver.name);
    const SearchReport report = solve(problem, with(solver.name));
    CHECK(report.status == SearchStatus::gradient_invalid);
    CHECK(report.evaluations == 1);
    CHECK(report.best.usable);
  }
}

TEST_CASE("a wrong combination is refused with the solvers that can") {
  SearchProblem problem = truth::hock_schittkowski(43).problem;
  CHECK_THROWS_WITH(solve(problem, with("lbfgs")),
                    Catch::Contains("must keep constraints, since there are limits") &&
                        Catch::Contains("ipopt, slsqp, ccsaq, mma, auglag_lbfgs, auglag_var2, cobyla, isres") &&
                        Catch::Contains("got \"lbfgs\""));
  CHECK_THROWS_WITH(solve(problem, with("ipop")), Catch::Contains("must be auto or one of ipopt, slsqp"));
  problem.evaluate_with_gradient = nullptr;
  CHECK_THROWS_WITH(solve(problem, with("ipopt")),
                    Catch::Contains("must do without gradients, since the problem has none: auto or one of cobyla"));
  CHECK(solve_fault(problem, with("slsqp")).find("mma") == std::string::npos);
  CHECK(solve_fault(problem, with("cobyla")).empty());

  const SearchProblem equal = truth::hock_schittkowski(71).problem;
  const std::string fault = solve_fault(equal, with("mma"));
  CHECK_THAT(fault, Catch::Contains("must keep equalities") && Catch::Contains("ipopt, slsqp, auglag_lbfgs"));
  CHECK_THAT(fault, !Catch::Contains("ccsaq") && !Catch::Contains("orig_direct"));

  SolveOptions options = with("ipopt");
  options.constraint_tolerance = 0.0;
  CHECK_THAT(solve_fault(equal, options), Catch::Contains("must be > 0, since there are equalities"));
  options = with("ipopt");
  options.starts = {equal.start, equal.start};
  CHECK_THAT(solve_fault(equal, options), Catch::Contains("one start"));
  options.starts = {10.0 * equal.start};
  CHECK_THAT(solve_fault(equal, options), Catch::Contains("outside the bounds"));
  CHECK_THAT(solve_fault(equal, with("ipopt", 0)), Catch::Contains("budget"));
}

TEST_CASE("a constraint tolerance of zero ends strictly inside, close to the optimum") {
  for (const std::string solver : {"ipopt", "slsqp"})
    for (const truth::HockSchittkowski& hs : truth::inequality_problems()) {
      CAPTURE(solver, hs.problem.name);
      SolveOptions options = with(solver);
      options.constraint_tolerance = 0.0;
      const SearchReport report = solve(hs.problem, options);
      CHECK(report.feasible);
      CHECK(report.best.constraints.maxCoeff() <= 0.0);
      // It aims 1e-6 inside of limits whose multipliers are 3 at most, and passes within some of the last steps.
      CHECK(std::abs(report.best.objective - hs.optimum) <= 1e-4 * std::max(1.0, std::abs(hs.optimum)));
    }
}

TEST_CASE("limits that cannot be kept are told, not hidden") {
  SearchProblem problem = bowl();
  problem.constraint_names = {"low", "high"};
  const auto limited = [](const auto& evaluate, bool with_gradient) {
    return [=](const Eigen::VectorXd& x) {
      Evaluation e = evaluate(x);
      e.constraints = vec({x[0] - 1, 2 - x[0]});
      if (with_gradient) e.constraint_jacobian = (Eigen::MatrixXd(2, 3) << 1, 0, 0, -1, 0, 0).finished();
      return e;
    };
  };
  problem.evaluate = limited(problem.evaluate, false);
  problem.evaluate_with_gradient = limited(problem.evaluate_with_gradient, true);
  for (const std::string solver : {"ipopt", "slsqp", "auto"}) {
    CAPTURE(solver);
    const SearchReport report = solve(problem, with(solver, 300));
    CHECK_FALSE(report.feasible);
    // Between 1 and 2, where the sum of both violations is least.
    CHECK(report.best.violation() >= 0.5);
    CHECK(report.best.violation() <= 1.01);
  }
  CHECK_THAT(solve(problem, with("ipopt")).message, Catch::Contains("cannot be kept"));
  CHECK_THAT(solve(problem, with("slsqp")).message, Catch::Contains("no point within the limits"));
}
