#include "problems/search/solve.h"

#include <stdexcept>

#include "problems/search/auto_search.h"
#include "problems/search/ipopt_search.h"
#include "problems/search/nlopt_search.h"
#include "problems/search/solvers.h"

namespace stillhook {

std::string solve_fault(const SearchProblem& problem, const SolveOptions& options) {
  if (std::string fault = problem_fault(problem); !fault.empty()) return fault;
  const bool automatic = options.solver == "auto";
  if (!automatic)
    if (std::string fault = solver_fault(options.solver, needs_of(problem)); !fault.empty()) return "solver " + fault;
  if (!automatic && options.starts.size() > 1) return options.solver + " begins at one start; several need auto";
  for (const Eigen::VectorXd& x : options.starts)
    if (std::string fault = start_fault(problem, x); !fault.empty()) return fault;
  if (options.evaluations <= 0) return "the evaluation budget must be positive";
  if (!(options.constraint_tolerance >= 0.0)) return "constraint_tolerance must be >= 0";
  if (problem.equalities > 0 && options.constraint_tolerance == 0.0)
    return "constraint_tolerance must be > 0, since there are equalities";
  if (!(options.x_tolerance >= 0.0)) return "x_tolerance must be >= 0";
  if (!(options.optimality_tolerance > 0.0)) return "optimality_tolerance must be > 0";
  if (!(options.initial_step > 0.0 && options.initial_step <= 1.0)) return "initial_step must be in (0, 1]";
  return {};
}

SearchReport solve(const SearchProblem& problem, const SolveOptions& options) {
  if (const std::string fault = solve_fault(problem, options); !fault.empty()) throw std::invalid_argument(fault);
  if (options.solver == "auto") return auto_search(problem, options);
  if (options.solver == "ipopt") return ipopt_search(problem, options);
  return nlopt_search(problem, options);
}

}  // namespace stillhook
