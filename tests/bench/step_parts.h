// What a step of a lift costs by part: each part is timed alone, in a loop, at a state in the middle of the run, and
// multiplied by how often a step calls it.
#pragma once

#include <string>
#include <vector>

#include "sim/model.h"
#include "sim/operation.h"

namespace stillhook {

struct PartCost {
  std::string part;
  double per_step;  // s
};

struct StepCosts {
  std::vector<PartCost> parts;
  double step;                       // s, a whole step with its channels, measured in the run around the state
  double dense_lu;                   // s, one dense factorisation of the size of Newton's matrix
  int size;                          // of that matrix
  double residuals, factorisations;  // a step
};

/// Runs the operation to `middle` (s), measures the run for `span` seconds more, then the parts at the state reached.
StepCosts measure_step(const Model& model, const Operation& operation, double middle, double span);

/// Processor time of the calling thread, s.
double thread_seconds();

}  // namespace stillhook
