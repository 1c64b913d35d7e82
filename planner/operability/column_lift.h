// The lift of one column, simulated in any seed and height of its sea.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "planner/operability/operability_plan.h"
#include "planner/run.h"

namespace stillhook {

class ColumnLift {
 public:
  /// Builds the lift in the column's sea at its first height; every run begins from its calm-water equilibria, which do
  /// not depend on the sea. Keeps references to case and plan. Throws CaseError when it cannot be built.
  ColumnLift(const Case& c, const OperabilityPlan& plan, std::size_t column, const HydroProgress& progress = {});

  /// Throws CaseError when a seed's waves cannot be simulated: they differ in their shortest ones.
  void check_seed(int seed) const;

  /// Simulates and takes the values of the criteria. The same arguments give the same bits, in any thread and process
  /// of one machine. Nothing if `stop` interrupted it. Throws CaseError as check_seed() does.
  std::optional<LiftValues> run(int seed, double height, const std::atomic<bool>* stop = nullptr) const;

  /// What the lift's model says of itself in this sea.
  const std::vector<std::string>& warnings() const { return base_.warnings; }

 private:
  Model model_in(int seed, double height) const;

  const Case& case_;
  const OperabilityPlan& plan_;
  std::size_t column_;
  PreparedRun base_;
};

}  // namespace stillhook
