// Nonlinear least squares over simulations, by Ceres (Levenberg-Marquardt with bounds).
//
//   minimise  1/2 sum rho(r_i^2)      rho Huber's for samples, the square for continuity and priors
//
// The unknowns come in blocks: the case keys, each record's own start, the beginnings of segments. A unit is one
// simulation that depends on some blocks and gives many residuals with their derivatives; Ceres sees one residual block
// for each, so that the robust loss acts on samples, and asks for them all at once before every iterate.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "sim/spatial/pose.h"

namespace stillhook {

struct FitBlock {
  VectorX value;
  VectorX lower, upper;   // may be infinite; empty = none
  bool constant = false;
};

/// Residuals that use the same blocks of a unit.
struct FitGroup {
  std::vector<int> uses;  // indices into the unit's blocks
  int count = 0;
  bool robust = true;
};

struct FitUnit {
  std::vector<int> blocks;  // of the problem
  std::vector<FitGroup> groups;  // in the order of the residuals
  bool simulates = true;         // false for what is known beforehand
  /// Fills r (all groups) and J (by block of the unit: residuals x block size) at block values in the unit's order.
  /// Returns why the simulation failed, empty if it did not. May throw; called from several threads, once at a time for a
  /// unit.
  std::function<std::string(const std::vector<VectorX>& x, VectorX& r, std::vector<MatrixX>& J)> evaluate;

  int residuals() const;
};

struct FitProblem {
  std::vector<FitBlock> blocks;
  std::vector<FitUnit> units;
};

struct FitProgress {
  int iteration = 0;
  double cost = 0.0;
};

struct FitOptions {
  double robust = 2.5;   // Huber's threshold, in residuals; > 0
  int iterations = 50;
  double tolerance = 1e-6;  // relative change of the cost that ends it
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const FitProgress&)> progress;
};

/// Residuals and derivatives of a unit.
struct UnitValues {
  bool ok = false;
  std::string message;  // why not
  VectorX r;
  std::vector<MatrixX> J;
};

struct FitOutcome {
  bool usable = false;     // the blocks hold a point at least as good as the start
  bool converged = false;
  bool interrupted = false;
  std::string message;
  double cost = 0.0;
  int iterations = 0, evaluations = 0;  // evaluations: of all units together
  std::vector<UnitValues> units;        // at the blocks as they are left, if usable
};

/// Improves the blocks in place. Rethrows what a unit throws at the start; later it counts as a failed simulation.
FitOutcome solve_fit(FitProblem& problem, const FitOptions& options);

/// Residuals and derivatives of every unit at the blocks' values.
std::vector<UnitValues> evaluate_units(const FitProblem& problem);

}  // namespace stillhook
