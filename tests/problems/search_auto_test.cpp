// The solver `auto`: many starts, fallback and polish, the same for any number of threads.
#include <omp.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "problems/search/solve.h"
#include "tests/problems/search_problems.h"
#include "tests/truth/hock_schittkowski.h"

using namespace stillhook;

namespace {

constexpr double kSquaredWidth = 0.05 * 0.05;

SolveOptions automatic(int evaluations, unsigned long seed = 1) {
  SolveOptions options;
  options.evaluations = evaluations;
  options.seed = seed;
  return options;
}

/// A wide bowl around the origin with 0, and a narrow pit at (1.5, 1.5) with -0.55 that leads to nowhere from outside.
SearchProblem bowl_with_pit() {
  const auto pit = [](const Eigen::VectorXd& x) {
    return std::exp(-(x - vec({1.5, 1.5})).squaredNorm() / (2 * kSquaredWidth));
  };
  return smooth(
      vec({-2, -2}), vec({2, 2}), vec({-1.3, 0.5}),
      [pit](const Eigen::VectorXd& x) { return 0.1 * x.squaredNorm() - pit(x); },
      [pit](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        return 0.2 * x + pit(x) / kSquaredWidth * (x - vec({1.5, 1.5}));
      });
}

/// HS43, whose gradients are valid only within 1.2 of the solution (0, 1, 2, -1).
SearchProblem partly_valid() {
  SearchProblem problem = truth::hock_schittkowski(43).problem;
  problem.start = vec({-4, -4, -4, 4});
  problem.evaluate_with_gradient = [evaluate = problem.evaluate_with_gradient](const Eigen::VectorXd& x) {
    Evaluation e = evaluate(x);
    e.gradient_valid = (x - vec({0, 1, 2, -1})).norm() < 1.2;
    return e;
  };
  return problem;
}

}  // namespace

TEST_CASE("auto solves Hock-Schittkowski problems, also those that lead one solver astray") {
  for (const int number : {7, 15, 26, 29, 39, 71, 108, 113}) {
    const truth::HockSchittkowski hs = truth::hock_schittkowski(number);
    CAPTURE(hs.problem.name);
    const SearchReport report = solve(hs.problem, automatic(400));
    CHECK(report.feasible);
    CHECK(std::abs(report.best.objective - hs.optimum) <= 1e-4 * std::max(1.0, std::abs(hs.optimum)));
  }
}

TEST_CASE("a start given by the caller leads to its optimum") {
  SolveOptions options = automatic(60);
  CHECK(solve(bowl_with_pit(), options).best.objective == Approx(0.0).margin(1e-6));
  options.starts = {vec({1.45, 1.53})};
  CHECK(solve(bowl_with_pit(), options).best.objective == Approx(-0.55).margin(1e-3));
}

TEST_CASE("where gradients are not valid auto goes on without them and comes back") {
  const SearchProblem problem = partly_valid();
  SolveOptions ipopt = automatic(300);
  ipopt.solver = "ipopt";
  CHECK(solve(problem, ipopt).status == SearchStatus::gradient_invalid);
  const SearchReport report = solve(problem, automatic(400));
  CHECK(report.feasible);
  CHECK(report.best.objective == Approx(-44.0).epsilon(1e-6));
  CHECK_THAT(report.algorithm, Catch::Contains("ipopt") && Catch::Contains("cobyla"));
}

TEST_CASE("auto on a problem without gradients does without") {
  SearchProblem problem = truth::hock_schittkowski(43).problem;
  problem.evaluate_with_gradient = nullptr;
  const SearchReport report = solve(problem, automatic(600));
  CHECK(report.feasible);
  CHECK(report.best.objective == Approx(-44.0).epsilon(1e-4));
  CHECK(report.algorithm == "auto: cobyla");
  SearchProblem free = bowl();
  free.evaluate_with_gradient = nullptr;
  CHECK(solve(free, automatic(200)).algorithm == "auto: bobyqa");
}

TEST_CASE("auto finds the same for any number of threads") {
  for (const SearchProblem& problem : {truth::hock_schittkowski(100).problem, partly_valid(), bowl_with_pit()}) {
    CAPTURE(problem.name);
    const auto course = [&](int threads, unsigned long seed) {
      omp_set_num_threads(threads);
      const SearchReport report = solve(problem, automatic(150, seed));
      omp_set_num_threads(omp_get_num_procs());
      std::vector<double> numbers(report.best_x.begin(), report.best_x.end());
      for (const SearchStep& step : report.history) numbers.push_back(step.objective);
      numbers.push_back(report.best_evaluation);
      return numbers;
    };
    const std::vector<double> one = course(1, 3);
    for (int i = 0; i < 3; ++i) CHECK(one == course(3, 3));
    CHECK(one != course(1, 4));
  }
}

TEST_CASE("auto keeps its budget, tells its progress and stops when asked") {
  const SearchProblem problem = truth::hock_schittkowski(100).problem;
  for (const int budget : {1, 5, 30, 150}) {
    CAPTURE(budget);
    SolveOptions options = automatic(budget);
    int told = 0;
    Evaluation best;
    options.progress = [&](const SearchProgress& p) {
      CHECK(p.evaluations == ++told);
      CHECK(p.budget == budget);
      best = *p.best;
    };
    const SearchReport report = solve(problem, options);
    CHECK(told == report.evaluations);
    CHECK(report.evaluations <= budget);
    CHECK(static_cast<int>(report.history.size()) == report.evaluations);
    CHECK(best.objective == report.best.objective);
    CHECK(report.history[static_cast<std::size_t>(report.best_evaluation - 1)].objective == report.best.objective);
  }
  for (const int stop_at : {1, 10, 40}) {
    SolveOptions options = automatic(150);
    std::atomic<int> told = 0;
    options.progress = [&](const SearchProgress& p) { told = p.evaluations; };
    options.should_stop = [&] { return told >= stop_at; };
    const SearchReport report = solve(problem, options);
    CHECK(report.status == SearchStatus::interrupted);
    CHECK(report.evaluations >= stop_at);
    CHECK(report.evaluations < stop_at + omp_get_num_procs() + 1);  // what was under way in other threads
    CHECK(report.best_x.size() == 7);
  }
}

TEST_CASE("an exception out of any thread arrives and ends the others") {
  struct Odd : std::exception {};
  for (const int at : {3, 40, 90}) {
    std::atomic<int> calls = 0;
    const SearchProblem problem = watched(truth::hock_schittkowski(100).problem, [&](const auto&, bool) {
      if (++calls >= at) throw Odd();
    });
    CHECK_THROWS_AS(solve(problem, automatic(150)), Odd);
    CHECK(calls < at + 4);
  }
}
