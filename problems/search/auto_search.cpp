#include "problems/search/auto_search.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <numeric>

#include "problems/search/random_search.h"

namespace stillhook {
namespace {

constexpr int kChains = 3;
// A chain with fewer evaluations than this does not come to an end.
constexpr int kShortestChain = 20;
constexpr double kSampleShare = 0.1, kPolishShare = 0.1;  // of the budget; samples also at most n + 1
// Starts closer than this (root mean square over the variables, share of the range) lead to the same optimum.
constexpr double kSameStart = 0.05;
// Without gradients a model of n variables takes n + 1 evaluations before the first informed step.
constexpr int kFallbackSteps = 3;
constexpr double kFallbackStep = 0.15, kStepReduction = 0.5, kPolishStep = 0.02;

/// One part of the search that runs in one thread: what it has used and found.
struct Chain {
  Eigen::VectorXd x;
  int budget = 0;
  SearchReport report;
  SearchStatus status = SearchStatus::not_run;
  std::string message;
  std::vector<std::string> used;  // solvers
  int left() const { return budget - report.evaluations; }
};

class AutoSearch {
 public:
  AutoSearch(const SearchProblem& problem, const SolveOptions& options)
      : problem_(problem),
        options_(options),
        without_(problem.constraint_names.empty() ? "bobyqa" : "cobyla"),
        begin_(std::chrono::steady_clock::now()) {}

  SearchReport run() {
    const std::vector<Eigen::VectorXd> starts = try_starts();
    if (!stopped() && left() > 0) run_chains(starts);
    if (!stopped() && left() > 0) run_polish();
    conclude();
    return report_;
  }

 private:
  int left() const { return options_.evaluations - report_.evaluations; }
  bool stopped() const { return interrupted_ || out_of_time_ || failed_; }

  /// Asked before each evaluation, from any thread.
  bool should_stop() {
    if (stopped()) return true;
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin_;
    if (options_.should_stop && options_.should_stop())
      interrupted_ = true;
    else if (options_.time_budget > 0.0 && spent.count() > options_.time_budget)
      out_of_time_ = true;
    return stopped();
  }

  void tell(const std::string& stage, const Evaluation& last, const Eigen::VectorXd* x) {
    const std::lock_guard lock(mutex_);
    ++told_;
    const bool improved = x && (told_ == 1 || better(last, best_, options_.constraint_tolerance));
    if (improved) {
      best_ = last;
      best_x_ = *x;
    }
    if (options_.progress) options_.progress({stage, told_, options_.evaluations, improved, &last, &best_, &best_x_});
  }

  /// Runs body(i) for every i, several at once; throws on the first exception by index.
  template <class Body>
  void side_by_side(int count, Body body) {
    std::vector<std::exception_ptr> errors(static_cast<std::size_t>(count));
#pragma omp parallel for schedule(dynamic, 1)
    for (int i = 0; i < count; ++i) {
      try {
        body(i);
      } catch (...) {
        errors[static_cast<std::size_t>(i)] = std::current_exception();
        failed_ = true;
      }
    }
    for (const std::exception_ptr& error : errors)
      if (error) std::rethrow_exception(error);
  }

  /// Evaluates the starts and returns them, the best first.
  std::vector<Eigen::VectorXd> try_starts() {
    std::vector<Eigen::VectorXd> starts = {problem_.start};
    starts.insert(starts.end(), options_.starts.begin(), options_.starts.end());
    const int samples = std::min(static_cast<int>(std::lround(kSampleShare * options_.evaluations)),
                                 static_cast<int>(problem_.start.size()) + 1);
    for (int i = 1; i <= samples; ++i) starts.push_back(random_point(problem_, options_.seed, i));
    if (static_cast<int>(starts.size()) > options_.evaluations)
      starts.resize(static_cast<std::size_t>(options_.evaluations));
    std::vector<Evaluation> found(starts.size());
    std::vector<char> done(starts.size(), false);
    side_by_side(static_cast<int>(starts.size()), [&](int index) {
      const std::size_t i = static_cast<std::size_t>(index);
      if (should_stop()) return;
      found[i] = sanitised(problem_.evaluate(starts[i]), problem_);
      if (found[i].interrupted)
        interrupted_ = true;
      else
        done[i] = true;
      if (done[i]) tell("start", found[i], &starts[i]);
    });
    for (std::size_t i = 0; i < starts.size(); ++i)
      if (done[i]) report_.take(starts[i], found[i], false, options_.constraint_tolerance);
    std::vector<std::size_t> order(starts.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return better(found[a], found[b], options_.constraint_tolerance);
    });
    std::vector<Eigen::VectorXd> ranked;
    for (const std::size_t i : order) ranked.push_back(starts[i]);
    return ranked;
  }

  /// The best starts, each far from those before it.
  std::vector<Eigen::VectorXd> apart(const std::vector<Eigen::VectorXd>& ranked, int count) const {
    const UnitCube cube(problem_);
    const double closest = kSameStart * std::sqrt(static_cast<double>(problem_.start.size()));
    std::vector<Eigen::VectorXd> chosen;
    for (const Eigen::VectorXd& x : ranked) {
      const bool new_one = std::none_of(chosen.begin(), chosen.end(), [&](const Eigen::VectorXd& other) {
        return (cube.to_unit(x) - cube.to_unit(other)).norm() < closest;
      });
      if (new_one && static_cast<int>(chosen.size()) < count) chosen.push_back(x);
    }
    return chosen;
  }

  void run_chains(const std::vector<Eigen::VectorXd>& ranked) {
    const int polish = static_cast<int>(std::lround(kPolishShare * options_.evaluations));
    const int budget = std::max(1, left() - polish);
    const std::vector<Eigen::VectorXd> starts = apart(ranked, std::clamp(budget / kShortestChain, 1, kChains));
    const int count = static_cast<int>(starts.size());
    std::vector<Chain> chains(starts.size());
    for (int i = 0; i < count; ++i) {
      Chain& chain = chains[static_cast<std::size_t>(i)];
      chain.x = starts[static_cast<std::size_t>(i)];
      chain.budget = budget / count + (i < budget % count ? 1 : 0);
    }
    side_by_side(count, [&](int i) {
      const std::string name = "chain " + std::to_string(i + 1) + ", ";
      Chain& chain = chains[static_cast<std::size_t>(i)];
      if (problem_.evaluate_with_gradient)
        with_gradients(chain, name, i % 2 == 0 ? "ipopt" : "slsqp");
      else
        without_gradients(chain, name, kFallbackStep);
    });
    for (const Chain& chain : chains) add(chain);
  }

  void run_polish() {
    Chain chain;
    chain.x = report_.best_x;
    chain.budget = left();
    if (problem_.evaluate_with_gradient) run_stage(chain, "polish, ", "slsqp", chain.left(), kPolishStep);
    if (chain.status != SearchStatus::converged && !stopped()) without_gradients(chain, "polish, ", kPolishStep);
    add(chain);
  }

  /// Gradients as long as they are valid, some steps without them where they are not, and back.
  void with_gradients(Chain& chain, const std::string& name, std::string solver) {
    double step = kFallbackStep;
    bool switched = false;
    while (chain.left() > 0 && !stopped() && step > options_.x_tolerance) {
      run_stage(chain, name, solver, chain.left(), step);
      if (chain.status == SearchStatus::failed && !switched) {
        solver = solver == "ipopt" ? "slsqp" : "ipopt";
        switched = true;
        continue;
      }
      if (chain.status != SearchStatus::gradient_invalid && chain.status != SearchStatus::failed) return;
      const int steps = kFallbackSteps * (static_cast<int>(problem_.start.size()) + 1);
      if (chain.left() > 0 && !stopped()) run_stage(chain, name, without_, std::min(chain.left(), steps), step);
      step *= kStepReduction;
    }
  }

  /// Again and again with a smaller first step.
  void without_gradients(Chain& chain, const std::string& name, double step) {
    for (; chain.left() > 0 && !stopped() && step > options_.x_tolerance; step *= kStepReduction)
      run_stage(chain, name, without_, chain.left(), step);
  }

  void run_stage(Chain& chain, const std::string& name, const std::string& solver, int evaluations, double step) {
    SolveOptions stage = options_;
    stage.solver = solver;
    stage.starts = {chain.x};
    stage.evaluations = evaluations;
    stage.initial_step = step;
    stage.time_budget = 0.0;
    stage.should_stop = [this] { return should_stop(); };
    stage.progress = [&](const SearchProgress& p) { tell(name + p.stage, *p.last, p.improved ? p.best_x : nullptr); };
    const SearchReport report = solve(problem_, stage);
    if (report.status == SearchStatus::interrupted) interrupted_ = interrupted_ || !out_of_time_;
    chain.report.append(report, options_.constraint_tolerance);
    if (chain.report.best_evaluation > 0) chain.x = chain.report.best_x;
    chain.status = report.status;
    chain.message = report.message;
    if (std::find(chain.used.begin(), chain.used.end(), solver) == chain.used.end()) chain.used.push_back(solver);
  }

  void add(const Chain& chain) {
    report_.append(chain.report, options_.constraint_tolerance);
    report_.status = chain.status;
    report_.message = chain.message;
    for (const std::string& solver : chain.used)
      if (std::find(used_.begin(), used_.end(), solver) == used_.end()) used_.push_back(solver);
  }

  void conclude() {
    report_.algorithm = "auto";
    for (const std::string& solver : used_) report_.algorithm += (solver == used_.front() ? ": " : ", ") + solver;
    report_.feasible =
        report_.best_evaluation > 0 && report_.best.usable && report_.best.violation() <= options_.constraint_tolerance;
    if (interrupted_ || out_of_time_) {
      report_.status = interrupted_ ? SearchStatus::interrupted : SearchStatus::budget_used;
      report_.message = interrupted_ ? "interrupted" : "time budget used";
    } else if (left() <= 0) {
      report_.status = SearchStatus::budget_used;
      report_.message = "evaluation budget used";
    }
  }

  const SearchProblem& problem_;
  const SolveOptions& options_;
  std::string without_;  // the solver without gradients
  std::chrono::steady_clock::time_point begin_;
  std::atomic<bool> interrupted_ = false, out_of_time_ = false, failed_ = false;
  std::mutex mutex_;  // guards what progress is told
  int told_ = 0;
  Evaluation best_;
  Eigen::VectorXd best_x_;
  std::vector<std::string> used_;
  SearchReport report_;
};

}  // namespace

SearchReport auto_search(const SearchProblem& problem, const SolveOptions& options) {
  return AutoSearch(problem, options).run();
}

}  // namespace stillhook
