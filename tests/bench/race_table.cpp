#include "tests/bench/race_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "problems/search/solve.h"
#include "problems/search/solvers.h"

namespace stillhook {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// A solver by name, with the gradients it is given and what each of them costs.
struct Entry {
  std::string name, solver;
  SearchProblem problem;
  double gradient_cost;
};

/// Gradients by differences of plain evaluations; at a bound they look inside.
SearchProblem with_differences(const SearchProblem& problem, bool central, double step) {
  SearchProblem result = problem;
  result.evaluate_with_gradient = [=](const Eigen::VectorXd& x) {
    const UnitCube cube(problem);
    const Eigen::VectorXd z = cube.to_unit(x), slope = cube.slope(x);
    Evaluation e = problem.evaluate(x);
    e.objective_gradient.resize(x.size());
    e.constraint_jacobian.resize(e.constraints.size(), x.size());
    e.gradient_valid = e.usable;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const auto at = [&](double by) {
        Eigen::VectorXd moved = z;
        moved[i] += by;
        return problem.evaluate(cube.from_unit(moved));
      };
      const double from = central && z[i] >= step && z[i] + step <= 1.0 ? -step : 0.0;
      const double to = z[i] + step <= 1.0 ? step : -step;
      const Evaluation a = from == 0.0 ? e : at(from), b = at(to);
      const double by = (to - from) * slope[i];
      e.gradient_valid = e.gradient_valid && a.usable && b.usable;
      e.objective_gradient[i] = (b.objective - a.objective) / by;
      if (e.gradient_valid) e.constraint_jacobian.col(i) = (b.constraints - a.constraints) / by;
    }
    return e;
  };
  return result;
}

Entry entry_of(const std::string& name, const SearchProblem& problem, const RaceOptions& options) {
  const std::size_t plus = name.find('+');
  const std::string solver = name.substr(0, plus), how = plus == std::string::npos ? "" : name.substr(plus + 1);
  if (how.empty()) return {name, solver, problem, options.gradient_cost};
  if (how != "forward" && how != "central")
    throw std::invalid_argument(name + ": gradients are exact, or by +forward or +central differences");
  const double n = static_cast<double>(problem.start.size());
  const bool central = how == "central";
  return {name, solver, with_differences(problem, central, options.difference_step), 1.0 + (central ? 2.0 * n : n)};
}

std::vector<std::string> all_that_can(const SearchProblem& problem) {
  std::vector<std::string> names = {"auto"};
  for (const Solver& solver : solvers())
    if (solver_fault(solver.name, needs_of(problem)).empty()) names.push_back(solver.name);
  for (const char* name : {"ipopt+forward", "slsqp+forward", "slsqp+central"}) names.push_back(name);
  return names;
}

SearchReport run_one(const Entry& entry, const RaceOptions& options, unsigned long seed) {
  double cost = 0.0;
  SearchProblem counted = entry.problem;
  const auto count = [&cost](const auto& evaluate, double charge) {
    return [&cost, evaluate, charge](const Eigen::VectorXd& x) {
#pragma omp atomic
      cost += charge;
      return evaluate(x);
    };
  };
  counted.evaluate = count(entry.problem.evaluate, 1.0);
  if (entry.problem.evaluate_with_gradient)
    counted.evaluate_with_gradient = count(entry.problem.evaluate_with_gradient, entry.gradient_cost);
  SolveOptions solve_with;
  solve_with.solver = entry.solver;
  solve_with.seed = seed;
  solve_with.constraint_tolerance = options.constraint_tolerance;
  solve_with.x_tolerance = options.x_tolerance;
  const Solver* solver = find_solver(entry.solver);
  const bool gradient = solver ? solver->gradient : static_cast<bool>(entry.problem.evaluate_with_gradient);
  solve_with.evaluations = std::max(1, static_cast<int>(options.budget / (gradient ? entry.gradient_cost : 1.0)));
  return solve(counted, solve_with);
}

/// Cost until the course comes within a share of the best; infinity if it never does.
double cost_until(const SearchReport& report, const Entry& entry, const RaceOptions& options, double best,
                  double share) {
  double cost = 0.0;
  for (const SearchStep& step : report.history) {
    cost += step.with_gradient ? entry.gradient_cost : 1.0;
    if (step.usable && step.violation <= options.constraint_tolerance &&
        step.objective <= best + share * std::abs(best))
      return cost;
  }
  return kNever;
}

double middle(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::string cost_text(double cost) { return std::isfinite(cost) ? fmt::format("{:.0f}", cost) : "-"; }

}  // namespace

std::vector<RaceResult> run_race(const SearchProblem& problem, const RaceOptions& options) {
  std::vector<Entry> entries;
  for (const std::string& name : options.solvers.empty() ? all_that_can(problem) : options.solvers)
    entries.push_back(entry_of(name, problem, options));
  std::vector<std::vector<SearchReport>> reports;
  double best = options.best.value_or(kNever);
  for (const Entry& entry : entries) {
    std::vector<SearchReport>& mine = reports.emplace_back();
    for (const unsigned long seed : options.seeds) mine.push_back(run_one(entry, options, seed));
    for (const SearchReport& report : mine)
      if (!options.best && report.feasible) best = std::min(best, report.best.objective);
  }
  std::vector<RaceResult> results;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    RaceResult result;
    result.solver = entries[i].name;
    std::vector<double> within, near, found, cost;
    for (const SearchReport& report : reports[i]) {
      within.push_back(cost_until(report, entries[i], options, best, options.within));
      near.push_back(cost_until(report, entries[i], options, best, 10.0 * options.within));
      found.push_back(report.feasible ? report.best.objective : kNever);
      cost.push_back(report.evaluations + (entries[i].gradient_cost - 1.0) * report.gradients);
    }
    result.cost_within = middle(within);
    result.cost_near = middle(near);
    result.best = middle(found);
    result.cost = middle(cost);
    result.end = reports[i].front().message;
    results.push_back(result);
  }
  std::stable_sort(results.begin(), results.end(), [](const RaceResult& a, const RaceResult& b) {
    return std::pair(a.cost_within, a.best) < std::pair(b.cost_within, b.best);
  });
  return results;
}

std::string race_table(const std::vector<RaceResult>& results, const RaceOptions& options) {
  std::string text =
      fmt::format("| solver | to {:.3g} % | to {:.3g} % | best | in all | end |\n|---|---|---|---|---|---|\n",
                  100.0 * options.within, 1000.0 * options.within);
  for (const RaceResult& r : results)
    text +=
        fmt::format("| {} | {} | {} | {} | {:.0f} | {} |\n", r.solver, cost_text(r.cost_within), cost_text(r.cost_near),
                    std::isfinite(r.best) ? fmt::format("{:.6g}", r.best) : "-", r.cost, r.end);
  return text;
}

}  // namespace stillhook
