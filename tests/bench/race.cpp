// The race of solvers, run by hand:  stillhook_race [PROBLEM ...] [--gradient-cost C] [--budget N] [--solvers A,B,...]
//
// PROBLEM is "sway" (sway_problem.h), "HS43" and so on (Hock and Schittkowski), or a case file.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <optional>

#include "problems/case.h"
#include "problems/evaluator.h"
#include "tests/bench/race_table.h"
#include "tests/bench/sway_problem.h"
#include "tests/truth/hock_schittkowski.h"

using namespace stillhook;

namespace {

void race_on(const std::string& name, const std::vector<Override>& changes, RaceOptions options) {
  std::optional<Evaluator> evaluator;
  SearchProblem problem;
  if (name == "sway") {
    problem = bench::sway_problem();
  } else if (name.starts_with("HS")) {
    const truth::HockSchittkowski hs = truth::hock_schittkowski(std::stoi(name.substr(2)));
    problem = hs.problem;
    options.best = hs.optimum;
  } else {
    // With smooth metrics, so that solvers with and without gradients minimise the same function.
    evaluator.emplace(read_case(name, changes));
    problem = evaluator->smooth_problem({});
  }
  fmt::print("\n{}: {} variables, {} constraints; cost in evaluations, one with gradient counts {:.3g}\n\n", name,
             problem.start.size(), problem.constraint_names.size(), options.gradient_cost);
  fmt::print("{}", race_table(run_race(problem, options), options));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("How many evaluations each solver needs to come within 1 % of the best.");
  std::vector<std::string> problems = {"sway", "HS43", "HS100", "HS113"};
  RaceOptions options;
  app.add_option("problem", problems, "sway, HS43, ... or case files")->capture_default_str();
  app.add_option("--gradient-cost", options.gradient_cost, "of an evaluation with gradient, in evaluations")
      ->capture_default_str();
  app.add_option("--budget", options.budget, "cost at which a solver is stopped")->capture_default_str();
  app.add_option("--within", options.within, "how close, relative to the best")->capture_default_str();
  app.add_option("--difference-step", options.difference_step, "share of the range")->capture_default_str();
  app.add_option("--solvers", options.solvers, "all that can if not given; +forward, +central: by differences")
      ->delimiter(',');
  app.add_option("--seeds", options.seeds, "the middle result is shown")->delimiter(',')->capture_default_str();
  app.add_option("--best", options.best, "best known objective; else the best found");
  std::vector<std::string> changes;
  app.add_option("--set", changes, "KEY=VALUE: change of a case");
  CLI11_PARSE(app, argc, argv);
  try {
    std::vector<Override> overrides;
    for (const std::string& change : changes) {
      const auto equals = change.find('=');
      if (equals == std::string::npos) throw std::invalid_argument("--set wants KEY=VALUE, got " + change);
      overrides.push_back({change.substr(0, equals), change.substr(equals + 1)});
    }
    for (const std::string& name : problems) race_on(name, overrides, options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 2;
  }
}
