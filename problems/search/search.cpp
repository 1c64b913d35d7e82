#include "problems/search/search.h"

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "problems/search/solvers.h"

namespace stillhook {
namespace {

// Each local run starts with this share of the previous one's first step.
constexpr double kRestartReduction = 0.3;
// A population sees at least this many generations, or it is a random search.
constexpr int kGenerations = 3;
// Below this ISRES, which keeps a seventh, would be left with one survivor.
constexpr int kSmallestPopulation = 8;

/// Counts, keeps the best and reports, over all stages of one search.
class Sequence {
 public:
  Sequence(const SearchProblem& problem, const SearchOptions& options)
      : problem_(problem), options_(options), begin_(std::chrono::steady_clock::now()) {
    watched_ = problem;
    watched_.evaluate = [this](const Eigen::VectorXd& x) { return evaluate(x, problem_.evaluate, false); };
    if (problem.evaluate_with_gradient)
      watched_.evaluate_with_gradient = [this](const Eigen::VectorXd& x) {
        return evaluate(x, problem_.evaluate_with_gradient, true);
      };
  }

  SearchReport run() {
    stage_ = "start";
    evaluate_start(problem_.start);
    for (const Eigen::VectorXd& x : options_.starts) evaluate_start(x);
    run_global();
    run_local();
    conclude();
    return report_;
  }

 private:
  int left() const { return options_.evaluations - report_.evaluations; }

  bool should_stop() const {
    if (options_.stop && options_.stop->load()) return true;
    if (options_.time_budget <= 0.0) return false;
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin_;
    return spent.count() > options_.time_budget;
  }

  void evaluate_start(const Eigen::VectorXd& x) {
    if (left() <= 0 || stopped_) return;
    if (should_stop()) {
      stopped_ = true;
      return;
    }
    watched_.evaluate(x);
  }

  template <class Function>
  Evaluation evaluate(const Eigen::VectorXd& x, const Function& function, bool with_gradient) {
    Evaluation evaluation = sanitised(function(x), problem_);
    if (evaluation.interrupted) {
      stopped_ = true;
      return evaluation;
    }
    const bool improved = report_.take(x, evaluation, with_gradient, options_.constraint_tolerance);
    if (options_.progress)
      options_.progress(
          {stage_, report_.evaluations, options_.evaluations, improved, &evaluation, &report_.best, &report_.best_x});
    return evaluation;
  }

  SolveOptions stage_options(const std::string& algorithm, int evaluations) const {
    SolveOptions stage;
    stage.solver = algorithm;
    stage.starts = {report_.best_x};
    stage.evaluations = evaluations;
    stage.seed = options_.seed;
    stage.constraint_tolerance = options_.constraint_tolerance;
    stage.should_stop = [this] { return should_stop(); };
    return stage;
  }

  void run_stage(const SolveOptions& stage) {
    stage_ = stage.solver;
    last_stage_ = solve(watched_, stage);
    if (last_stage_.status == SearchStatus::interrupted) stopped_ = true;
  }

  void run_global() {
    if (options_.global_algorithm.empty() || stopped_) return;
    const int share = std::min(left(), static_cast<int>(std::lround(options_.global_share * options_.evaluations)));
    if (share <= 0) return;
    SolveOptions stage = stage_options(options_.global_algorithm, share);
    const int usual = 20 * (static_cast<int>(problem_.start.size()) + 1);  // Runarsson & Yao 2005
    stage.population = std::min(usual, std::max(kSmallestPopulation, share / kGenerations));
    // CRS2 needs more points than dimensions for its simplex.
    if (options_.global_algorithm == "crs2")
      stage.population = std::max(stage.population, static_cast<int>(problem_.start.size()) + 2);
    run_stage(stage);
  }

  void run_local() {
    if (options_.local_algorithm.empty()) return;
    const bool stepping = !find_solver(options_.local_algorithm)->gradient;
    for (double step = options_.initial_step; left() > 0 && !stopped_ && step > options_.x_tolerance;
         step *= kRestartReduction) {
      SolveOptions stage = stage_options(options_.local_algorithm, left());
      stage.initial_step = step;
      stage.x_tolerance = options_.x_tolerance;
      run_stage(stage);
      if (!stepping) break;
    }
  }

  void conclude() {
    report_.algorithm = options_.global_algorithm;
    if (!options_.local_algorithm.empty())
      report_.algorithm += (report_.algorithm.empty() ? "" : "+") + options_.local_algorithm;
    report_.feasible =
        report_.best_evaluation > 0 && report_.best.usable && report_.best.violation() <= options_.constraint_tolerance;
    if (stopped_) {
      const bool asked = options_.stop && options_.stop->load();
      report_.status = asked || options_.time_budget <= 0.0 ? SearchStatus::interrupted : SearchStatus::budget_used;
      report_.message = report_.status == SearchStatus::interrupted ? "interrupted" : "time budget used";
    } else if (left() <= 0) {
      report_.status = SearchStatus::budget_used;
      report_.message = "evaluation budget used";
    } else {
      report_.status = last_stage_.status == SearchStatus::failed ? SearchStatus::failed : SearchStatus::converged;
      report_.message = last_stage_.message.empty() ? "nothing left to do" : last_stage_.message;
    }
  }

  const SearchProblem& problem_;
  const SearchOptions& options_;
  SearchProblem watched_;  // the problem seen through evaluate() above
  std::chrono::steady_clock::time_point begin_;
  std::string stage_;
  bool stopped_ = false;
  SearchReport report_, last_stage_;
};

}  // namespace

std::string search_fault(const SearchProblem& problem, const SearchOptions& options) {
  if (std::string fault = problem_fault(problem); !fault.empty()) return fault;
  const SolverNeeds needs = needs_of(problem);
  if (!options.global_algorithm.empty())
    if (std::string fault = algorithm_fault(options.global_algorithm, true, needs); !fault.empty())
      return "global_algorithm " + fault;
  if (!options.local_algorithm.empty())
    if (std::string fault = algorithm_fault(options.local_algorithm, false, needs); !fault.empty())
      return "local_algorithm " + fault;
  if (options.evaluations <= 0) return "the evaluation budget must be positive";
  if (!(options.global_share >= 0.0 && options.global_share <= 1.0)) return "global_share must be in [0, 1]";
  if (!(options.initial_step > 0.0 && options.initial_step <= 1.0)) return "initial_step must be in (0, 1]";
  if (!(options.x_tolerance > 0.0)) return "x_tolerance must be > 0";
  if (problem.equalities > 0 && options.constraint_tolerance == 0.0)
    return "constraint_tolerance must be > 0, since there are equalities";
  for (const Eigen::VectorXd& x : options.starts)
    if (std::string fault = start_fault(problem, x); !fault.empty()) return fault;
  return {};
}

SearchReport search(const SearchProblem& problem, const SearchOptions& options) {
  if (const std::string fault = search_fault(problem, options); !fault.empty()) throw std::invalid_argument(fault);
  return Sequence(problem, options).run();
}

}  // namespace stillhook
