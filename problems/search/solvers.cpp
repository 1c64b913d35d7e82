#include "problems/search/solvers.h"

#include <algorithm>

namespace stillhook {
namespace {

bool keeps_enough(const Solver& solver, const SolverNeeds& needs) {
  if (needs.equalities) return solver.keeps == Solver::Keeps::everything;
  return !needs.inequalities || solver.keeps != Solver::Keeps::bounds;
}

bool able(const Solver& solver, const SolverNeeds& needs) {
  return keeps_enough(solver, needs) && (needs.gradient || !solver.gradient);
}

template <class Admitted>
std::string names(const SolverNeeds& needs, Admitted admitted) {
  std::string list;
  for (const Solver& solver : solvers())
    if (admitted(solver) && able(solver, needs)) list += (list.empty() ? "" : ", ") + solver.name;
  return list;
}

/// Why an existing solver cannot do the job, to be followed by those that can; empty if it can.
std::string inability(const Solver& solver, const SolverNeeds& needs) {
  if (solver.gradient && !needs.gradient) return "must do without gradients, since the problem has none: ";
  if (keeps_enough(solver, needs)) return {};
  return needs.equalities ? "must keep equalities, since there are some: "
                          : "must keep constraints, since there are limits: ";
}

}  // namespace

const std::vector<Solver>& solvers() {
  using enum Solver::Keeps;
  static const std::vector<Solver> list = {
      // name, global, gradient, keeps, population
      {"ipopt", false, true, everything, false, "interior point with limited-memory BFGS (Waechter & Biegler 2006)"},
      {"slsqp", false, true, everything, false, "sequential least-squares quadratic programming (Kraft 1994)"},
      {"ccsaq", false, true, inequalities, false, "conservative convex separable approximations (Svanberg 2002)"},
      {"mma", false, true, inequalities, false, "method of moving asymptotes (Svanberg 2002)"},
      {"lbfgs", false, true, bounds, false, "limited-memory BFGS (Liu & Nocedal 1989)"},
      {"var2", false, true, bounds, false, "limited-memory variable metric (Vlcek & Luksan 2006)"},
      {"auglag_lbfgs", false, true, everything, false, "lbfgs on the augmented Lagrangian (Birgin & Martinez 2008)"},
      {"auglag_var2", false, true, everything, false, "var2 on the augmented Lagrangian"},
      {"cobyla", false, false, everything, false, "linear models on a simplex (Powell 1994)"},
      {"bobyqa", false, false, bounds, false, "quadratic models (Powell 2009)"},
      {"sbplx", false, false, bounds, false, "simplex on subspaces (Rowan 1990)"},
      {"neldermead", false, false, bounds, false, "simplex (Nelder & Mead 1965)"},
      {"isres", true, false, everything, true, "evolution strategy with stochastic ranking (Runarsson & Yao 2005)"},
      {"orig_direct", true, false, inequalities, false, "dividing rectangles (Jones, Perttunen & Stuckman 1993)"},
      {"orig_direct_l", true, false, inequalities, false, "the same, more local (Gablonsky & Kelley 2001)"},
      {"crs2", true, false, bounds, true, "controlled random search (Kaelo & Ali 2006)"},
      {"esch", true, false, bounds, true, "evolution strategy (da Silva Santos et al. 2010)"},
      {"direct", true, false, bounds, false, "dividing rectangles, another implementation"},
      {"direct_l", true, false, bounds, false, "the same, more local"},
      {"mlsl", true, false, bounds, true, "bobyqa from many starts (Kucherenko & Sytsko 2005)"},
      {"mlsl_lbfgs", true, true, bounds, true, "lbfgs from many starts"},
  };
  return list;
}

const Solver* find_solver(const std::string& name) {
  const auto found = std::find_if(solvers().begin(), solvers().end(), [&](const Solver& s) { return s.name == name; });
  return found == solvers().end() ? nullptr : &*found;
}

SolverNeeds needs_of(const SearchProblem& problem) {
  SolverNeeds needs;
  needs.equalities = problem.equalities > 0;
  needs.inequalities = static_cast<int>(problem.constraint_names.size()) > problem.equalities;
  needs.gradient = static_cast<bool>(problem.evaluate_with_gradient);
  return needs;
}

std::string solver_fault(const std::string& name, const SolverNeeds& needs) {
  const std::string can = names(needs, [](const Solver&) { return true; }), got = ", got \"" + name + "\"";
  const Solver* solver = find_solver(name);
  if (!solver) return "must be auto or one of " + can + got;
  if (const std::string why = inability(*solver, needs); !why.empty()) return why + "auto or one of " + can + got;
  return {};
}

std::string algorithm_fault(const std::string& name, bool global, const SolverNeeds& needs) {
  const std::string can = names(needs, [&](const Solver& s) { return s.global == global; });
  const std::string kind = global ? "global" : "local", got = ", got \"" + name + "\"";
  const Solver* solver = find_solver(name);
  if (!solver) return "must be none or one of " + can + got;
  if (solver->global != global) return "must be a " + kind + " algorithm, none or one of " + can + got;
  if (const std::string why = inability(*solver, needs); !why.empty()) return why + "none or one of " + can + got;
  return {};
}

}  // namespace stillhook
