#include "problems/search/ipopt_search.h"

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <mutex>
#include <optional>
#include <stdexcept>

#include "problems/search/solver_run.h"

namespace stillhook {
namespace {

using Ipopt::Index;
using Ipopt::Number;

// Neither Ipopt's reference counts and registered options nor the linear solver MUMPS may be used from two threads at
// once. Everything of Ipopt's happens with this lock held, the evaluations without.
std::mutex& ipopt_lock() {
  static std::mutex lock;
  return lock;
}

/// Gives the lock up for as long as it lives.
class Unlocked {
 public:
  explicit Unlocked(std::unique_lock<std::mutex>& lock) : lock_(lock) { lock_.unlock(); }
  ~Unlocked() { lock_.lock(); }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  std::unique_lock<std::mutex>& lock_;
};

class UnitProblem : public Ipopt::TNLP {
 public:
  UnitProblem(SolverRun& run, std::unique_lock<std::mutex>& lock) : run_(run), lock_(lock) {}

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian, IndexStyleEnum& style) override {
    n = run_.variables();
    m = run_.constraints();
    jacobian = n * m;
    hessian = 0;
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* z_lower, Number* z_upper, Index m, Number* lower, Number* upper) override {
    constexpr double kNone = -2e19;  // below Ipopt's minus infinity
    std::fill_n(z_lower, n, 0.0);
    std::fill_n(z_upper, n, 1.0);
    for (Index i = 0; i < m; ++i) lower[i] = i < run_.equalities() ? 0.0 : kNone;
    std::fill_n(upper, m, 0.0);
    return true;
  }

  bool get_starting_point(Index n, bool, Number* z, bool, Number*, Number*, Index, bool, Number*) override {
    std::copy_n(run_.start_unit().data(), n, z);
    return true;
  }

  bool eval_f(Index, const Number* z, bool, Number& value) override {
    const UnitEvaluation* evaluation = at(z);
    if (evaluation) value = evaluation->objective;
    return evaluation != nullptr;
  }

  bool eval_grad_f(Index n, const Number* z, bool, Number* gradient) override {
    const UnitEvaluation* evaluation = at(z);
    if (evaluation) std::copy_n(evaluation->objective_gradient.data(), n, gradient);
    return evaluation != nullptr;
  }

  bool eval_g(Index, const Number* z, bool, Index m, Number* values) override {
    const UnitEvaluation* evaluation = at(z);
    if (evaluation) std::copy_n(evaluation->constraints.data(), m, values);
    return evaluation != nullptr;
  }

  bool eval_jac_g(Index n, const Number* z, bool, Index m, Index count, Index* row, Index* column,
                  Number* values) override {
    if (!values) {
      for (Index i = 0; i < m * n; ++i) {
        row[i] = i / n;
        column[i] = i % n;
      }
      return true;
    }
    const UnitEvaluation* evaluation = at(z);
    if (evaluation) std::copy_n(evaluation->jacobian.data(), count, values);
    return evaluation != nullptr;
  }

  bool intermediate_callback(Ipopt::AlgorithmMode, Index, Number, Number, Number, Number, Number, Number, Number,
                             Number, Index, const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    return !run_.ended();
  }

  void finalize_solution(Ipopt::SolverReturn, Index, const Number*, const Number*, const Number*, Index, const Number*,
                         const Number*, Number, const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {}

 private:
  /// Null where a step may not end: Ipopt then tries a shorter one. Must not throw, since Ipopt would swallow it.
  const UnitEvaluation* at(const Number* z) noexcept {
    std::optional<Unlocked> others_may;
    if (!run_.is_last(z)) others_may.emplace(lock_);
    const UnitEvaluation* evaluation = run_.at(z);
    others_may.reset();
    return evaluation && evaluation->usable && evaluation->gradient_valid ? evaluation : nullptr;
  }

  SolverRun& run_;
  std::unique_lock<std::mutex>& lock_;
};

void set_options(Ipopt::OptionsList& list, const SolverRun& run) {
  list.SetIntegerValue("print_level", 0);
  list.SetStringValue("sb", "yes");  // no banner
  list.SetStringValue("hessian_approximation", "limited-memory");
  list.SetNumericValue("tol", run.options().optimality_tolerance);
  list.SetNumericValue("constr_viol_tol", run.tolerance());
  list.SetNumericValue("acceptable_tol", 1e2 * run.options().optimality_tolerance);
  list.SetNumericValue("acceptable_constr_viol_tol", run.tolerance());
  list.SetIntegerValue("acceptable_iter", 5);
  list.SetIntegerValue("max_iter", 1000000);  // the budget of evaluations ends it
  // Measured on the Hock-Schittkowski problems and a sway problem: gradients of order one at the start and a longer
  // memory take a fifth fewer evaluations, and a start near a bound should stay there.
  list.SetNumericValue("nlp_scaling_max_gradient", 1.0);
  list.SetIntegerValue("limited_memory_max_history", 20);
  list.SetNumericValue("bound_push", 1e-3);
  list.SetNumericValue("bound_frac", 1e-3);
  // The bounds are those of the physics: not even a little beyond them.
  list.SetNumericValue("bound_relax_factor", 0.0);
}

struct Outcome {
  SearchStatus status;
  const char* message;
};

Outcome outcome_of(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
      return {SearchStatus::converged, "optimal"};
    case Ipopt::Solved_To_Acceptable_Level:
      return {SearchStatus::converged, "optimal to an acceptable level"};
    case Ipopt::Feasible_Point_Found:
      return {SearchStatus::converged, "a point within the limits was found"};
    case Ipopt::Search_Direction_Becomes_Too_Small:
      return {SearchStatus::converged, "no further progress in double precision"};
    case Ipopt::Infeasible_Problem_Detected:
      return {SearchStatus::converged, "the limits cannot be kept near here: least violation found"};
    case Ipopt::Restoration_Failed:
      return {SearchStatus::failed, "no step back towards the limits was found"};
    case Ipopt::Error_In_Step_Computation:
      return {SearchStatus::failed, "no step could be computed"};
    case Ipopt::Invalid_Number_Detected:
      return {SearchStatus::failed, "no evaluation is usable here"};
    case Ipopt::Not_Enough_Degrees_Of_Freedom:
      return {SearchStatus::failed, "more equalities than variables"};
    default:
      return {SearchStatus::failed, "Ipopt gave up"};
  }
}

Ipopt::ApplicationReturnStatus run_ipopt(SolverRun& run) {
  std::unique_lock lock(ipopt_lock());
  // Made and destroyed with the lock held.
  const Ipopt::SmartPtr<Ipopt::TNLP> problem = new UnitProblem(run, lock);
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
  set_options(*application->Options(), run);
  // Without a name it would read options from any ipopt.opt in the current folder.
  if (application->Initialize("") != Ipopt::Solve_Succeeded) throw std::logic_error("Ipopt refuses its options");
  return application->OptimizeTNLP(problem);
}

}  // namespace

SearchReport ipopt_search(const SearchProblem& problem, const SolveOptions& options) {
  SolverRun run(problem, options, *find_solver("ipopt"));
  Outcome outcome = outcome_of(run_ipopt(run));
  if (outcome.status == SearchStatus::failed && run.invalid_gradients() > 0)
    outcome = {SearchStatus::gradient_invalid, "no way round points without a valid gradient"};
  return run.conclude(outcome.status, outcome.message);
}

}  // namespace stillhook
