// The solvers that can be named, and which can do which job.
#pragma once

#include <string>
#include <vector>

#include "problems/search/problem.h"

namespace stillhook {

struct Solver {
  /// Which constraints it keeps besides the bounds.
  enum class Keeps { bounds, inequalities, everything };
  std::string name;
  bool global = false;
  bool gradient = false;  // needs evaluate_with_gradient
  Keeps keeps = Keeps::bounds;
  bool population = false;  // has a population whose size can be set
  std::string note;         // what it is, with its source
};

const std::vector<Solver>& solvers();

/// Null if there is none of that name.
const Solver* find_solver(const std::string& name);

/// What a problem asks of its solver, and offers it.
struct SolverNeeds {
  bool inequalities = false, equalities = false;
  bool gradient = false;  // the problem has one
};

SolverNeeds needs_of(const SearchProblem& problem);

/// Empty if the solver exists and can do the job; else what it must be instead, which ones can, and the name given.
std::string solver_fault(const std::string& name, const SolverNeeds& needs);

/// The same where only a global or only a local one will do, or none at all.
std::string algorithm_fault(const std::string& name, bool global, const SolverNeeds& needs);

}  // namespace stillhook
