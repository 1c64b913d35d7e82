#include "planner/verbs/plan/plan.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <mutex>
#include <optional>
#include <set>

#include "planner/version.h"
#include "problems/case_document.h"
#include "problems/case_sections.h"
#include "problems/search/random_search.h"

namespace stillhook {
namespace {

/// FNV-1a, 64 bit, of a file's content, in hexadecimal. It tells a changed file from an unchanged one; it need not
/// withstand an attack.
std::string content_hash(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw CaseError(path + ": cannot be read");
  std::uint64_t hash = 14695981039346656037ull;
  for (std::istreambuf_iterator<char> it(in), end; it != end; ++it) {
    hash ^= static_cast<unsigned char>(*it);
    hash *= 1099511628211ull;
  }
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += kDigits[(hash >> shift) & 0xf];
  return text;
}

/// Counts the different points that pass through a problem.
class DistinctPoints {
 public:
  SearchProblem watch(const SearchProblem& problem) {
    SearchProblem watched = problem;
    watched.evaluate = [this, evaluate = problem.evaluate](const Eigen::VectorXd& x) {
      {
        const std::lock_guard lock(mutex_);
        points_.insert(std::vector<double>(x.begin(), x.end()));
      }
      return evaluate(x);
    };
    return watched;
  }
  int count() const { return static_cast<int>(points_.size()); }

 private:
  std::mutex mutex_;
  std::set<std::vector<double>> points_;
};

PlanResult::Point point_of(const Evaluation& e) {
  return {e.usable ? e.objective : std::numeric_limits<double>::quiet_NaN(), e.usable && e.violation() <= 0.0};
}

/// The point of all guesses, where the case has any; for the others its own values.
std::optional<Eigen::VectorXd> guessed_point(const Evaluator& evaluator) {
  Eigen::VectorXd x = evaluator.baseline();
  bool any = false;
  const std::vector<VariableSpec>& variables = evaluator.base().plan.variables;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    if (!variables[i].start) continue;
    x[static_cast<Eigen::Index>(i)] = *variables[i].start;
    any = true;
  }
  return any ? std::optional(x) : std::nullopt;
}

/// The stage that follows exact gradients of the smooth problem, from the guesses if there are any. Returns the points
/// worth starting from: the best of its evaluations by the metrics as they are, which each of them knows as well.
std::vector<Eigen::VectorXd> follow_gradients(const Evaluator& evaluator, SearchProblem smooth, EvaluationStore& store,
                                              const PlanOptions& options, SearchReport& report) {
  const PlanSpec& plan = evaluator.base().plan;
  smooth = with_store(smooth, store, "gradient");
  if (const auto guess = guessed_point(evaluator)) smooth.start = *guess;
  std::mutex mutex;
  Evaluation best;
  Eigen::VectorXd best_x;
  const auto with_gradient = [&, evaluate = smooth.evaluate_with_gradient](const Eigen::VectorXd& x) {
    const Evaluation e = evaluate(x);
    if (!e.interrupted) {
      const Evaluation as_is = evaluator.aggregated(evaluator.outcomes(e));
      const std::lock_guard lock(mutex);
      if (best_x.size() == 0 || better(as_is, best, 0.0)) {
        best = as_is;
        best_x = x;
      }
    }
    return e;
  };
  smooth.evaluate = smooth.evaluate_with_gradient = with_gradient;
  SolveOptions with;
  with.solver = plan.gradient_algorithm;
  with.evaluations = plan.gradient_evaluations;
  with.seed = static_cast<unsigned long>(plan.seed);
  with.x_tolerance = 1e-4;
  with.should_stop = [&] { return options.stop && options.stop->load(); };
  with.progress = options.progress;
  if (const std::string fault = solve_fault(smooth, with); !fault.empty())
    throw CaseError("plan.gradient_algorithm: " + fault);
  report = solve(smooth, with);
  std::vector<Eigen::VectorXd> starts;
  if (best_x.size() > 0 && best_x != smooth.start) starts.push_back(best_x);
  if (report.best_x.size() > 0 && report.best_x != best_x && report.best_x != smooth.start)
    starts.push_back(report.best_x);
  return starts;
}

int broken_limits(const Evaluation& e) {
  return static_cast<int>(std::count_if(e.constraints.begin(), e.constraints.end(), [](double g) { return g > 0.0; }));
}

/// Where nothing keeps every limit, the search has gone by the one that is broken worst. A point that breaks more limits
/// than the case does, and has the worse objective as well, is no plan: the case itself then is the answer.
void keep_case_if_better(const Evaluator& evaluator, PlanResult& result) {
  SearchReport& search = result.search;
  if (search.feasible || !search.best.usable || !result.baseline.usable) return;
  if (broken_limits(search.best) <= broken_limits(result.baseline) ||
      search.best.objective <= result.baseline.objective)
    return;
  search.best = result.baseline;
  search.best_x = evaluator.baseline();
  search.best_evaluation = 1;
  search.message += ". What violates the limits least breaks more of them than the case does, for a worse objective: "
                    "the case stays";
}

PlanResult run_searches(const Evaluator& evaluator, const SearchProblem& problem, const SearchProblem& smooth,
                        EvaluationStore& store, const PlanOptions& options) {
  SearchOptions search_with = search_options(evaluator.base().plan);
  if (const std::string fault = search_fault(problem, search_with); !fault.empty()) throw CaseError("plan: " + fault);

  PlanResult result;
  if (evaluator.base().plan.gradient_algorithm != "none") {
    search_with.starts = follow_gradients(evaluator, smooth, store, options, result.gradient);
    result.interrupted = result.gradient.status == SearchStatus::interrupted;
    if (result.interrupted) return result;
  }
  if (const auto guess = guessed_point(evaluator)) search_with.starts.push_back(*guess);
  search_with.stop = options.stop;
  search_with.progress = [&](const SearchProgress& p) {
    if (p.evaluations == 1) result.baseline = *p.last;
    result.history.push_back(point_of(*p.last));
    if (p.improved && p.best->usable && options.improved) options.improved(*p.best_x);
    if (options.progress) options.progress(p);
  };
  DistinctPoints asked;
  result.search = search(asked.watch(with_store(problem, store, "search")), search_with);
  result.distinct = asked.count();
  result.interrupted = result.search.status == SearchStatus::interrupted;
  if (!result.interrupted && result.search.evaluations > 0) {
    const bool had_plan = result.has_plan();
    const Eigen::VectorXd found = result.search.best_x;
    keep_case_if_better(evaluator, result);
    if (had_plan && options.improved && found != result.search.best_x) options.improved(result.search.best_x);
  }
  if (result.interrupted || result.search.evaluations == 0 || !evaluator.base().plan.random_search) return result;

  SearchOptions sample_with = search_with;
  sample_with.evaluations = result.search.evaluations;
  sample_with.progress = options.progress;
  result.random = random_search(with_store(problem, store, "random"), sample_with);
  result.interrupted = result.random.status == SearchStatus::interrupted;
  // In the order of the sample, whichever thread was first.
  for (int i = 0; i < sample_with.evaluations; ++i)
    if (const auto known = store.find(random_point(problem, sample_with.seed, i)))
      result.random_history.push_back(point_of(*known));
  return result;
}

}  // namespace

SearchOptions search_options(const PlanSpec& plan) {
  SearchOptions options;
  options.global_algorithm = plan.global_algorithm == "none" ? "" : plan.global_algorithm;
  options.local_algorithm = plan.local_algorithm == "none" ? "" : plan.local_algorithm;
  options.global_share = plan.global_share;
  options.evaluations = plan.evaluations;
  options.time_budget = plan.time_budget;
  options.seed = static_cast<unsigned long>(plan.seed);
  // The verdict on the finished plan knows no tolerance either.
  options.constraint_tolerance = 0.0;
  return options;
}

StoreIdentity store_identity(const Case& c) {
  Node document = *c.document;
  for (const CaseSection& section : case_sections())
    if (!section.stored) document.remove(section.key);
  if (Node* plan = document.find("plan")) {
    for (const char* key :
         {"evaluations", "time_budget_s", "seed", "global_share", "global_algorithm", "local_algorithm",
          "gradient_algorithm", "gradient_evaluations", "random_search", "certify", "pareto"})
      plan->remove(key);
    if (Node* variables = plan->find("variables"))
      for (auto& variable : variables->entries) variable.second.remove("start");
  }
  StoreIdentity identity;
  identity.version = kVersion;
  identity.problem = write_document(document);
  for (const BodySpec& body : c.specification.bodies)
    for (const std::string& file : {body.hull.mesh_file, body.hydrodynamics.coefficient_file})
      if (!file.empty()) identity.problem += "# " + file + " " + content_hash(file) + "\n";
  // An evaluation keeps its metrics by their place in this list.
  identity.problem += "# metrics";
  for (const std::string& name : metric_names(c.specification)) identity.problem += " " + name;
  identity.problem += "\n";
  return identity;
}

PlanResult solve_plan(const Evaluator& evaluator, EvaluationStore& store, const PlanOptions& options) {
  return run_searches(evaluator, evaluator.problem(), evaluator.smooth_problem({}), store, options);
}

PlanResult replay_plan(const Evaluator& evaluator, EvaluationStore& store) {
  SearchProblem problem = evaluator.problem();
  problem.evaluate = [](const Eigen::VectorXd&) {
    Evaluation unknown;
    unknown.interrupted = true;
    return unknown;
  };
  SearchProblem smooth = problem;
  smooth.evaluate_with_gradient = problem.evaluate;
  return run_searches(evaluator, problem, smooth, store, {});
}

}  // namespace stillhook
