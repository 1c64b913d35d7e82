#include "problems/search/random_search.h"

#include <chrono>
#include <cstdint>
#include <exception>
#include <mutex>
#include <optional>
#include <random>
#include <stdexcept>

namespace stillhook {

Eigen::VectorXd random_point(const SearchProblem& problem, unsigned long seed, int i) {
  if (i == 0) return problem.start;
  std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(i)};
  std::mt19937_64 generator(sequence);
  Eigen::VectorXd z(problem.start.size());
  // The distributions of the standard library differ between libraries; 53 bits over 2^53 do not.
  for (double& share : z) share = static_cast<double>(generator() >> 11) * 0x1.0p-53;
  return UnitCube(problem).from_unit(z);
}

SearchReport random_search(const SearchProblem& problem, const SearchOptions& options) {
  if (const std::string fault = problem_fault(problem); !fault.empty()) throw std::invalid_argument(fault);
  const int count = options.evaluations;
  if (count <= 0) throw std::invalid_argument("the evaluation budget must be positive");
  const auto begin = std::chrono::steady_clock::now();
  const auto out_of_time = [&] {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    return options.time_budget > 0.0 && spent.count() > options.time_budget;
  };
  const auto stopped = [&] { return options.stop && options.stop->load(); };

  std::vector<std::optional<Evaluation>> done(static_cast<std::size_t>(count));
  std::mutex mutex;  // guards all of the following
  std::exception_ptr error;
  SearchReport so_far;  // best in the order of completion, for progress only
  const auto go_on = [&] {
    const std::lock_guard lock(mutex);
    return !error && !stopped() && !out_of_time();
  };
  const auto take = [&](int i, Evaluation evaluation, const Eigen::VectorXd& x) {
    const std::lock_guard lock(mutex);
    ++so_far.evaluations;
    const bool improved = so_far.best_evaluation == 0 || better(evaluation, so_far.best, options.constraint_tolerance);
    if (improved) {
      so_far.best = evaluation;
      so_far.best_x = x;
      so_far.best_evaluation = i + 1;
    }
    if (options.progress)
      options.progress(
          {"random search", so_far.evaluations, count, improved, &evaluation, &so_far.best, &so_far.best_x});
    done[static_cast<std::size_t>(i)] = std::move(evaluation);
  };
#pragma omp parallel for schedule(dynamic, 1)
  for (int i = 0; i < count; ++i) {
    try {
      if (!go_on()) continue;
      const Eigen::VectorXd x = random_point(problem, options.seed, i);
      Evaluation evaluation = sanitised(problem.evaluate(x), problem);
      if (!evaluation.interrupted) take(i, std::move(evaluation), x);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!error) error = std::current_exception();
    }
  }
  if (error) std::rethrow_exception(error);

  SearchReport report;
  report.algorithm = "random";
  for (int i = 0; i < count; ++i) {
    const auto& evaluation = done[static_cast<std::size_t>(i)];
    if (!evaluation) continue;
    if (report.take(random_point(problem, options.seed, i), *evaluation, false, options.constraint_tolerance))
      report.best_evaluation = i + 1;
  }
  const bool complete = report.evaluations == count;
  report.status = complete || !stopped() ? SearchStatus::budget_used : SearchStatus::interrupted;
  report.message = complete ? "evaluation budget used" : stopped() ? "interrupted" : "time budget used";
  report.feasible =
      report.best_evaluation > 0 && report.best.usable && report.best.violation() <= options.constraint_tolerance;
  return report;
}

}  // namespace stillhook
