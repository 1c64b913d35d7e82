// One simulated run of a lift, judged.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "problems/case.h"
#include "problems/model_gaps.h"
#include "results/archive_stream.h"
#include "results/summary.h"
#include "sim/simulate.h"

namespace stillhook {

struct RunResult {
  Specification specification;  // as simulated
  Trajectory trajectory;
  Metrics metrics;
  std::vector<LimitCheck> limits;
  std::vector<std::string> warnings;  // as PreparedRun's
  std::string date;                   // when it was made, as date_now(); empty = not known

  /// Completed and no hard limit violated.
  bool passed() const { return within_limits(metrics, limits); }
};

/// A lift built and its operation worked out, ready to simulate. Throws SpecificationError.
struct PreparedRun {
  explicit PreparedRun(const Specification& specification, const HydroProgress& progress = {})
      : model(build_model(specification, progress)), operation(build_operation(model)), warnings(model.warnings()) {
    for (std::string& gap : model_gaps(model, operation)) warnings.push_back(std::move(gap));
  }
  Model model;
  Operation operation;
  std::vector<std::string> warnings;  // of the model, and of what it leaves out in this lift
};

/// The specification, which is the case's or a change of it, ready to simulate. Throws CaseError with the place in the
/// case file when it cannot be built. `progress` hears of a panel computation, if there has to be one.
PreparedRun prepare_run(const Case& c, const Specification& specification, const HydroProgress& progress = {});

/// Simulates and judges. `stop`, when set from outside, interrupts at the next call of `progress` (t and planned end,
/// s), which may be empty. With an `archive` the samples go there as they are made and stay there; without one the
/// trajectory holds them.
RunResult run_lift(const PreparedRun& prepared, const std::vector<LimitSpec>& limits,
                   const std::atomic<bool>* stop = nullptr,
                   const std::function<void(double t, double t_end)>& progress = {}, ArchiveStream* archive = nullptr);

/// Judges a trajectory that was simulated before.
RunResult judged(const Specification& specification, Trajectory trajectory, const std::vector<LimitSpec>& limits);

/// The summary of a run, with names and version filled in.
Summary summary_of(const RunResult& run, const Case& c, const std::string& verb);

}  // namespace stillhook
