#include "problems/search/nlopt_search.h"

#include <nlopt.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "problems/search/solver_run.h"

namespace stillhook {
namespace {

/// An algorithm, and the one that it runs on its own subproblems if it needs another.
struct Algorithm {
  const char* name;
  nlopt_algorithm id;
  nlopt_algorithm subsidiary = NLOPT_NUM_ALGORITHMS;
  bool has_subsidiary() const { return subsidiary != NLOPT_NUM_ALGORITHMS; }
};

constexpr Algorithm kAlgorithms[] = {
    {"slsqp", NLOPT_LD_SLSQP},
    {"ccsaq", NLOPT_LD_CCSAQ},
    {"mma", NLOPT_LD_MMA},
    {"lbfgs", NLOPT_LD_LBFGS},
    {"var2", NLOPT_LD_VAR2},
    {"auglag_lbfgs", NLOPT_AUGLAG, NLOPT_LD_LBFGS},
    {"auglag_var2", NLOPT_AUGLAG, NLOPT_LD_VAR2},
    {"cobyla", NLOPT_LN_COBYLA},
    {"bobyqa", NLOPT_LN_BOBYQA},
    {"sbplx", NLOPT_LN_SBPLX},
    {"neldermead", NLOPT_LN_NELDERMEAD},
    {"isres", NLOPT_GN_ISRES},
    {"orig_direct", NLOPT_GN_ORIG_DIRECT},
    {"orig_direct_l", NLOPT_GN_ORIG_DIRECT_L},
    {"crs2", NLOPT_GN_CRS2_LM},
    {"esch", NLOPT_GN_ESCH},
    {"direct", NLOPT_GN_DIRECT},
    {"direct_l", NLOPT_GN_DIRECT_L},
    {"mlsl", NLOPT_G_MLSL_LDS, NLOPT_LN_BOBYQA},
    {"mlsl_lbfgs", NLOPT_G_MLSL_LDS, NLOPT_LD_LBFGS},
};

const Algorithm& algorithm_of(const std::string& name) {
  for (const Algorithm& a : kAlgorithms)
    if (a.name == name) return a;
  throw std::logic_error("NLopt has no algorithm called " + name);
}

struct Destroy {
  void operator()(nlopt_opt_s* opt) const { nlopt_destroy(opt); }
};
using NloptHandle = std::unique_ptr<nlopt_opt_s, Destroy>;

/// The run, the handle that stops it, and the scales of what NLopt is shown.
struct Callback {
  SolverRun& run;
  nlopt_opt handle;
  int answers_before_stop = 0;  // calls of the objective before NLopt may be told to stop
  double objective_scale = 1.0;
  Eigen::VectorXd constraint_scale = Eigen::VectorXd::Ones(run.constraints());

  /// Gradients at the start become of order one, as in Ipopt: SLSQP begins with the unit matrix for its Hessian, and
  /// gradients far above it cost it many steps, or its way.
  void set_scales() {
    const UnitEvaluation* start = run.at(run.start_unit().data());
    if (!start || !start->gradient_valid) return;
    objective_scale = 1.0 / std::max(1.0, start->objective_gradient.lpNorm<Eigen::Infinity>());
    for (int i = 0; i < run.constraints(); ++i)
      constraint_scale[i] = 1.0 / std::max(1.0, start->jacobian.row(i).lpNorm<Eigen::Infinity>());
  }

  /// The evaluation at z, or null after telling NLopt to stop.
  const UnitEvaluation* at(const double* z, bool gradient_wanted) noexcept {
    const UnitEvaluation* evaluation = run.at(z);
    if (evaluation && gradient_wanted && !evaluation->gradient_valid) {
      run.miss_gradient();
      evaluation = nullptr;
    }
    if (run.ended() && answers_before_stop <= 0) nlopt_force_stop(handle);
    return evaluation;
  }
};

// After it was told to stop, NLopt still finishes what it is at; nothing that it sees then may look good.
constexpr double kStopped = 1e4;

double objective(unsigned n, const double* z, double* gradient, void* data) {
  Callback& callback = *static_cast<Callback*>(data);
  --callback.answers_before_stop;
  const UnitEvaluation* evaluation = callback.at(z, gradient != nullptr);
  if (gradient && evaluation)
    Eigen::Map<Eigen::VectorXd>(gradient, n) = callback.objective_scale * evaluation->objective_gradient;
  else if (gradient)
    Eigen::Map<Eigen::VectorXd>(gradient, n).setZero();
  return evaluation ? callback.objective_scale * evaluation->objective : kStopped;
}

/// Rows [first, first + m) of the constraints.
void constraints(int first, unsigned m, double* out, unsigned n, const double* z, double* gradient, void* data) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Callback& callback = *static_cast<Callback*>(data);
  const auto scale = callback.constraint_scale.segment(first, m);
  const UnitEvaluation* evaluation = callback.at(z, gradient != nullptr);
  if (gradient && evaluation)
    Eigen::Map<Rows>(gradient, m, n) = scale.asDiagonal() * evaluation->jacobian.middleRows(first, m);
  else if (gradient)
    Eigen::Map<Rows>(gradient, m, n).setZero();
  if (evaluation)
    Eigen::Map<Eigen::VectorXd>(out, m) = scale.cwiseProduct(evaluation->constraints.segment(first, m));
  else
    Eigen::Map<Eigen::VectorXd>(out, m).setOnes();
}

void equalities(unsigned m, double* out, unsigned n, const double* z, double* gradient, void* data) {
  constraints(0, m, out, n, z, gradient, data);
}

void inequalities(unsigned m, double* out, unsigned n, const double* z, double* gradient, void* data) {
  constraints(static_cast<Callback*>(data)->run.equalities(), m, out, n, z, gradient, data);
}

/// First steps towards the inside: one out of the box would be cut to nothing by algorithms that respect the bounds.
bool set_steps(nlopt_opt opt, const SolverRun& run) {
  Eigen::VectorXd step = Eigen::VectorXd::Constant(run.variables(), run.options().initial_step);
  for (int i = 0; i < run.variables(); ++i)
    if (run.start_unit()[i] + step[i] > 1.0) step[i] = -step[i];
  return nlopt_set_initial_step(opt, step.data()) > 0;
}

/// An augmented Lagrangian or a search with many starts, around a local algorithm.
bool set_subsidiary(nlopt_opt opt, const Algorithm& algorithm, const SolverRun& run) {
  if (!algorithm.has_subsidiary()) return true;
  // A subproblem need not be solved to the last digit before the multipliers or the start change.
  constexpr double kRelativeDecrease = 1e-9;
  const NloptHandle inner(nlopt_create(algorithm.subsidiary, static_cast<unsigned>(run.variables())));
  return inner && nlopt_set_xtol_abs1(inner.get(), run.options().x_tolerance) > 0 &&
         nlopt_set_ftol_rel(inner.get(), kRelativeDecrease) > 0 && set_steps(inner.get(), run) &&
         nlopt_set_local_optimizer(opt, inner.get()) > 0;
}

bool set_constraints(nlopt_opt opt, Callback& callback) {
  const SolverRun& run = callback.run;
  const Eigen::VectorXd tolerance = run.tolerance() * callback.constraint_scale;
  const unsigned equal = static_cast<unsigned>(run.equalities()), other = run.constraints() - equal;
  bool ok = true;
  if (equal > 0) ok = ok && nlopt_add_equality_mconstraint(opt, equal, equalities, &callback, tolerance.data()) > 0;
  if (other > 0)
    ok = ok && nlopt_add_inequality_mconstraint(opt, other, inequalities, &callback, tolerance.data() + equal) > 0;
  return ok;
}

void set_up(const Solver& solver, Callback& callback) {
  nlopt_opt opt = callback.handle;
  const SolverRun& run = callback.run;
  bool ok = nlopt_set_lower_bounds1(opt, 0.0) > 0 && nlopt_set_upper_bounds1(opt, 1.0) > 0 &&
            nlopt_set_min_objective(opt, objective, &callback) > 0 && set_constraints(opt, callback) &&
            set_subsidiary(opt, algorithm_of(solver.name), run);
  if (solver.population && run.options().population > 0)
    ok = ok && nlopt_set_population(opt, static_cast<unsigned>(run.options().population)) > 0;
  if (!solver.global) ok = ok && set_steps(opt, run) && nlopt_set_xtol_abs1(opt, run.options().x_tolerance) > 0;
  if (ok) return;
  const char* why = nlopt_get_errmsg(opt);
  throw std::invalid_argument(solver.name + " cannot be set up" + (why ? std::string(": ") + why : ""));
}

SearchReport conclude(nlopt_result result, const char* message, const Solver& solver, SolverRun& run) {
  const std::string word = nlopt_result_to_string(result);
  // Roundoff limited: no further progress is possible in double precision; the points found are good.
  const bool converged = result > 0 || result == NLOPT_ROUNDOFF_LIMITED;
  // SLSQP may report success at a point that violates its constraints.
  if (converged && solver.gradient && !run.feasible())
    return run.conclude(SearchStatus::failed, word + ", but no point within the limits was found");
  if (converged) return run.conclude(SearchStatus::converged, word);
  return run.conclude(SearchStatus::failed, word + (message ? std::string(": ") + message : ""));
}

}  // namespace

SearchReport nlopt_search(const SearchProblem& problem, const SolveOptions& options) {
  const Solver& solver = *find_solver(options.solver);
  SolverRun run(problem, options, solver);
  const NloptHandle opt(nlopt_create(algorithm_of(solver.name).id, static_cast<unsigned>(run.variables())));
  if (!opt) throw std::bad_alloc();
  Callback callback{run, opt.get()};
  // Stopped before it has sampled its first rectangles, NLopt's original DIRECT reads outside its arrays.
  if (solver.name.starts_with("orig_direct")) callback.answers_before_stop = 2 * run.variables() + 2;
  if (solver.gradient) callback.set_scales();
  set_up(solver, callback);
  nlopt_srand(options.seed);  // the generator belongs to the running thread
  Eigen::VectorXd z = run.start_unit();
  double value = 0.0;
  const nlopt_result result = nlopt_optimize(opt.get(), z.data(), &value);
  return conclude(result, nlopt_get_errmsg(opt.get()), solver, run);
}

}  // namespace stillhook
