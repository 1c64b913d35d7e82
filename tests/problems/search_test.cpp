// The search sequence and its algorithms against published optima, and what it does with problems that misbehave.
#include "problems/search/search.h"

#include <omp.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <set>

#include "problems/search/random_search.h"
#include "tests/problems/search_problems.h"
#include "tests/truth/hock_schittkowski.h"

using namespace stillhook;

namespace {

SearchOptions with_budget(int evaluations, unsigned long seed = 1) {
  SearchOptions options;
  options.evaluations = evaluations;
  options.seed = seed;
  return options;
}

}  // namespace

TEST_CASE("isres then cobyla solves the Hock-Schittkowski problems with inequalities") {
  for (const truth::HockSchittkowski& hs : truth::inequality_problems())
    for (const unsigned long seed : {1ul, 7ul}) {
      CAPTURE(hs.problem.name, seed);
      const SearchReport report = search(hs.problem, with_budget(1000, seed));
      CHECK(report.feasible);
      CHECK(report.best.violation() <= 1e-6);
      // COBYLA stops at steps of 1e-5 of the range, and a constraint violated by the allowed 1e-6 gives up 1e-6 times
      // its multiplier (at most 3 here); so 1e-5 of the objective's size.
      CHECK(std::abs(report.best.objective - hs.optimum) <= 1e-5 * std::max(1.0, std::abs(hs.optimum)));
      // The minimum is quadratic along the constraints: sqrt of the above. HS100's is the flattest.
      CHECK((report.best_x - hs.solution).norm() <= 2e-2 * hs.solution.norm());
      CHECK(report.evaluations <= 1000);
      const SearchReport sample = random_search(hs.problem, with_budget(1000, seed));
      CHECK(better(report.best, sample.best));
    }
}

TEST_CASE("the second part may use gradients") {
  for (const std::string local : {"ipopt", "slsqp"})
    for (const truth::HockSchittkowski& hs : truth::inequality_problems()) {
      CAPTURE(local, hs.problem.name);
      SearchOptions options = with_budget(120);
      options.global_share = 0.3;
      options.local_algorithm = local;
      const SearchReport report = search(hs.problem, options);
      CHECK(report.feasible);
      CHECK(report.algorithm == "isres+" + local);
      // As above; the budget is an eighth.
      CHECK(std::abs(report.best.objective - hs.optimum) <= 1e-5 * std::max(1.0, std::abs(hs.optimum)));
      CHECK(report.gradients < report.evaluations);
      CHECK(report.gradients > 0);
    }
}

TEST_CASE("a constraint tolerance of zero ends at a strictly feasible point") {
  for (const truth::HockSchittkowski& hs : truth::inequality_problems()) {
    CAPTURE(hs.problem.name);
    SearchOptions options = with_budget(800);
    options.constraint_tolerance = 0.0;
    const SearchReport report = search(hs.problem, options);
    CHECK(report.feasible);
    CHECK(report.best.constraints.maxCoeff() <= 0.0);
    // From inside, the last step of 1e-5 of the range is felt to first order; gradients are of order ten.
    CHECK(std::abs(report.best.objective - hs.optimum) <= 2e-3 * std::max(1.0, std::abs(hs.optimum)));
  }
}

TEST_CASE("same seed, same bits; another seed, another path") {
  const truth::HockSchittkowski hs = truth::inequality_problems()[3];
  const auto path = [&](unsigned long seed, int threads) {
    std::vector<double> objectives;
    SearchOptions options = with_budget(120, seed);
    options.progress = [&](const SearchProgress& p) { objectives.push_back(p.last->objective); };
    omp_set_num_threads(threads);
    const SearchReport report = search(hs.problem, options);
    const SearchReport sample = random_search(hs.problem, with_budget(120, seed));
    omp_set_num_threads(omp_get_num_procs());
    for (const double v : report.best_x) objectives.push_back(v);
    for (const double v : sample.best_x) objectives.push_back(v);
    return objectives;
  };
  const std::vector<double> first = path(3, 1);
  CHECK(first == path(3, 2));  // the order in which random points finish is not part of path()
  CHECK(first != path(4, 1));
}

TEST_CASE("the budget is kept exactly and the start is evaluated first, to the bit") {
  // A logarithmic start that scaling there and back changes in its last bits.
  SearchProblem problem = plain(vec({1e-3, -7.0}), vec({1e3, 13.0}), vec({0.1, 0.3}), [](const Eigen::VectorXd& x) {
    return std::pow(std::log10(x[0]) - 1.0, 2) + std::pow(x[1] - 2.0, 2);
  });
  problem.logarithmic = {true, false};
  std::vector<Eigen::VectorXd> asked;
  const auto evaluate = problem.evaluate;
  problem.evaluate = [&](const Eigen::VectorXd& x) {
    asked.push_back(x);
    return evaluate(x);
  };
  for (const int budget : {1, 2, 7, 40, 300}) {
    asked.clear();
    const SearchReport report = search(problem, with_budget(budget));
    CHECK(static_cast<int>(asked.size()) == report.evaluations);
    CHECK(report.evaluations <= budget);
    CHECK((report.evaluations == budget || report.status == SearchStatus::converged));
    CHECK(asked.front() == problem.start);
    for (const Eigen::VectorXd& x : asked) {
      CHECK((x.array() >= problem.lower.array()).all());
      CHECK((x.array() <= problem.upper.array()).all());
    }
    if (budget == 40) CHECK(asked[1] == problem.start);  // ISRES takes it into its population: the store answers it
  }
  // The optimum (10, 2) in the middle of six decades is met to the step tolerance of 1e-5 of the range.
  const SearchReport report = search(problem, with_budget(300));
  CHECK(std::log10(report.best_x[0]) == Approx(1.0).margin(1e-3));
  CHECK(report.best_x[1] == Approx(2.0).margin(1e-3));
}

TEST_CASE("constraints with an algorithm that has none are refused, naming those that can") {
  SearchProblem problem = truth::inequality_problems()[0].problem;
  problem.evaluate_with_gradient = nullptr;
  SearchOptions options;
  options.global_algorithm = "crs2";
  CHECK_THROWS_WITH(search(problem, options), Catch::Contains("crs2") && Catch::Contains("isres, orig_direct"));
  CHECK(search_fault(problem, options).find("esch") == std::string::npos);
  options.global_algorithm = "isres";
  options.local_algorithm = "bobyqa";
  CHECK_THROWS_WITH(search(problem, options), Catch::Contains("bobyqa") && Catch::Contains("cobyla"));
  options.local_algorithm = "cobyla ";
  CHECK_THROWS_WITH(search(problem, options), Catch::Contains("must be none or one of cobyla, got \"cobyla \""));
  options.local_algorithm = "isres";
  CHECK_THROWS_WITH(search(problem, options), Catch::Contains("must be a local algorithm"));
  problem.constraint_names.clear();
  options.global_algorithm = "crs2";
  options.local_algorithm = "bobyqa";
  CHECK(search_fault(problem, options).empty());
}

TEST_CASE("faulty problems are refused with the variable's name") {
  const auto fault = [](auto change) {
    SearchProblem problem = plain(vec({1, 1}), vec({2, 2}), vec({1.5, 1.5}), [](const auto& x) { return x[0]; });
    change(problem);
    return problem_fault(problem);
  };
  CHECK(fault([](SearchProblem&) {}).empty());
  CHECK_THAT(fault([](SearchProblem& p) { p.start[1] = 3; }), Catch::Contains("v1") && Catch::Contains("start"));
  CHECK_THAT(fault([](SearchProblem& p) { p.start[1] = std::nan(""); }), Catch::Contains("v1"));
  CHECK_THAT(fault([](SearchProblem& p) { p.upper[0] = p.lower[0]; }), Catch::Contains("v0"));
  CHECK_THAT(fault([](SearchProblem& p) { p.upper[0] = INFINITY; }), Catch::Contains("finite"));
  CHECK_THAT(fault([](SearchProblem& p) {
               p.lower[0] = 0;
               p.logarithmic = {true, false};
             }),
             Catch::Contains("logarithmic"));
  CHECK_FALSE(fault([](SearchProblem& p) { p.lower.resize(1); }).empty());
}

TEST_CASE("a discontinuous constraint: a count that must be zero") {
  // Minimise x + y with floor(4 (1 - x)) <= 0, i.e. x > 0.75, and y >= 0.2 - x / 10 in steps: least 0.75 + 0.125.
  SearchProblem problem = plain(vec({0, 0}), vec({2, 2}), vec({0.1, 1.9}), {});
  problem.constraint_names = {"count", "step"};
  problem.evaluate = [](const Eigen::VectorXd& x) {
    Evaluation e;
    e.usable = true;
    e.objective = x[0] + x[1];
    e.constraints = vec({std::max(0.0, std::floor(4 * (1 - x[0]))), 0.2 - x[0] / 10 - x[1]});
    return e;
  };
  const SearchReport report = search(problem, with_budget(400));
  CHECK(report.feasible);
  CHECK(report.best.constraints[0] == 0.0);
  CHECK(report.best_x[0] > 0.75);
  // The edge of the step gives no slope to follow: within 2 % of the range is what a derivative-free search can do.
  CHECK(report.best.objective == Approx(0.875).margin(0.04));
}

TEST_CASE("regions that cannot be evaluated are data, not failures") {
  // Not a number beyond a circle around the optimum's neighbourhood; and infinite below a line.
  const auto sick = [](const Eigen::VectorXd& x) {
    if (x.squaredNorm() > 4.0) return std::nan("");
    if (x[0] + x[1] < -1.0) return std::numeric_limits<double>::infinity();
    return std::pow(x[0] - 1.2, 2) + std::pow(x[1] - 0.7, 2);
  };
  SearchProblem problem = plain(vec({-5, -5}), vec({5, 5}), vec({-4.9, 4.9}), sick);
  int unusable = 0;
  SearchOptions options = with_budget(400);
  options.progress = [&](const SearchProgress& p) {
    CHECK(std::isfinite(p.last->objective));
    CHECK(std::isfinite(p.best->objective));
    unusable += p.last->usable ? 0 : 1;
  };
  const SearchReport report = search(problem, options);  // from a start that is not usable itself
  CHECK(unusable > 20);
  CHECK(report.best.usable);
  CHECK(report.feasible);
  CHECK(report.best.objective <= 1e-6);

  problem.evaluate = [](const Eigen::VectorXd&) { return Evaluation{}; };  // nothing works anywhere
  const SearchReport hopeless = search(problem, with_budget(60));
  CHECK_FALSE(hopeless.feasible);
  CHECK_FALSE(hopeless.best.usable);
  CHECK(std::isfinite(hopeless.best.objective));
}

TEST_CASE("graded failures lead towards what works, also under constraints") {
  // Runs end early, the earlier the further x[0] is above 0.3 (of 1): as a diverging simulation would be graded.
  SearchProblem problem = plain(vec({0, 0}), vec({1, 1}), vec({0.95, 0.1}), {});
  problem.constraint_names = {"limit"};
  problem.evaluate = [](const Eigen::VectorXd& x) {
    Evaluation e;
    const double reached = std::min(1.0, 1.0 - (x[0] - 0.3));
    e.usable = reached >= 1.0;
    e.objective = e.usable ? std::pow(x[0] - 0.25, 2) + std::pow(x[1] - 0.8, 2) : 1e3 * (2.0 - reached);
    e.constraints = vec({e.usable ? x[1] - 0.6 : 2.0 - reached});
    return e;
  };
  SearchOptions options = with_budget(150);
  options.global_algorithm.clear();  // COBYLA alone must find its way out
  const SearchReport report = search(problem, options);
  CHECK(report.feasible);
  CHECK(report.best.objective == Approx(0.04).margin(1e-3));  // (0.25, 0.6)
}

TEST_CASE("an exception out of a random sample arrives unchanged") {
  struct Odd : std::exception {};
  SearchProblem problem = plain(vec({0, 0}), vec({1, 1}), vec({0.4, 0.6}),
                                [&](const Eigen::VectorXd& x) { return x[0] > 0.5 ? throw Odd() : x[0]; });
  CHECK_THROWS_AS(random_search(problem, with_budget(50)), Odd);
}

TEST_CASE("a stop flag ends every stage with the best so far") {
  for (const int stop_at : {1, 3, 20, 55}) {
    CAPTURE(stop_at);
    std::atomic<bool> stop = false;
    SearchOptions options = with_budget(80);
    options.stop = &stop;
    options.progress = [&](const SearchProgress& p) { stop = p.evaluations >= stop_at; };
    const truth::HockSchittkowski hs = truth::inequality_problems()[3];
    const SearchReport report = search(hs.problem, options);
    CHECK(report.status == SearchStatus::interrupted);
    CHECK(report.evaluations == stop_at);
    CHECK(report.best_x.size() == 4);
  }
  // An evaluation that was cut short is no result.
  SearchProblem problem = plain(vec({0, 0}), vec({1, 1}), vec({0.4, 0.6}), {});
  int calls = 0;
  problem.evaluate = [&](const Eigen::VectorXd& x) {
    Evaluation e;
    e.usable = true;
    e.objective = x.sum();
    e.interrupted = ++calls == 12;
    if (e.interrupted) e.objective = -1e9;
    return e;
  };
  const SearchReport report = search(problem, with_budget(80));
  CHECK(report.status == SearchStatus::interrupted);
  CHECK(report.evaluations == 11);
  CHECK(report.best.objective >= 0.0);
}

TEST_CASE("random points fill the box evenly, each from its own index") {
  SearchProblem problem = plain(vec({1e-2, -3}), vec({1e2, 5}), vec({1, 0}), [](const auto& x) { return x.sum(); });
  problem.logarithmic = {true, false};
  double mean_log = 0.0, mean = 0.0;
  std::set<double> distinct;
  constexpr int kCount = 2000;
  for (int i = 1; i <= kCount; ++i) {
    const Eigen::VectorXd x = random_point(problem, 5, i);
    CHECK(x == random_point(problem, 5, i));
    mean_log += std::log10(x[0]) / kCount;
    mean += x[1] / kCount;
    distinct.insert(x[0]);
  }
  CHECK(distinct.size() == kCount);
  // Four standard errors of the mean of a uniform variable: range / sqrt(12 n).
  CHECK(std::abs(mean_log) <= 4.0 * 4.0 / std::sqrt(12.0 * kCount));
  CHECK(std::abs(mean - 1.0) <= 4.0 * 8.0 / std::sqrt(12.0 * kCount));
}
