#include "problems/search/nlopt_search.h"

#include <nlopt.h>

#include <exception>
#include <memory>
#include <stdexcept>

namespace stillhook {
namespace {

struct Entry {
  NloptAlgorithm about;
  nlopt_algorithm id;
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = {
      // name, global, constraints, population
      {{"isres", true, true, true}, NLOPT_GN_ISRES},
      {{"orig_direct", true, true, false}, NLOPT_GN_ORIG_DIRECT},
      {{"orig_direct_l", true, true, false}, NLOPT_GN_ORIG_DIRECT_L},
      {{"crs2", true, false, true}, NLOPT_GN_CRS2_LM},
      {{"esch", true, false, true}, NLOPT_GN_ESCH},
      {{"direct", true, false, false}, NLOPT_GN_DIRECT},
      {{"direct_l", true, false, false}, NLOPT_GN_DIRECT_L},
      {{"cobyla", false, true, false}, NLOPT_LN_COBYLA},
      {{"bobyqa", false, false, false}, NLOPT_LN_BOBYQA},
      {{"sbplx", false, false, false}, NLOPT_LN_SBPLX},
      {{"neldermead", false, false, false}, NLOPT_LN_NELDERMEAD},
  };
  return all;
}

const Entry* find_entry(const std::string& name) {
  for (const Entry& e : entries())
    if (e.about.name == name) return &e;
  return nullptr;
}

struct Destroy {
  void operator()(nlopt_opt_s* opt) const { nlopt_destroy(opt); }
};
using NloptHandle = std::unique_ptr<nlopt_opt_s, Destroy>;

/// What the callbacks share. NLopt asks for objective and constraints separately, at the same point one after the
/// other, so the last evaluation is kept.
class Run {
 public:
  Run(const SearchProblem& problem, const NloptOptions& options, const Eigen::VectorXd& start)
      : problem_(problem), options_(options), cube_(problem), start_(start), start_unit_(cube_.to_unit(start)) {
    report.algorithm = options.algorithm;
  }

  SearchReport report;
  std::exception_ptr error;
  nlopt_opt handle = nullptr;
  bool interrupted = false, budget_used = false;

  int constraints() const { return static_cast<int>(problem_.constraint_names.size()); }
  const Eigen::VectorXd& start_unit() const { return start_unit_; }

  /// The evaluation at z in the unit cube. Must not throw: it is called from C.
  const Evaluation& at(unsigned n, const double* z) noexcept {
    const Eigen::VectorXd unit = Eigen::Map<const Eigen::VectorXd>(z, n);
    if (has_last_ && unit == last_unit_) return last_;
    if (error || interrupted || budget_used) return give_up();
    if (options_.should_stop && options_.should_stop()) interrupted = true;
    if (report.evaluations >= options_.evaluations) budget_used = true;
    if (interrupted || budget_used) return give_up();
    try {
      evaluate(unit);
    } catch (...) {
      error = std::current_exception();
      return give_up();
    }
    return interrupted ? give_up() : last_;
  }

 private:
  void evaluate(const Eigen::VectorXd& unit) {
    // Scaling there and back is not exact to the last bit; the start itself must be evaluated as it was given.
    const Eigen::VectorXd x = unit == start_unit_ ? start_ : cube_.from_unit(unit);
    Evaluation evaluation = sanitised(problem_.evaluate(x), constraints());
    if (evaluation.interrupted) {
      interrupted = true;
      return;
    }
    ++report.evaluations;
    report.simulations += evaluation.from_store ? 0 : 1;
    last_ = std::move(evaluation);
    last_unit_ = unit;
    has_last_ = true;
    if (report.best_evaluation == 0 || better(last_, report.best, options_.constraint_tolerance)) {
      report.best = last_;
      report.best_x = x;
      report.best_evaluation = report.evaluations;
    }
    // Stopping at once, instead of at the next call, spares algorithms that would finish a generation first.
    if (report.evaluations >= options_.evaluations) {
      budget_used = true;
      nlopt_force_stop(handle);
    }
  }

  /// Answers the calls that NLopt still makes after it was told to stop.
  const Evaluation& give_up() noexcept {
    nlopt_force_stop(handle);
    if (stopped_.constraints.size() != constraints()) stopped_ = sanitised(Evaluation{}, constraints());
    return stopped_;
  }

  const SearchProblem& problem_;
  const NloptOptions& options_;
  UnitCube cube_;
  Eigen::VectorXd start_, start_unit_, last_unit_;
  bool has_last_ = false;
  Evaluation last_, stopped_ = sanitised(Evaluation{}, 0);
};

double objective(unsigned n, const double* z, double*, void* data) {
  return static_cast<Run*>(data)->at(n, z).objective;
}

void constraint_values(unsigned m, double* out, unsigned n, const double* z, double*, void* data) {
  const Evaluation& evaluation = static_cast<Run*>(data)->at(n, z);
  for (unsigned i = 0; i < m; ++i) out[i] = evaluation.constraints[i];
}

NloptHandle build(const SearchProblem& problem, const NloptOptions& options, const Entry& entry, Run& run) {
  const unsigned n = static_cast<unsigned>(problem.start.size());
  NloptHandle opt(nlopt_create(entry.id, n));
  if (!opt) throw std::bad_alloc();
  bool ok = nlopt_set_lower_bounds1(opt.get(), 0.0) > 0 && nlopt_set_upper_bounds1(opt.get(), 1.0) > 0 &&
            nlopt_set_min_objective(opt.get(), objective, &run) > 0;
  if (run.constraints() > 0) {
    const std::vector<double> tolerance(static_cast<std::size_t>(run.constraints()), options.constraint_tolerance);
    ok = ok && nlopt_add_inequality_mconstraint(opt.get(), static_cast<unsigned>(run.constraints()), constraint_values,
                                                &run, tolerance.data()) > 0;
  }
  if (entry.about.population && options.population > 0)
    ok = ok && nlopt_set_population(opt.get(), static_cast<unsigned>(options.population)) > 0;
  if (!entry.about.global) {
    // Towards the inside: a step out of the box would be cut to nothing by algorithms that respect the bounds.
    Eigen::VectorXd step = Eigen::VectorXd::Constant(n, options.initial_step);
    for (unsigned i = 0; i < n; ++i)
      if (run.start_unit()[i] + options.initial_step > 1.0) step[i] = -options.initial_step;
    ok = ok && nlopt_set_initial_step(opt.get(), step.data()) > 0 &&
         nlopt_set_xtol_abs1(opt.get(), options.x_tolerance) > 0;
  }
  if (!ok) {
    const char* why = nlopt_get_errmsg(opt.get());
    throw std::invalid_argument(options.algorithm + " cannot be set up" + (why ? std::string(": ") + why : ""));
  }
  return opt;
}

void conclude(nlopt_result result, const char* message, const NloptOptions& options, Run& run) {
  SearchReport& report = run.report;
  report.feasible = report.best.usable && report.best.violation() <= options.constraint_tolerance;
  if (run.interrupted) {
    report.status = SearchStatus::interrupted;
    report.message = "interrupted";
  } else if (run.budget_used || result == NLOPT_MAXEVAL_REACHED) {
    report.status = SearchStatus::budget_used;
    report.message = "evaluation budget used";
  } else if (result > 0 || result == NLOPT_ROUNDOFF_LIMITED) {
    // Roundoff limited: no further progress is possible in double precision; the points found are good.
    report.status = SearchStatus::converged;
    report.message = nlopt_result_to_string(result);
  } else {
    report.status = SearchStatus::failed;
    report.message = std::string(nlopt_result_to_string(result)) + (message ? std::string(": ") + message : "");
  }
}

}  // namespace

const std::vector<NloptAlgorithm>& nlopt_algorithms() {
  static const std::vector<NloptAlgorithm> all = [] {
    std::vector<NloptAlgorithm> list;
    for (const Entry& e : entries()) list.push_back(e.about);
    return list;
  }();
  return all;
}

std::string algorithm_fault(const std::string& name, bool global, bool has_constraints) {
  std::string able;
  for (const NloptAlgorithm& a : nlopt_algorithms())
    if (a.global == global && (a.constraints || !has_constraints)) able += (able.empty() ? "" : ", ") + a.name;
  const std::string kind = global ? "global" : "local", got = ", got \"" + name + "\"";
  const Entry* entry = find_entry(name);
  if (!entry) return "must be none or one of " + able + got;
  if (entry->about.global != global) return "must be a " + kind + " algorithm, none or one of " + able + got;
  if (has_constraints && !entry->about.constraints)
    return "must keep constraints, since there are limits: none or one of " + able + got;
  return {};
}

SearchReport nlopt_search(const SearchProblem& problem, const NloptOptions& options) {
  if (const std::string fault = problem_fault(problem); !fault.empty()) throw std::invalid_argument(fault);
  const Entry* entry = find_entry(options.algorithm);
  const bool global = entry && entry->about.global;
  if (const std::string fault = algorithm_fault(options.algorithm, global, !problem.constraint_names.empty());
      !fault.empty())
    throw std::invalid_argument(fault);
  if (options.evaluations <= 0) throw std::invalid_argument("the evaluation budget must be positive");

  const Eigen::VectorXd start = options.start.size() ? options.start : problem.start;
  Run run(problem, options, start.cwiseMax(problem.lower).cwiseMin(problem.upper));
  const NloptHandle opt = build(problem, options, *entry, run);
  run.handle = opt.get();
  nlopt_srand(options.seed);
  Eigen::VectorXd z = run.start_unit();
  double value = 0.0;
  const nlopt_result result = nlopt_optimize(opt.get(), z.data(), &value);
  if (run.error) std::rethrow_exception(run.error);
  conclude(result, nlopt_get_errmsg(opt.get()), options, run);
  return run.report;
}

}  // namespace stillhook
