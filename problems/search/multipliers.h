// What a limit costs: Lagrange multipliers at a point, whichever solver found it.
//
//   grad f + sum_i lambda_i grad g_i + mu = 0,   lambda_i >= 0 where g_i wants <= 0,  lambda_i g_i = 0,
//   mu_j <= 0 at the lower bound, >= 0 at the upper one, 0 between
//
//   lambda_i = -df*/dc_i  for g_i <= c_i: what the optimum gains when limit i is relaxed by one (of its scale)
//
// Solved as a least-squares problem with signs over the limits and bounds that are active; the residual says how far
// the point is from being optimal.  Lawson & Hanson, Solving Least Squares Problems (1974), ch. 23.
#pragma once

#include "problems/search/problem.h"

namespace stillhook {

struct Multipliers {
  Eigen::VectorXd constraints;  // lambda, one per constraint; 0 where it is not active
  Eigen::VectorXd bounds;       // mu, one per variable, per unit of x; 0 away from the bounds
  double residual = 0.0;        // of the first equation in the unit cube, relative to the gradient of f; 0 = optimal
};

/// Multipliers at x. The evaluation must have a valid gradient (std::invalid_argument otherwise). A constraint is
/// active if g_i >= -activity, a bound if x is within `activity` of it (share of the range).
Multipliers multipliers_at(const SearchProblem& problem, const Eigen::VectorXd& x, const Evaluation& evaluation,
                           double activity = 1e-4);

}  // namespace stillhook
